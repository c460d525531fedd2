/**
 * Browser storage of sessions: IndexedDB, step by step, so each step costs the same; and a synchronous journal of data that IndexedDB has not confirmed, since
 * a killed tab loses pending writes.
 */

import { createStore, promisifyRequest } from 'idb-keyval';
import type { SavedHistory, Step } from './history.js';

/** Metadata of a stored session, without its steps. */
export interface Head {
  /** Time of the last change, milliseconds since 1970. */
  readonly at: number;
  readonly pack: SavedHistory['pack'];
  readonly here: number;
  readonly count: number;
  readonly scene?: SavedHistory['scene'];
  /** The name of its face. */
  readonly title?: string | undefined;
  /** Image of the session's face, as a data URL. */
  readonly picture?: string | undefined;
}

/** A stored session in a list. */
export interface Listed extends Head {
  readonly id: string;
}

/** Changes of a session. */
export interface Change {
  readonly head: Head;
  readonly steps: readonly (readonly [step: number, Step])[];
}

const JOURNAL = 'raconteur-composite ';

/** Keys of metadata and steps; keys of the former format, with a session in one piece, are a name and an identifier. */
const headKey = (name: string, id: string) => ['head', name, id];
const stepKey = (name: string, id: string, step: number) => ['step', name, id, step];
const below = (key: readonly string[]): IDBKeyRange => IDBKeyRange.bound([...key], [...key, []]);

/** The sessions of one name. */
export class SessionStore {
  readonly #store = createStore('raconteur-composite', 'sessions');

  constructor(private readonly name: string) {}

  /** Stores the changes of a session atomically. */
  async put(id: string, { head, steps }: Change): Promise<void> {
    await this.#store('readwrite', (store) => {
      for (const [i, step] of steps) store.put(step, stepKey(this.name, id, i));
      store.put(head, headKey(this.name, id));
      // No further request follows. Without this call the browser waits for the next turn of the
      // page, which may be gone by then.
      store.transaction.commit();
      return promisifyRequest(store.transaction);
    });
  }

  /** Returns all sessions, latest first. */
  async list(): Promise<Listed[]> {
    await this.#renew();
    const [keys, heads] = await this.#all<Head>(below(['head', this.name]));
    const listed = heads.map((head, i) => ({ ...head, id: String((keys[i] as string[])[2]) }));
    return listed.sort((a, b) => b.at - a.at);
  }

  /** Reads a saved session; undefined if there is none. */
  async read(id: string): Promise<SavedHistory | undefined> {
    const head = await this.#store('readonly', (store) => promisifyRequest<Head | undefined>(store.get(headKey(this.name, id))));
    if (head === undefined) return undefined;
    const [, steps] = await this.#all<Step>(below(['step', this.name, id]));
    const { pack, here, scene } = head;
    return { format: 'raconteur-composite', version: 2, pack, steps, here, ...(scene === undefined ? {} : { scene }) };
  }

  async delete(id: string): Promise<void> {
    this.journal(id).write(undefined);
    await this.#store('readwrite', (store) => {
      store.delete(headKey(this.name, id));
      store.delete(below(['step', this.name, id]));
      return promisifyRequest(store.transaction);
    });
  }

  /** Returns the journal of a session. */
  journal(id: string): Journal {
    return new Journal(JOURNAL + JSON.stringify([this.name, id]));
  }

  /** Returns the ids of the sessions of this name that have a journal. */
  journals(): string[] {
    return keysOfStorage().flatMap((key) => {
      const [name, id] = key.startsWith(JOURNAL) ? (JSON.parse(key.slice(JOURNAL.length)) as [string, string]) : [];
      return name === this.name && id !== undefined ? [id] : [];
    });
  }

  async #all<T>(range: IDBKeyRange): Promise<[keys: IDBValidKey[], values: T[]]> {
    return await this.#store('readonly', (store) => Promise.all([promisifyRequest(store.getAllKeys(range)), promisifyRequest<T[]>(store.getAll(range))]));
  }

  /** Converts sessions of the former format. */
  async #renew(): Promise<void> {
    const [keys, old] = await this.#all<{ readonly at: number; readonly saved: SavedHistory }>(below([this.name]));
    for (const [i, kept] of old.entries()) {
      const key = keys[i] as string[];
      const { at, saved } = kept ?? {};
      if (key.length !== 2 || !Array.isArray(saved?.steps)) continue;
      const { pack, here, steps } = saved;
      await this.put(String(key[1]), { head: { at: at ?? 0, pack, here, count: steps.length }, steps: [...steps.entries()] });
      await this.#store('readwrite', (store) => promisifyRequest(store.delete(key)));
    }
  }
}

/** Journal of pending session data; written before anything else. */
export class Journal {
  constructor(private readonly key: string) {}

  /** Writes a change; returns false if the page has no synchronous storage: then IndexedDB is the only storage. */
  write(change: Change | undefined): boolean {
    try {
      if (change === undefined) localStorage.removeItem(this.key);
      else localStorage.setItem(this.key, JSON.stringify(change));
      return true;
    } catch {
      return false;
    }
  }

  read(): Change | undefined {
    try {
      const { head, steps } = JSON.parse(localStorage.getItem(this.key) ?? '') as Partial<Change>;
      return head !== undefined && Array.isArray(steps) ? { head, steps } : undefined;
    } catch {
      return undefined;
    }
  }
}

function keysOfStorage(): string[] {
  try {
    return Object.keys(localStorage);
  } catch {
    return [];
  }
}
