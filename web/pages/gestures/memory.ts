/** What a reload must not lose: it stays with the tab. */

const KEY = 'raconteur.gestures';

/** Keeps a text, where the browser lets a page keep anything. */
export function remember(text: string): void {
  try {
    sessionStorage.setItem(KEY, text);
  } catch {
    // A full or forbidden store loses only what a reload would have brought back.
  }
}

/** The text that was kept. */
export function remembered(): string | undefined {
  try {
    return sessionStorage.getItem(KEY) ?? undefined;
  } catch {
    return undefined;
  }
}
