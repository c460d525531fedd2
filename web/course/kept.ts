/** What a course keeps in the state of a record store, and beside it in the browser until the store has it. */

import type { Shelf } from './outbox.js';

/** What statements a registration may have once. */
export type Verdict = 'passed' | 'failed';

export interface Kept {
  readonly memory: string;
  readonly isComplete: boolean;
  /** What was said last of passing or failing. */
  readonly verdict?: Verdict | undefined;
}

/** As a text, which `readKept` reads. */
export const writeKept = ({ memory, isComplete, verdict }: Kept): string => JSON.stringify({ memory, isComplete, verdict });

/** What `writeKept` wrote; nothing where it was not that. */
export function readKept(text: string): Kept {
  try {
    const { memory, isComplete, verdict } = JSON.parse(text) as { memory?: unknown; isComplete?: unknown; verdict?: unknown };
    return {
      memory: typeof memory === 'string' ? memory : '',
      isComplete: isComplete === true,
      verdict: verdict === 'passed' || verdict === 'failed' ? verdict : undefined,
    };
  } catch {
    return { memory: '', isComplete: false };
  }
}

/** What the store has not confirmed yet, in the browser: a page may go before it can. */
export class Backup {
  readonly #shelf: Shelf | undefined;
  readonly #name: string;

  constructor(name: string, shelf: Shelf | undefined) {
    this.#name = name;
    this.#shelf = shelf;
  }

  /** Keeps a text that is on its way to a store, which has had `before`. */
  put(text: string, before: string): void {
    try {
      this.#shelf?.setItem(this.#name, JSON.stringify({ text, before }));
    } catch {
      // Full, or forbidden: the store may have it all the same.
    }
  }

  /** The store has it. */
  clear(): void {
    try {
      this.#shelf?.removeItem(this.#name);
    } catch {
      // Forbidden: there is nothing.
    }
  }

  /** What is known from the store's text and from this one. What was said is not said again; the place is the store's where that has changed. */
  join(stored: string): Kept {
    const theirs = readKept(stored);
    try {
      const { text, before } = JSON.parse(this.#shelf?.getItem(this.#name) ?? '{}') as { text?: unknown; before?: unknown };
      if (typeof text !== 'string') return theirs;
      const ours = readKept(text);
      const verdicts = [ours.verdict, theirs.verdict];
      return {
        memory: before === stored ? ours.memory : theirs.memory,
        isComplete: ours.isComplete || theirs.isComplete,
        verdict: verdicts.includes('passed') ? 'passed' : (ours.verdict ?? theirs.verdict),
      };
    } catch {
      return theirs;
    }
  }
}
