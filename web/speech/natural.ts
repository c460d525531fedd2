/** The natural voice that `npm run voice` has put into a folder, whose address ends with a slash; undefined where none lies there. */

import type { SpeechSource } from './source.js';

export const naturalVoice = async (folder: URL): Promise<SpeechSource | undefined> => (await import('./kokoro.js')).kokoro(folder);
