/** Default speech source: flite, from its own package, if that was copied below the library. Searched when needed. */

import { shown } from '../../element/base/fetching.js';
import type { Diagnostic } from '../../element/base/types.js';
import { isEnglish } from '../../speech/english.js';
import type { SpeechSource } from '../../speech/source.js';
import type { Place } from '../../speech/usual.js';

/** Path of flite in the library's folder; `raconteur-library` copies it there. */
const FLITE = 'voices/flite/flite.js';

/** Search results by address, a source or an error: a page searches once. */
const found = new Map<string, Promise<SpeechSource | Diagnostic>>();

async function look(address: string): Promise<SpeechSource | Diagnostic> {
  try {
    // A file that the page serves and that its own build does not know.
    const { flite } = (await import(/* @vite-ignore */ /* webpackIgnore: true */ /* turbopackIgnore: true */ address)) as { flite: SpeechSource };
    return flite;
  } catch (error) {
    console.warn('raconteur: no voice', error);
    return {
      code: 'voice-not-installed',
      severity: 'warning',
      message: `The voice flite could not be loaded from ${shown(new URL(address))}: what has no recording is left to the browser's own voice.`,
      hints: ['Install @raconteur/voice-flite and run “npx raconteur-library FOLDER --voices flite”, where FOLDER is the one that “assets” names.'],
    };
  }
}

/** Returns the source for a language, if there is one. */
export async function usualSource(language: string, { library, report }: Place): Promise<SpeechSource | undefined> {
  if (!isEnglish(language)) return undefined;
  const { href } = new URL(FLITE, library);
  const looking = found.get(href) ?? look(href);
  found.set(href, looking);
  const source = await looking;
  if ('speak' in source) return source;
  report(source);
  return undefined;
}
