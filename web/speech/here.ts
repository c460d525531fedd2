/** What speaks in this page; fetched only by stories that need it. */

import { addedSources } from './added.js';
import type { SpeechSource } from './source.js';
import { type Place, usualSource } from './usual.js';

/** The best that speaks a language, if any does; none where a page has no workers. */
export async function sourceFor(language: string, place: Place): Promise<SpeechSource | undefined> {
  if (typeof Worker === 'undefined') return undefined;
  return addedSources().find((source) => source.speaks(language)) ?? (await usualSource(language, place));
}
