/** Shared requests: one request for all users of a resource, which is aborted when none is left. */

/** Time for which a request continues after its last user has left, milliseconds: the next story often needs the same. */
const GRACE_MS = 1000;

interface SharedTask<T> {
  readonly done: Promise<T>;
  readonly abort: AbortController;
  waiting: number;
  settled: boolean;
}

export class SharedTasks<T> {
  readonly #works = new Map<string, SharedTask<T>>();
  readonly #graceMs: number;

  constructor(graceMs = GRACE_MS) {
    this.#graceMs = graceMs;
  }

  /**
   * Returns the result of `make` for a key, created once and cached. A failed one is repeated for the next caller. Rejects with the signal's reason as soon as
   * that is aborted; other callers keep waiting.
   */
  async get(key: string, signal: AbortSignal | undefined, make: (signal: AbortSignal) => Promise<T>): Promise<T> {
    signal?.throwIfAborted();
    const work = this.#works.get(key) ?? this.#begin(key, make);
    work.waiting += 1;
    let leave: (() => void) | undefined;
    try {
      if (signal === undefined) return await work.done;
      const left = new Promise<never>((_, reject) => {
        leave = () => reject(signal.reason as Error);
        signal.addEventListener('abort', leave, { once: true });
      });
      return await Promise.race([work.done, left]);
    } finally {
      if (leave !== undefined) signal?.removeEventListener('abort', leave);
      work.waiting -= 1;
      if (work.waiting === 0 && !work.settled) setTimeout(() => this.#leave(key, work), this.#graceMs);
    }
  }

  #begin(key: string, make: (signal: AbortSignal) => Promise<T>): SharedTask<T> {
    const abort = new AbortController();
    const work: SharedTask<T> = { done: make(abort.signal), abort, waiting: 0, settled: false };
    this.#works.set(key, work);
    work.done.then(
      () => (work.settled = true),
      () => this.#forget(key, work),
    );
    return work;
  }

  #leave(key: string, work: SharedTask<T>): void {
    if (work.waiting > 0 || work.settled) return;
    this.#forget(key, work);
    work.abort.abort();
  }

  #forget(key: string, work: SharedTask<T>): void {
    work.settled = true;
    if (this.#works.get(key) === work) this.#works.delete(key);
  }
}
