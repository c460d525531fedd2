/** Export of the spoken text as a story folder: script and voice, zipped. Fetched at the first export. */

import { zipSync } from 'fflate';
import { sourceFor } from '../../speech/here.js';
import type { SpokenAudio } from '../../speech/source.js';

/** The folder that a program unpacks. */
const FOLDER = 'my-story';

/** Packs a script in a language with a figure's voice for it; without one if no engine is available. */
export async function pack(script: string, figure: string, language: string): Promise<Blob> {
  const text = new TextEncoder();
  const files: Record<string, Uint8Array> = { [`${FOLDER}/story.eml`]: text.encode(script) };
  const source = await sourceFor(language, { library: new URL('assets/', document.baseURI), report: () => undefined });
  const take = ({ bundle, sounds }: SpokenAudio) => {
    files[`${FOLDER}/voice/speech.json`] = text.encode(bundle);
    for (const [name, wave] of sounds) files[`${FOLDER}/voice/${name}`] = wave;
  };
  const { signal } = new AbortController();
  await source?.speak({ eml: script, voice: source.voiceOf(figure, language) }, { signal, progress: () => undefined, take });
  return new Blob([zipSync(files) as Uint8Array<ArrayBuffer>], { type: 'application/zip' });
}
