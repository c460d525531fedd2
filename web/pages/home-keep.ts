/** What was said as a story in a folder: the script and its voice, packed. Fetched with the first that is kept. */

import { zipSync } from 'fflate';
import { sourceFor } from '../speech/here.js';

/** The folder that a program unpacks. */
const FOLDER = 'my-story';

/** Packs a script with the voice that a figure has for it; without one where nothing speaks here. */
export async function pack(script: string, figure: string): Promise<Blob> {
  const text = new TextEncoder();
  const files: Record<string, Uint8Array> = { [`${FOLDER}/story.eml`]: text.encode(script) };
  const source = sourceFor('en');
  if (source !== undefined) {
    const { signal } = new AbortController();
    const said = await source.speak({ eml: script, voice: source.voiceOf(figure) }, { signal, progress: () => undefined });
    files[`${FOLDER}/voice/speech.json`] = text.encode(said.bundle);
    for (const [name, wave] of said.sounds) files[`${FOLDER}/voice/${name}`] = wave;
  }
  return new Blob([zipSync(files) as Uint8Array<ArrayBuffer>], { type: 'application/zip' });
}
