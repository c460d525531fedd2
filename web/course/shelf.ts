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
  #putMs = -Infinity;

  constructor(shelf: Shelf | undefined, name: string) {
    this.#slot = new Slot(shelf, name);
  }

  get(): Memory {
    return readMemory(this.#slot.get() ?? '');
  }

  /** Keeps a memory; whether that went. */
  put(memory: Memory): boolean {
    this.#putMs = performance.now();
    return this.#slot.set(writeMemory(memory));
  }

  /** Keeps a memory that is told all the time, once a second: a page may go without a word. */
  follow(memory: Memory): void {
    if (performance.now() - this.#putMs >= FOLLOW_MS) this.put(memory);
  }

  clear(): void {
    this.#slot.clear();
  }

  /** The system's memory, with what this one has of the same attempt, or of a later one. */
  join(theirs: string): Memory {
    return joined(this.get(), readMemory(theirs));
  }
}
