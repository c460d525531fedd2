/** Keeps the state of a course in a record store: what was told last, until the store has it. */

import { RetryTimer } from './retry-timer.js';
import type { Outcome } from './store.js';

export class StateKeeper {
  readonly #put: (text: string) => Promise<Outcome>;
  readonly #told: (outcome: Outcome) => void;
  readonly #again = new RetryTimer(() => void this.#send());
  /** What the store has, and what it is to have. */
  #kept: string;
  #wanted: string;
  #isSending = false;
  #isClosed = false;

  constructor(kept: string, put: (text: string) => Promise<Outcome>, told: (outcome: Outcome) => void) {
    this.#kept = this.#wanted = kept;
    this.#put = put;
    this.#told = told;
  }

  /** The store has what was told last. */
  get isKept(): boolean {
    return this.#kept === this.#wanted;
  }

  keep(text: string): void {
    this.#wanted = text;
    void this.#send();
  }

  /** The page goes: what was not sent goes beside what is on its way. */
  close(): void {
    this.#isClosed = true;
    this.#again.close();
    if (this.#isSending && this.#wanted !== this.#kept) void this.#put(this.#wanted);
  }

  async #send(): Promise<void> {
    while (!this.#isSending && this.#wanted !== this.#kept) {
      const text = this.#wanted;
      this.#isSending = true;
      const outcome = await this.#put(text);
      this.#isSending = false;
      if (outcome === 'taken') this.#kept = text;
      this.#told(outcome);
      if (outcome !== 'taken') {
        if (!this.#isClosed) this.#again.later();
        return;
      }
      this.#again.reset();
    }
  }
}
