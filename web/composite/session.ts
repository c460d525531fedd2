/** Sessions that the browser keeps, each of one editor at a time. */

import { createStore, del, entries, set } from 'idb-keyval';
import type { Saved } from './history.js';

/** How long a change waits for others before it is kept. */
const SOON_MS = 400;
/** Sessions of one name that are kept; the oldest go. */
const MOST_SESSIONS = 20;

interface Kept {
  readonly at: number;
  readonly saved: Saved;
}

const lockOf = (id: string): string => `raconteur-composite-${id}`;

/** Holds a session while the tab is open, or until `end`; false where another editor has it. */
async function hold(id: string, end: AbortSignal): Promise<boolean> {
  // Without locks, which old browsers lack, each editor has a session of its own.
  if (!('locks' in navigator)) return false;
  return await new Promise((resolve) => {
    void navigator.locks.request(lockOf(id), { ifAvailable: true }, async (lock) => {
      resolve(lock !== null);
      if (lock !== null && !end.aborted) await new Promise((freed) => end.addEventListener('abort', freed));
    });
  });
}

export class Session {
  readonly #store = createStore('raconteur-composite', 'sessions');
  #id = '';
  #waiting: ReturnType<typeof setTimeout> | undefined;
  #latest: (() => Saved) | undefined;
  #end = new AbortController();

  /** `name` tells the sessions of one page from those of another; `trouble` hears when the browser cannot keep the session. */
  constructor(
    private readonly name: string,
    private readonly trouble: (reason: string) => void,
  ) {}

  /**
   * The session that was worked on last, where no other editor has it; else a copy of it, which is this editor's own.
   * Nothing where there is none.
   */
  async open(): Promise<unknown> {
    this.#listen();
    try {
      this.#id = crypto.randomUUID();
      const all = (await entries<[name: string, id: string], Kept>(this.#store)).filter(([[name]]) => name === this.name);
      all.sort(([, a], [, b]) => b.at - a.at);
      const [latest] = all;
      for (const [old] of all.slice(MOST_SESSIONS)) await del(old, this.#store);
      if (latest !== undefined && (await hold(latest[0][1], this.#end.signal))) this.#id = latest[0][1];
      else await hold(this.#id, this.#end.signal);
      return latest?.[1].saved;
    } catch (error) {
      this.#fail(error);
      return undefined;
    }
  }

  /** Lets others have the session; what waits is kept. */
  close(): void {
    this.#keepNow();
    this.#end.abort();
  }

  /** Goes on after `close`, with a copy where another editor has taken the session. */
  async resume(): Promise<void> {
    this.#end = new AbortController();
    this.#listen();
    if (await hold(this.#id, this.#end.signal)) return;
    this.#id = crypto.randomUUID();
    await hold(this.#id, this.#end.signal);
  }

  /** Keeps a session soon. */
  keep(latest: () => Saved): void {
    this.#latest = latest;
    this.#waiting ??= setTimeout(() => this.#keepNow(), SOON_MS);
  }

  /** What waits is kept before the tab goes. */
  #listen(): void {
    const { signal } = this.#end;
    document.addEventListener('visibilitychange', () => document.hidden && this.#keepNow(), { signal });
    addEventListener('pagehide', () => this.#keepNow(), { signal });
  }

  #keepNow(): void {
    clearTimeout(this.#waiting);
    this.#waiting = undefined;
    const latest = this.#latest;
    this.#latest = undefined;
    if (latest === undefined) return;
    const kept: Kept = { at: Date.now(), saved: latest() };
    set([this.name, this.#id], kept, this.#store).catch((error: unknown) => this.#fail(error));
  }

  #fail(error: unknown): void {
    const why = error instanceof DOMException && error.name === 'QuotaExceededError' ? 'its storage is full' : error instanceof Error ? error.message : String(error);
    this.trouble(`The browser does not keep this session: ${why}. Save it as a file to keep it.`);
  }
}
