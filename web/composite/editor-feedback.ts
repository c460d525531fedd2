/** Messages of the editor to its user. */

/** Message sink of the editor's parts. */
export interface EditorFeedback {
  /** Announces a text to screen readers. */
  say(text: string): void;
  /** Shows an error message; an empty text removes it. */
  trouble(text: string): void;
}

/** Returns the message of an error as a sentence. */
export const reason = (error: unknown): string => (error instanceof Error ? error.message : String(error));
