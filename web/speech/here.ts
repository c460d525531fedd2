/** What speaks in this page; fetched only by stories that need it. */

import { addedSources } from './added.js';
import { flite } from './flite.js';
import type { SpeechSource } from './source.js';

/** The best that speaks a language, if any does; none where a page has no workers. */
export function sourceFor(language: string): SpeechSource | undefined {
  return typeof Worker === 'undefined' ? undefined : [...addedSources(), flite].find((source) => source.speaks(language));
}
