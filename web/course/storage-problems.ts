/** Problems that prevent a record from being saved, for display to learners. */

/**
 * A problem. `away`: the system does not respond. `denied`: the system no longer admits the course. `refused`: it rejects some data. `unkept`: the browser
 * itself cannot store.
 */
export type StorageProblem = 'away' | 'denied' | 'refused' | 'unkept';

/** Problems of a record, by source; reports the worst to its listener, and the end of all problems. */
export class StorageProblems {
  readonly #all = new Map<string, StorageProblem>();
  /** True if unsaved data are stored in this browser meanwhile. */
  isKept = true;
  #told: StorageProblem | undefined;
  #listener: (trouble: StorageProblem | undefined) => void = () => undefined;

  /** The present problem. */
  get now(): StorageProblem | undefined {
    return this.#told;
  }

  /** Sets the single listener, the page of the course, and immediately reports the present state. */
  listen(listener: (trouble: StorageProblem | undefined) => void): void {
    this.#listener = listener;
    if (this.#told !== undefined) listener(this.#told);
  }

  /** Sets or clears the problem of a source. */
  set(what: string, trouble: StorageProblem | undefined): void {
    if (trouble === undefined) this.#all.delete(what);
    else this.#all.set(what, trouble);
    const worst = (['denied', 'refused', 'away', 'unkept'] as const).find((it) => [...this.#all.values()].includes(it));
    if (worst === this.#told) return;
    this.#told = worst;
    this.#listener(worst);
  }
}
