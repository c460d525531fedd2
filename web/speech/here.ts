/** What speaks in this page; fetched only by stories that need it. */

import { flite } from './flite.js';
import type { SpeechSource } from './source.js';

const SOURCES: readonly SpeechSource[] = [flite];

/** The best that speaks a language, if any does; none where a page has no workers. */
export function sourceFor(language: string): SpeechSource | undefined {
  return typeof Worker === 'undefined' ? undefined : SOURCES.find((source) => source.speaks(language));
}
