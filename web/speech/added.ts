/** Sources of speech that a page adds. */

import type { SpeechServer } from './server.js';
import type { SpeechSource } from './source.js';

const added: SpeechSource[] = [];

/** Has a source speak in all players of this page, before those that are there, for the languages that it speaks. */
export function addSpeechSource(source: SpeechSource): void {
  if (!added.includes(source)) added.unshift(source);
}

/** The added sources, the last first. */
export const addedSources = (): readonly SpeechSource[] => added;

/** The natural voice that `npm run voice` has put into a folder, whose address ends with a slash; undefined where none lies there. */
export const naturalVoice = async (folder: URL): Promise<SpeechSource | undefined> => (await import('./kokoro.js')).kokoro(folder);

/** A server that speaks. */
export const speechServer = async (about: SpeechServer): Promise<SpeechSource> => (await import('./server.js')).server(about);
