/** Storage key of the text, which survives a reload in the same tab. */

const KEY = 'raconteur.gestures';

/** Stores a text, if the browser provides storage. */
export function remember(text: string): void {
  try {
    sessionStorage.setItem(KEY, text);
  } catch {
    // A full or forbidden store loses only what a reload would have brought back.
  }
}

/** Returns the stored text. */
export function remembered(): string | undefined {
  try {
    return sessionStorage.getItem(KEY) ?? undefined;
  } catch {
    return undefined;
  }
}
