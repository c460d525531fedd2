/** Undo and redo for a page whose state is plain data. */

/** Steps that can be undone. */
const MAX_STEPS = 200;

export class UndoStack<S> {
  readonly #initial: string;
  readonly #past: string[] = [];
  readonly #future: string[] = [];
  /** The state that undo brings back. */
  #settled: string;

  constructor(initial: S) {
    this.#settled = this.#initial = JSON.stringify(initial);
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** The state is as it was in the beginning. */
  get isInitial(): boolean {
    return this.#settled === this.#initial;
  }

  /** What has changed since the last time is one step; false where nothing has. */
  settle(state: S): boolean {
    const now = JSON.stringify(state);
    if (now === this.#settled) return false;
    this.#past.push(this.#settled);
    if (this.#past.length > MAX_STEPS) this.#past.shift();
    this.#future.length = 0;
    this.#settled = now;
    return true;
  }

  /** The state before the last step; undefined where there is none. */
  undo(): S | undefined {
    return this.#step(this.#past, this.#future);
  }

  /** The state that was undone last. */
  redo(): S | undefined {
    return this.#step(this.#future, this.#past);
  }

  #step(from: string[], to: string[]): S | undefined {
    const next = from.pop();
    if (next === undefined) return undefined;
    to.push(this.#settled);
    this.#settled = next;
    return JSON.parse(next) as S;
  }
}
