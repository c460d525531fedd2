/** Browser storage of a course until a system has confirmed the data. */

import { joined, readMemory, writeMemory, type Memory } from './memory.js';

/** Text storage by name: the browser's `localStorage`, if available to the page. */
export type Shelf = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** Minimum interval for saving continuously changing data, milliseconds. */
export const FOLLOW_MS = 1000;

/** A text on a shelf. */
export class Slot {
  readonly #shelf: Shelf | undefined;
  readonly #name: string;

  constructor(shelf: Shelf | undefined, name: string) {
    this.#shelf = shelf;
    this.#name = name;
  }

  get(): string | undefined {
    try {
      return this.#shelf?.getItem(this.#name) ?? undefined;
    } catch {
      // Storage is forbidden, so there is no data.
      return undefined;
    }
  }

  /** Stores a text; returns false if the storage is full or forbidden. */
  set(text: string): boolean {
    try {
      this.#shelf?.setItem(this.#name, text);
      return this.#shelf !== undefined;
    } catch {
      return false;
    }
  }

  clear(): void {
    try {
      this.#shelf?.removeItem(this.#name);
    } catch {
      // Storage is forbidden, so there is no data.
    }
  }
}

/** Local copy of a course's memory. It is complete if a system has no room for all of it, and survives if a system loses confirmed data. */
export class LocalCopy {
  readonly #slot: Slot;
  readonly #name: string;
  #putMs = -Infinity;
  /** Last text written here; a different stored text comes from another page of the course. */
  #written: string | undefined;

  constructor(shelf: Shelf | undefined, name: string) {
    this.#slot = new Slot(shelf, name);
    this.#name = name;
    this.#written = this.#slot.get();
  }

  get(): Memory {
    return readMemory(this.#slot.get() ?? '');
  }

  /** Stores a memory; returns false on failure. */
  put(memory: Memory): boolean {
    this.#putMs = performance.now();
    const stored = this.#slot.get();
    const text = writeMemory(stored === undefined || stored === this.#written ? memory : joined(memory, readMemory(stored)));
    this.#written = text;
    return this.#slot.set(text);
  }

  /** Returns the memory written by another page of the course, from the browser's `storage` event. */
  others(key: string | null, text: string | null): Memory | undefined {
    return key === this.#name && text !== null ? readMemory(text) : undefined;
  }

  /** Stores a continuously changing memory once a second, since a page may close without notice. */
  follow(memory: Memory): void {
    if (performance.now() - this.#putMs >= FOLLOW_MS) this.put(memory);
  }

  clear(): void {
    this.#slot.clear();
  }
}
