/** Kokoro, a natural voice of English, in a worker of the page. */

import { fetchText } from '../element/base/fetching.js';
import { isEnglish } from './english.js';
import type { SpeechSource } from './source.js';
import workerUrl from './kokoro-worker.ts?worker&url';
import { openWorker } from './trusted.js';
import { WorkerSource } from './worker-source.js';

/** Voices of the library's figures, by figure. */
const VOICES: Record<string, string> = { sofia: 'af_heart', amara: 'af_bella', lia: 'bf_isabella', papous: 'am_michael', kenji: 'am_liam', nuno: 'am_fenrir' };
const USUAL = 'af_heart';
const MAX_LIST_BYTES = 1e6;

/** Returns the voice in a folder, whose address ends with a slash; undefined if there is none. Large files are not fetched yet. */
export async function kokoro(folder: URL): Promise<SpeechSource | undefined> {
  const list = await fetchText(new URL('voices.json', folder), { what: 'The list of voices', most: MAX_LIST_BYTES }).catch(() => undefined);
  if (list === undefined) return undefined;
  const voices = JSON.parse(list) as string[];
  return new WorkerSource({
    name: 'Kokoro',
    about: 'A natural voice.',
    license: 'Apache-2.0',
    speaks: isEnglish,
    voiceOf(figure) {
      const own = VOICES[figure] ?? USUAL;
      return voices.includes(own) ? own : (voices[0] ?? USUAL);
    },
    worker: () => openWorker(workerUrl, { name: folder.href, folder: 'voices/kokoro/' }),
  });
}
