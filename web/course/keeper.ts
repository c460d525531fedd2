/** Stores the state of a course in a record store: the latest state, until the store has confirmed it. */

import { RetryTimer } from './retry-timer.js';
import type { Outcome } from './store.js';

export class StateKeeper {
  readonly #put: (text: string) => Promise<Outcome>;
  readonly #told: (outcome: Outcome) => void;
  readonly #again = new RetryTimer(() => void this.#send());
  /** State in the store, and the state to store. */
  #kept: string;
  #wanted: string;
  #isSending = false;
  #isClosed = false;

  constructor(kept: string, put: (text: string) => Promise<Outcome>, told: (outcome: Outcome) => void) {
    this.#kept = this.#wanted = kept;
    this.#put = put;
    this.#told = told;
  }

  /** True if the store has the latest state. */
  get isKept(): boolean {
    return this.#kept === this.#wanted;
  }

  keep(text: string): void {
    this.#wanted = text;
    void this.#send();
  }

  /** Called when the page closes: sends unsent state in parallel with pending requests. */
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
