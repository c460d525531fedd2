/** Sessions stored by the browser, each used by one editor at a time. */

import type { SavedHistory, Step } from './history.js';
import { SessionStore, type Change, type Head, type Listed } from './session-store.js';

/** Delay after which view changes are stored, milliseconds; steps are stored immediately. */
const SOON_MS = 250;

const lockOf = (id: string): string => `raconteur-composite-${id}`;

/** Locks a session while the tab is open, or until `end`; returns false if another editor holds it. */
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

/** The session that an editor begins with. */
export interface OpenedSession {
  readonly saved: SavedHistory;
  /** Another editor has it: this is a copy. */
  readonly isCopy: boolean;
}

export class Session {
  readonly #shelf: SessionStore;
  /** Key under which the tab stores its session. */
  readonly #tabKey: string;
  #id = crypto.randomUUID() as string;
  /** Aborts when this editor releases its session. */
  #held = new AbortController();
  /** Aborts the listeners on the page. */
  #open = new AbortController();
  /** Steps in the form passed for storage, and the scene. */
  #given: Step[] = [];
  #scene = '';
  #picture: string | undefined;
  /** Data not yet confirmed by IndexedDB: steps by their number, each with the number of its change. */
  readonly #pending = new Map<number, { readonly step: Step; readonly change: number }>();
  #changes = 0;
  /** The last change of each session that this editor has had. */
  readonly #last = new Map<string, number>();
  #waiting: ReturnType<typeof setTimeout> | undefined;
  #soon: (() => SavedHistory) | undefined;

  /** Creates the store; `name` separates the sessions of different pages; `trouble` is called when the browser cannot store the session. */
  constructor(
    name: string,
    private readonly trouble: (reason: string) => void,
  ) {
    this.#shelf = new SessionStore(name);
    this.#tabKey = `raconteur-composite ${name}`;
  }

  get id(): string {
    return this.#id;
  }

  /** Opens the last session, if no other editor holds it; else a copy of it for this editor. Returns undefined if there is none. */
  async open(): Promise<OpenedSession | undefined> {
    this.#listen();
    try {
      await this.#recover();
      const listed = await this.#shelf.list();
      // A reloaded tab continues with its own work.
      const own = this.#ofTab();
      this.#remember();
      const latest = listed.find(({ id }) => id === own) ?? listed[0];
      const saved = latest && (await this.#shelf.read(latest.id));
      if (latest === undefined || saved === undefined) {
        await hold(this.#id, this.#held.signal);
        return undefined;
      }
      const isOwn = await hold(latest.id, this.#held.signal);
      if (isOwn) this.#take(latest.id, latest.picture);
      else await hold(this.#id, this.#held.signal);
      return { saved, isCopy: !isOwn && 'locks' in navigator };
    } catch (error) {
      this.#fail(error);
      return undefined;
    }
  }

  #ofTab(): string | undefined {
    try {
      return sessionStorage.getItem(this.#tabKey) ?? undefined;
    } catch {
      return undefined;
    }
  }

  #remember(): void {
    try {
      sessionStorage.setItem(this.#tabKey, this.#id);
    } catch {
      // Then the latest session of all tabs is opened next time.
    }
  }

  /** Recovers data from the journals of killed tabs. */
  async #recover(): Promise<void> {
    for (const id of this.#shelf.journals()) {
      const end = new AbortController();
      const isFree = (await hold(id, end.signal)) || !('locks' in navigator);
      const journal = this.#shelf.journal(id);
      const change = journal.read();
      if (isFree && change !== undefined) await this.#shelf.put(id, change);
      if (isFree) journal.write(undefined);
      end.abort();
    }
  }

  /** Marks the open session as stored, after it was read from storage. */
  adopt({ steps, scene }: SavedHistory): void {
    this.#given = [...steps];
    this.#scene = JSON.stringify(scene);
  }

  /** Begins another session, which is stored whole with its first step; the previous one remains. */
  async begin(): Promise<void> {
    this.#held.abort();
    this.#held = new AbortController();
    this.#take(crypto.randomUUID(), undefined);
    // By then other tabs can acquire the previous session.
    await hold(this.#id, this.#held.signal);
  }

  #take(id: string, picture: string | undefined): void {
    // Pending work belongs to the new session.
    clearTimeout(this.#waiting);
    this.#soon = undefined;
    this.#id = id;
    this.#remember();
    this.#picture = picture;
    this.#given = [];
    this.#scene = '';
    this.#pending.clear();
  }

  /** Stores the changes of a session immediately; an unchanged face is stored only with `always`. */
  keep(saved: SavedHistory, always = false): void {
    clearTimeout(this.#waiting);
    this.#soon = undefined;
    const { steps } = saved;
    if (!always && this.#given.length === 0 && steps.length === 1) return;
    const change = ++this.#changes;
    steps.forEach((step, i) => {
      if (this.#given[i] !== step) this.#pending.set(i, { step, change });
    });
    this.adopt(saved);
    const id = this.#id;
    this.#last.set(id, change);
    const head = this.#head(saved);
    const whole: Change = { head, steps: [...this.#pending].map(([i, { step }]) => [i, step]) };
    const journal = this.#shelf.journal(id);
    journal.write(whole);
    this.#shelf.put(id, whole).then(
      () => {
        if (id === this.#id) for (const [i, pending] of this.#pending) if (pending.change <= change) this.#pending.delete(i);
        // A later change has written all that was pending by then.
        if (change === this.#last.get(id)) journal.write(undefined);
      },
      (error: unknown) => this.#fail(error),
    );
  }

  #head({ pack, here, steps, scene }: SavedHistory): Head {
    const title = steps[here]?.name;
    return { at: Date.now(), pack, here, count: steps.length, scene, title, picture: this.#picture };
  }

  /** Stores the display settings once they rest, if they have changed. */
  keepSoon(latest: () => SavedHistory): void {
    this.#soon = latest;
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => this.#now(), SOON_MS);
  }

  /** Stores pending data before another session is opened. */
  settle(): void {
    this.#now();
  }

  /** Sets the thumbnail of the face, which is stored with the next data. */
  pictured(picture: string, latest: () => SavedHistory): void {
    this.#picture = picture;
    if (this.#given.length > 0) this.keep(latest());
  }

  #now(): void {
    clearTimeout(this.#waiting);
    const saved = this.#soon?.();
    this.#soon = undefined;
    if (saved === undefined) return;
    const scene = JSON.stringify(saved.scene);
    // The initial scene of the editor is not a change.
    if (this.#scene === '') this.#scene = scene;
    if (scene !== this.#scene) this.keep(saved, true);
  }

  // --- the list ---

  /** Returns all stored sessions, latest first, and those held by other editors. */
  async list(): Promise<{ readonly listed: readonly Listed[]; readonly taken: ReadonlySet<string> }> {
    const [listed, locks] = await Promise.all([this.#shelf.list(), 'locks' in navigator ? navigator.locks.query() : undefined]);
    const names = new Set(locks?.held?.map(({ name }) => name));
    return { listed, taken: new Set(listed.map(({ id }) => id).filter((id) => id !== this.#id && names.has(lockOf(id)))) };
  }

  /** Reads a stored session. */
  read(id: string): Promise<SavedHistory | undefined> {
    return this.#shelf.read(id);
  }

  /** Continues a stored session; returns false if another editor holds it: a copy is then stored. */
  async goOn(id: string, picture: string | undefined): Promise<boolean> {
    const end = new AbortController();
    if (!(await hold(id, end.signal))) {
      await this.begin();
      return false;
    }
    this.#held.abort();
    this.#held = end;
    this.#take(id, picture);
    return true;
  }

  async delete(id: string): Promise<void> {
    await this.#shelf.delete(id);
  }

  // --- life ---

  /** Releases the session and stores pending data. */
  close(): void {
    this.#now();
    this.#open.abort();
    this.#held.abort();
  }

  /** Continues after `close`, with a copy if another editor has taken the session. */
  async resume(): Promise<void> {
    this.#open = new AbortController();
    this.#held = new AbortController();
    this.#listen();
    if (!(await hold(this.#id, this.#held.signal))) await this.begin();
  }

  /** Stores pending data before the tab closes. */
  #listen(): void {
    const { signal } = this.#open;
    document.addEventListener('visibilitychange', () => document.hidden && this.#now(), { signal });
    addEventListener('pagehide', () => this.#now(), { signal });
  }

  #fail(error: unknown): void {
    const why = error instanceof DOMException && error.name === 'QuotaExceededError' ? 'its storage is full' : error instanceof Error ? error.message : String(error);
    this.trouble(`The browser cannot store this session: ${why}. Save it as a file.`);
  }
}
