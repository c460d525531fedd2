/** What was said as a story in a folder: the script and its voice, packed. Fetched with the first that is kept. */

import { zipSync } from 'fflate';
import { sourceFor } from '../../speech/here.js';
import type { SpokenAudio } from '../../speech/source.js';

/** The folder that a program unpacks. */
const FOLDER = 'my-story';

/** Packs a script in a language with the voice that a figure has for it; without one where nothing speaks here. */
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
