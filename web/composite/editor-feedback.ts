/** What the editor tells who uses it. */

/** Where the parts of the editor tell how it went. */
export interface EditorFeedback {
  /** Tells screen readers. */
  say(text: string): void;
  /** Shows what went wrong; an empty text takes it away. */
  trouble(text: string): void;
}

/** An error as a sentence. */
export const reason = (error: unknown): string => (error instanceof Error ? error.message : String(error));
