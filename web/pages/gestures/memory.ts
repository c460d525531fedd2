/** Storage of the text, which survives a reload in the same tab. */

import { StoredText } from '../stored-text.js';

const text = new StoredText('raconteur.gestures', () => sessionStorage);

/** Stores a text. Without storage only the restoration after a reload is lost. */
export function remember(value: string): void {
  text.set(value);
}

/** Returns the stored text. */
export function remembered(): string | undefined {
  return text.get();
}
