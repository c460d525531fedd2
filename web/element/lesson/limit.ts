/** Time limit of an answer, extendable on request (WCAG 2.2.1: at least ten times). */

import type { QuestionWords } from './question-words.js';

/** Remaining time at which the learner is warned. */
const SOON_SECS = 20;
/** Maximum number of extensions. */
const MAX_MORE = 10;

/** Listener of the time limit. */
interface Listener {
  /** Called every second; `text` is given if it should be announced. */
  left(text: string | undefined): void;
  over(): void;
}

export class Limit {
  readonly #listener: Listener;
  #timer: ReturnType<typeof setInterval> | undefined;
  #words: QuestionWords | undefined;
  #allowedSecs = 0;
  #leftSecs = 0;
  #more = 0;

  constructor(listener: Listener) {
    this.#listener = listener;
  }

  /** Starts the timer, or none if there is no limit. */
  start(allowedSecs: number | undefined, words: QuestionWords): void {
    clearInterval(this.#timer);
    this.#timer = undefined;
    this.#words = words;
    this.#more = 0;
    this.#allowedSecs = this.#leftSecs = allowedSecs ?? 0;
    if (allowedSecs !== undefined) this.#timer = setInterval(() => this.#tick(), 1000);
  }

  /** Whole seconds left; undefined if there is no limit. */
  get leftSecs(): number | undefined {
    return this.#timer === undefined ? undefined : Math.max(0, Math.ceil(this.#leftSecs));
  }

  get mayHaveMore(): boolean {
    return this.#timer !== undefined && this.#more < MAX_MORE;
  }

  /** Restarts the full time. */
  more(): void {
    if (!this.mayHaveMore) return;
    this.#more += 1;
    this.#leftSecs = this.#allowedSecs;
    this.#listener.left(undefined);
  }

  #tick(): void {
    // The time limit does not run while the page is hidden.
    if (document.hidden) return;
    this.#leftSecs -= 1;
    if (this.#leftSecs > 0) {
      this.#listener.left(Math.ceil(this.#leftSecs) === SOON_SECS ? this.#words?.soon(SOON_SECS) : undefined);
      return;
    }
    clearInterval(this.#timer);
    this.#timer = undefined;
    this.#listener.over();
  }
}
