/** Cache of the faces of steps, bit-exact, so undo does not recompute them from the beginning. */

/** Number of most recently used faces that are kept; of the others only each nth. */
const LATEST = 64;
const EVERY = 32;

export class Cache {
  /** Faces by step, in the order of their last use. */
  readonly #faces = new Map<number, Uint8Array>();

  keep(step: number, face: Uint8Array): void {
    this.#faces.delete(step);
    this.#faces.set(step, face);
    let extra = this.#faces.size - LATEST;
    for (const old of this.#faces.keys()) {
      if (extra-- <= 0) break;
      if (old % EVERY !== 0) this.#faces.delete(old);
    }
  }

  get(step: number): Uint8Array | undefined {
    return this.#faces.get(step);
  }

  clear(): void {
    this.#faces.clear();
  }
}
