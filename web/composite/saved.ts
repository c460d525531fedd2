/** Saved sessions as text, from a file or an address. */

import { fetchText } from '../element/base/fetching.js';
import { LIMITS } from './limits.js';

/** Parses a text; throws an `Error` with a message for users. */
export function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error('This is not a session of the composite editor.');
  }
}

/** Fetches the session at an address, relative to the page. */
export async function fetchSaved(src: string): Promise<unknown> {
  return parse(await fetchText(new URL(src, document.baseURI), { what: 'The saved session', most: LIMITS.bytes }));
}
