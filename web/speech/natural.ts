/** Natural voice stored by `npm run voice` in a folder, whose address ends with a slash; undefined if there is none. */

import type { SpeechSource } from './source.js';

export const naturalVoice = async (folder: URL): Promise<SpeechSource | undefined> => (await import('./kokoro.js')).kokoro(folder);
