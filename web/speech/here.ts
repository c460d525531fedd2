/** Speech sources in this page; fetched only by stories that need them. */

import { addedSources } from './added.js';
import type { SpeechSource } from './source.js';
import { type Place, usualSource } from './usual.js';

/** Returns the best source for a language, if there is one; none if the page has no workers. */
export async function sourceFor(language: string, place: Place): Promise<SpeechSource | undefined> {
  if (typeof Worker === 'undefined') return undefined;
  return addedSources().find((source) => source.speaks(language)) ?? (await usualSource(language, place));
}
