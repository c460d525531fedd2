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

/** A server that speaks. */
export const speechServer = async (about: SpeechServer): Promise<SpeechSource> => (await import('./server.js')).server(about);
