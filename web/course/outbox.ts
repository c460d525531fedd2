/** Reliable sender of statements to a store, in order and in batches: statements that the store has not accepted are stored, and sent again. */

import { RetryTimer } from './retry-timer.js';
import { Slot, type Shelf } from './shelf.js';
import { bytesOf, MAX_KEPT_BYTES, type Outcome, type Statement } from './store.js';
import type { StorageProblem } from './storage-problems.js';

/** Time within which statements are collected into a batch, milliseconds. */
const TOGETHER_MS = 1000;
const MAX_TOGETHER = 50;

interface Listener {
  /** Sends a batch atomically. */
  send(batch: readonly Statement[]): Promise<Outcome>;
  trouble(what: string, trouble: StorageProblem | undefined): void;
}

export class Outbox {
  readonly #slot: Slot;
  readonly #listener: Listener;
  readonly #again = new RetryTimer(() => void this.flush());
  /** Pending statements in order; rejected ones are last, and wait for the next session. */
  #waiting: readonly Statement[];
  readonly #refused = new Set<Statement>();
  /** The ids of those that the store has: another page may have them on the shelf still. */
  readonly #gone = new Set<string>();
  #running: Promise<void> | undefined;
  /** Number of leading statements in the current request. */
  #sending = 0;
  /** Number of statements to send individually after a rejected batch, so valid ones are accepted. */
  #single = 0;
  #isOpen = false;
  #isClosed = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** Creates the outbox; unsent statements are stored under `name` on the `shelf` for the next session. */
  constructor(name: string, shelf: Shelf | undefined, listener: Listener) {
    this.#slot = new Slot(shelf, name);
    this.#listener = listener;
    this.#waiting = statementsIn(this.#slot.get());
  }

  /** Statements not yet accepted by the store, in order. */
  get waiting(): readonly Statement[] {
    return this.#waiting;
  }

  /** Starts the session: arranges the pending statements by the caller's order, and sends them. */
  open(arrange: (waiting: readonly Statement[]) => readonly Statement[]): void {
    this.#waiting = arrange(this.#waiting);
    this.#keep();
    this.#isOpen = true;
    void this.flush();
  }

  add(statement: Statement): void {
    // Those that were refused stay behind.
    const at = this.#waiting.length - this.#refused.size;
    this.#waiting = [...this.#waiting.slice(0, at), statement, ...this.#waiting.slice(at)];
    this.#keep();
    if (this.#sending === 0) this.#timer ??= setTimeout(() => void this.flush(), TOGETHER_MS);
  }

  /** Sends pending statements, batch after batch; settles when all are accepted or the store is unavailable. */
  flush(): Promise<void> {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#running ??= this.#run().finally(() => (this.#running = undefined));
    return this.#running;
  }

  async #run(): Promise<void> {
    while (this.#isOpen && this.#sending === 0) {
      const batch = this.#next();
      if (batch.length === 0) return;
      if (!this.#took(batch, await this.#send(batch))) return;
    }
  }

  /** Called when the page closes: pending statements are sent once more, and then in the next session. */
  close(): void {
    this.#isClosed = true;
    this.#again.close();
    clearTimeout(this.#timer);
    if (!this.#isOpen) return;
    const late = this.#waiting.slice(this.#sending, this.#waiting.length - this.#refused.size);
    const batch = together(late, MAX_KEPT_BYTES - bytesOf(JSON.stringify(this.#waiting.slice(0, this.#sending))));
    const before = this.#running;
    const last = batch.length > 0 ? this.#listener.send(batch).then((outcome) => this.#tookLast(batch, outcome)) : undefined;
    this.#running = Promise.all([before, last]).then(() => undefined);
  }

  /** Handles the response to the final request, in case the page stays open. */
  #tookLast(batch: readonly Statement[], outcome: Outcome): void {
    if (outcome === 'taken') this.#drop(batch);
    this.#listener.trouble('statements', outcome === 'taken' ? undefined : outcome);
  }

  /** Settles when no request is pending. */
  async settle(): Promise<void> {
    await this.#running;
  }

  #next(): readonly Statement[] {
    const waiting = this.#waiting.slice(0, this.#waiting.length - this.#refused.size);
    return this.#single > 0 ? waiting.slice(0, 1) : together(waiting, MAX_KEPT_BYTES);
  }

  async #send(batch: readonly Statement[]): Promise<Outcome> {
    this.#sending = batch.length;
    const outcome = await this.#listener.send(batch);
    this.#sending = 0;
    return outcome;
  }

  /** Handles the response to a batch; returns true if more may be sent. */
  #took(batch: readonly Statement[], outcome: Outcome): boolean {
    const [first] = batch;
    if (first === undefined) return false;
    this.#listener.trouble('statements', outcome === 'away' || outcome === 'denied' ? outcome : undefined);
    switch (outcome) {
      case 'taken':
        this.#again.reset();
        this.#single = Math.max(0, this.#single - 1);
        this.#drop(batch);
        break;
      case 'refused':
        if (batch.length > 1) this.#single = batch.length;
        else {
          this.#single = Math.max(0, this.#single - 1);
          this.#setAside(first);
        }
        break;
      default:
        this.#again.later();
    }
    return !this.#isClosed && (outcome === 'taken' || outcome === 'refused');
  }

  #drop(batch: readonly Statement[]): void {
    const taken = new Set(batch);
    this.#waiting = this.#waiting.filter((statement) => !taken.has(statement));
    for (const { id } of batch) this.#gone.add(id);
    this.#keep();
  }

  #setAside(statement: Statement): void {
    this.#refused.add(statement);
    this.#waiting = [...this.#waiting.filter((it) => it !== statement), statement];
    this.#listener.trouble('a statement', 'refused');
    this.#keep();
  }

  /** Stores the pending statements, merged with those of other pages of the course on the shelf. */
  #keep(): void {
    const own = new Set(this.#waiting.map(({ id }) => id));
    const others = statementsIn(this.#slot.get()).filter(({ id }) => !own.has(id) && !this.#gone.has(id));
    const all = [...others, ...this.#waiting];
    if (all.length === 0) this.#slot.clear();
    else if (!this.#slot.set(JSON.stringify(all))) this.#listener.trouble('the browser', 'unkept');
  }
}

/** Returns the first of some statements, as many as fit into one request; at least one. */
function together(statements: readonly Statement[], mostBytes: number): readonly Statement[] {
  let bytes = 2;
  const end = statements.slice(0, MAX_TOGETHER).findIndex((statement) => (bytes += bytesOf(JSON.stringify(statement)) + 1) > mostBytes);
  return statements.slice(0, end < 0 ? MAX_TOGETHER : Math.max(1, end));
}

function statementsIn(text: string | undefined): readonly Statement[] {
  try {
    const list = JSON.parse(text ?? '[]') as unknown;
    return Array.isArray(list) ? list.filter((it): it is Statement => typeof (it as Statement | null)?.id === 'string') : [];
  } catch {
    return [];
  }
}
