/** Sessions that the browser keeps, each of one tab at a time. */

import { createStore, del, entries, set } from 'idb-keyval';
import type { Saved } from './history.js';

/** How long a change waits for others before it is kept. */
const SOON_MS = 400;
/** Sessions that are kept; the oldest go. */
const MOST_SESSIONS = 20;

interface Kept {
  readonly at: number;
  readonly saved: Saved;
}

const lockOf = (id: string): string => `raconteur-composite-${id}`;

/** Holds a session while the tab is open; false where another tab has it. */
async function hold(id: string): Promise<boolean> {
  // Without locks, which old browsers lack, each tab has a session of its own.
  if (!('locks' in navigator)) return false;
  return await new Promise((resolve) => {
    void navigator.locks.request(lockOf(id), { ifAvailable: true }, async (lock) => {
      resolve(lock !== null);
      if (lock !== null) await new Promise(() => undefined);
    });
  });
}

export class Session {
  readonly #store = createStore('raconteur-composite', 'sessions');
  #id = '';
  #waiting: ReturnType<typeof setTimeout> | undefined;
  #latest: (() => Saved) | undefined;

  /** `trouble` hears when the browser cannot keep the session. */
  constructor(private readonly trouble: (reason: string) => void) {
    // What waits is kept before the tab goes.
    document.addEventListener('visibilitychange', () => {
      if (document.hidden) this.#keepNow();
    });
    addEventListener('pagehide', () => this.#keepNow());
  }

  /**
   * The session that was worked on last, where no other tab has it; else a copy of it, which is this tab's own.
   * Nothing where there is none.
   */
  async open(): Promise<unknown> {
    this.#id = crypto.randomUUID();
    try {
      const all = await entries<string, Kept>(this.#store);
      all.sort(([, a], [, b]) => b.at - a.at);
      const [latest] = all;
      for (const [old] of all.slice(MOST_SESSIONS)) await del(old, this.#store);
      if (latest !== undefined && (await hold(latest[0]))) this.#id = latest[0];
      else await hold(this.#id);
      return latest?.[1].saved;
    } catch (error) {
      this.#fail(error);
      return undefined;
    }
  }

  /** Keeps a session soon. */
  keep(latest: () => Saved): void {
    this.#latest = latest;
    this.#waiting ??= setTimeout(() => this.#keepNow(), SOON_MS);
  }

  #keepNow(): void {
    clearTimeout(this.#waiting);
    this.#waiting = undefined;
    const latest = this.#latest;
    this.#latest = undefined;
    if (latest === undefined) return;
    const kept: Kept = { at: Date.now(), saved: latest() };
    set(this.#id, kept, this.#store).catch((error: unknown) => this.#fail(error));
  }

  #fail(error: unknown): void {
    const why = error instanceof DOMException && error.name === 'QuotaExceededError' ? 'its storage is full' : error instanceof Error ? error.message : String(error);
    this.trouble(`The browser does not keep this session: ${why}. Save it as a file to keep it.`);
  }
}
