/** What a course keeps in the browser until a system has it for good. */

import { joined, readMemory, writeMemory, type Memory } from './memory.js';

/** Keeps texts by name: the browser's `localStorage`, where a page may have it. */
export type Shelf = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** What is told all the time is kept so often. */
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
      // Forbidden: there is nothing.
      return undefined;
    }
  }

  /** Whether it is kept: a shelf may be full, or forbidden. */
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
      // Forbidden: there is nothing.
    }
  }
}

/**
 * The memory of a course beside that of its system. It is whole where a system has no room for all of it, and stays where a system
 * loses what it has confirmed.
 */
export class LocalCopy {
  readonly #slot: Slot;
  readonly #name: string;
  #putMs = -Infinity;
  /** What was written last: else another page of the course has. */
  #written: string | undefined;

  constructor(shelf: Shelf | undefined, name: string) {
    this.#slot = new Slot(shelf, name);
    this.#name = name;
    this.#written = this.#slot.get();
  }

  get(): Memory {
    return readMemory(this.#slot.get() ?? '');
  }

  /** Keeps a memory; whether that went. */
  put(memory: Memory): boolean {
    this.#putMs = performance.now();
    const stored = this.#slot.get();
    const text = writeMemory(stored === undefined || stored === this.#written ? memory : joined(memory, readMemory(stored)));
    this.#written = text;
    return this.#slot.set(text);
  }

  /** What another page of the course has written, by the browser's event of it. */
  others(key: string | null, text: string | null): Memory | undefined {
    return key === this.#name && text !== null ? readMemory(text) : undefined;
  }

  /** Keeps a memory that is told all the time, once a second: a page may go without a word. */
  follow(memory: Memory): void {
    if (performance.now() - this.#putMs >= FOLLOW_MS) this.put(memory);
  }

  clear(): void {
    this.#slot.clear();
  }
}
