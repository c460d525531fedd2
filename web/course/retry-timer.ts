/** Tries again what did not work, each time after a longer wait. */

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

  /** It has failed: once more, after a while. */
  later(): void {
    if (this.#isClosed) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#act(), this.#waitMs);
    this.#waitMs = Math.min(MAX_WAIT_MS, 2 * this.#waitMs);
  }

  /** It has worked. */
  reset(): void {
    clearTimeout(this.#timer);
    this.#waitMs = FIRST_WAIT_MS;
  }

  /** Nothing is tried any more. */
  close(): void {
    this.#isClosed = true;
    clearTimeout(this.#timer);
  }
}

/** Asks until there is an answer, and says each time that there was none; undefined where the page went before. */
export async function until<T>(ask: () => Promise<T | undefined>, isClosed: () => boolean): Promise<T | undefined> {
  for (let waitMs = FIRST_WAIT_MS; !isClosed(); waitMs = Math.min(MAX_WAIT_MS, 2 * waitMs)) {
    const answer = await ask();
    if (answer !== undefined) return answer;
    await new Promise((over) => setTimeout(over, waitMs));
  }
  return undefined;
}
