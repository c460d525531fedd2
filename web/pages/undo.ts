/** Undo and redo for a page whose state is plain data. */

/** Steps that can be undone. */
const MAX_STEPS = 200;

export class UndoStack<S> {
  readonly #initial: string;
  readonly #past: string[] = [];
  readonly #future: string[] = [];
  /** State restored by undo. */
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

  /** True if the state is the initial one. */
  get isInitial(): boolean {
    return this.#settled === this.#initial;
  }

  /** Records the changes since the last call as one step; false if there are none. */
  settle(state: S): boolean {
    const now = JSON.stringify(state);
    if (now === this.#settled) return false;
    this.#past.push(this.#settled);
    if (this.#past.length > MAX_STEPS) this.#past.shift();
    this.#future.length = 0;
    this.#settled = now;
    return true;
  }

  /** Returns the state before the last step; undefined if there is none. */
  undo(): S | undefined {
    return this.#step(this.#past, this.#future);
  }

  /** Returns the state that was undone last. */
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
