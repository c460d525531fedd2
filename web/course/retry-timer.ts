/** Retries failed operations with growing delays. */

/** The first wait after a failure; each further one doubles it. */
const FIRST_WAIT_MS = 1000;
const MAX_WAIT_MS = 60_000;

export class RetryTimer {
  readonly #act: () => void;
  #waitMs = FIRST_WAIT_MS;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isClosed = false;

  constructor(act: () => void) {
    this.#act = act;
  }

  /** Schedules another try after a failure. */
  later(): void {
    if (this.#isClosed) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#act(), this.#waitMs);
    this.#waitMs = Math.min(MAX_WAIT_MS, 2 * this.#waitMs);
  }

  /** Resets the wait after a success. */
  reset(): void {
    clearTimeout(this.#timer);
    this.#waitMs = FIRST_WAIT_MS;
  }

  /** Cancels all retries. */
  close(): void {
    this.#isClosed = true;
    clearTimeout(this.#timer);
  }
}

/** Repeats a request until there is an answer, and reports each failure; returns undefined if the page closed before. */
export async function until<T>(ask: () => Promise<T | undefined>, isClosed: () => boolean): Promise<T | undefined> {
  for (let waitMs = FIRST_WAIT_MS; !isClosed(); waitMs = Math.min(MAX_WAIT_MS, 2 * waitMs)) {
    const answer = await ask();
    if (answer !== undefined) return answer;
    await new Promise((over) => setTimeout(over, waitMs));
  }
  return undefined;
}
