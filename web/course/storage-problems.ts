/** What keeps a record from being kept, for learners to see. */

/**
 * `away`: nobody answers. `denied`: the system does not let the course in any more. `refused`: it does not take something.
 * `unkept`: the browser itself keeps nothing.
 */
export type StorageProblem = 'away' | 'denied' | 'refused' | 'unkept';

/** Troubles of a record, each by what has it; tells its listener of the worst, and when there is none any more. */
export class StorageProblems {
  readonly #all = new Map<string, StorageProblem>();
  /** What is not saved is kept in this browser meanwhile. */
  isKept = true;
  #told: StorageProblem | undefined;
  #listener: (trouble: StorageProblem | undefined) => void = () => undefined;

  /** What there is now. */
  get now(): StorageProblem | undefined {
    return this.#told;
  }

  /** There is one listener: the page of the course. It is told at once of what there is. */
  listen(listener: (trouble: StorageProblem | undefined) => void): void {
    this.#listener = listener;
    if (this.#told !== undefined) listener(this.#told);
  }

  /** `what` has a trouble, or has none any more. */
  set(what: string, trouble: StorageProblem | undefined): void {
    if (trouble === undefined) this.#all.delete(what);
    else this.#all.set(what, trouble);
    const worst = (['denied', 'refused', 'away', 'unkept'] as const).find((it) => [...this.#all.values()].includes(it));
    if (worst === this.#told) return;
    this.#told = worst;
    this.#listener(worst);
  }
}
