/** Default speech source: flite, which is built into the site. The player's package has `web/package/player/usual.ts` instead, which searches for it. */

import type { Diagnostic } from '../element/base/types.js';
import { flite } from './flite.js';
import type { SpeechSource } from './source.js';

/** Search location, and the callback for the reason if it is missing. */
export interface Place {
  /** The folder of the library; ends with a slash. */
  readonly library: URL;
  readonly report: (problem: Diagnostic) => void;
}

/** Returns the source for a language, if there is one. */
export function usualSource(language: string, _place: Place): Promise<SpeechSource | undefined> {
  return Promise.resolve(flite.speaks(language) ? flite : undefined);
}
