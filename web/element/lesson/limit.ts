/** The time for an answer, which whoever needs more gets (WCAG 2.2.1: ten times what was given, at least). */

import type { QuestionWords } from './question-words.js';

/** Then it is said that little is left. */
const SOON_SECS = 20;
/** More is given so often. */
const MAX_MORE = 10;

/** Who hears of the time. */
interface Listener {
  /** Another second is over; `text` where that is to be said. */
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

  /** Begins to count, or counts nothing where there is no limit. */
  start(allowedSecs: number | undefined, words: QuestionWords): void {
    clearInterval(this.#timer);
    this.#timer = undefined;
    this.#words = words;
    this.#more = 0;
    this.#allowedSecs = this.#leftSecs = allowedSecs ?? 0;
    if (allowedSecs !== undefined) this.#timer = setInterval(() => this.#tick(), 1000);
  }

  /** Whole seconds that are left; undefined where there is no limit. */
  get leftSecs(): number | undefined {
    return this.#timer === undefined ? undefined : Math.max(0, Math.ceil(this.#leftSecs));
  }

  get mayHaveMore(): boolean {
    return this.#timer !== undefined && this.#more < MAX_MORE;
  }

  /** Gives the whole time again. */
  more(): void {
    if (!this.mayHaveMore) return;
    this.#more += 1;
    this.#leftSecs = this.#allowedSecs;
    this.#listener.left(undefined);
  }

  #tick(): void {
    // Nobody thinks about what is not seen.
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
