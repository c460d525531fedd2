/** Storage key of the text, which survives a reload in the same tab. */

const KEY = 'raconteur.gestures';

/** Stores a text, if the browser provides storage. */
export function remember(text: string): void {
  try {
    sessionStorage.setItem(KEY, text);
  } catch {
    // Without storage (full or forbidden) only the restoration after a reload is lost.
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
