/** Sends statements to a store, in order, and loses none: what the store has not taken is kept, and tried again. */

/** Keeps texts by name: the browser's `localStorage`, where a page may have it. */
export type Shelf = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** A statement of xAPI; its `id` makes sending it twice the same as sending it once. */
export interface Statement {
  readonly id: string;
  readonly [part: string]: unknown;
}

/** What became of a statement: the store has it, will never take it, or cannot be reached. */
export type Outcome = 'taken' | 'refused' | 'away';

/** The first wait after a failure; each further one doubles it. */
const FIRST_WAIT_MS = 1000;
const LONGEST_WAIT_MS = 30_000;
/** More than a session of many hours makes. */
const MOST = 5000;

export class Outbox {
  readonly #send: (statement: Statement) => Promise<Outcome>;
  readonly #shelf: Shelf | undefined;
  readonly #name: string;
  #waiting: Statement[];
  #isSending = false;
  #isClosed = false;
  #waitMs = FIRST_WAIT_MS;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `name`: under which unsent statements are kept for the next session, on the `shelf`. */
  constructor(name: string, shelf: Shelf | undefined, send: (statement: Statement) => Promise<Outcome>) {
    this.#name = name;
    this.#shelf = shelf;
    this.#send = send;
    this.#waiting = this.#kept();
  }

  /** What the store has not taken yet, in order. */
  get waiting(): readonly Statement[] {
    return this.#waiting;
  }

  add(statement: Statement): void {
    if (this.#waiting.length >= MOST) return;
    this.#waiting.push(statement);
    this.#keep();
    void this.flush();
  }

  /** Sends what waits, one after another; settles when all was taken or the store is away. */
  async flush(): Promise<void> {
    if (this.#isSending) return;
    this.#isSending = true;
    clearTimeout(this.#timer);
    for (let next = this.#waiting[0]; next !== undefined; next = this.#waiting[0]) {
      const outcome = await this.#send(next);
      if (outcome === 'away') {
        if (!this.#isClosed) this.#timer = setTimeout(() => void this.flush(), this.#waitMs);
        this.#waitMs = Math.min(LONGEST_WAIT_MS, 2 * this.#waitMs);
        break;
      }
      this.#waitMs = FIRST_WAIT_MS;
      this.#waiting.shift();
      this.#keep();
    }
    this.#isSending = false;
  }

  /** The page goes: nothing is tried again before the next session. */
  close(): void {
    this.#isClosed = true;
    clearTimeout(this.#timer);
  }

  #kept(): Statement[] {
    try {
      const list = JSON.parse(this.#shelf?.getItem(this.#name) ?? '[]') as unknown;
      return Array.isArray(list) ? list.filter((it): it is Statement => typeof (it as Statement | null)?.id === 'string').slice(0, MOST) : [];
    } catch {
      return [];
    }
  }

  #keep(): void {
    try {
      if (this.#waiting.length === 0) this.#shelf?.removeItem(this.#name);
      else this.#shelf?.setItem(this.#name, JSON.stringify(this.#waiting));
    } catch {
      // Full, or forbidden: it is sent all the same while the page is there.
    }
  }
}
