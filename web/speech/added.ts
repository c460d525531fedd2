/** Sources of speech that a page adds. */

import type { SpeechServer } from './server.js';
import type { SpeechSource } from './source.js';

const added: SpeechSource[] = [];

/** Registers a speech source for all players of this page, before the existing ones, for the languages that it speaks. */
export function addSpeechSource(source: SpeechSource): void {
  if (!added.includes(source)) added.unshift(source);
}

/** Returns the added sources, last first. */
export const addedSources = (): readonly SpeechSource[] => added;

/** Creates a speech source from a speech server. */
export const speechServer = async (about: SpeechServer): Promise<SpeechSource> => (await import('./server.js')).server(about);
