/** What speaks where a page has added nothing: flite, which is built into the site. The player's package has `web/package/player/usual.ts` instead, which looks for it. */

import type { Diagnostic } from '../element/base/types.js';
import { flite } from './flite.js';
import type { SpeechSource } from './source.js';

/** Where it is looked for, and who hears why it is not there. */
export interface Place {
  /** The folder of the library; ends with a slash. */
  readonly library: URL;
  readonly report: (problem: Diagnostic) => void;
}

/** What speaks a language, if it does. */
export function usualSource(language: string, _place: Place): Promise<SpeechSource | undefined> {
  return Promise.resolve(flite.speaks(language) ? flite : undefined);
}
