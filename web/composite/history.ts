/** History of a face: a tree, so going back and doing something else keeps the earlier branch. */

import type { FacePart } from '../element/face/faces.js';
import type { Act } from './acts.js';
import { faultOf } from './checks.js';
import { LIMITS } from './limits.js';
import type { Scene } from './scene.js';

/** Step of the history. */
export interface Step {
  /** Parent step; −1 for the first. */
  readonly parent: number;
  readonly act: Act;
  /** A name that its author gave to the face after it. */
  readonly name?: string;
}

/** A saved history; the format of files and of the browser storage. */
export interface SavedHistory {
  readonly format: 'raconteur-composite';
  /** The first version had no scene. */
  readonly version: 1 | 2;
  /** Number of faces and vertices in the pack that its numbers refer to. */
  readonly pack: { readonly faces: number; readonly vertices: number };
  readonly steps: readonly Step[];
  readonly here: number;
  /** Display settings of the face. */
  readonly scene?: Scene;
}

export class History {
  #steps: Step[] = [{ parent: -1, act: { kind: 'average' } }];
  #here = 0;
  /** Last visited child of each step. */
  #next = new Map<number, number>();

  get steps(): readonly Step[] {
    return this.#steps;
  }

  /** Current step. */
  get here(): number {
    return this.#here;
  }

  get canUndo(): boolean {
    return this.#step(this.#here).parent >= 0;
  }

  get canRedo(): boolean {
    return this.#next.has(this.#here);
  }

  #step(index: number): Step {
    const step = this.#steps[index];
    if (step === undefined) throw new RangeError(`there is no step ${index}`);
    return step;
  }

  /** Adds an action after the current step; returns the new step. */
  add(act: Act): number {
    const index = this.#steps.push({ parent: this.#here, act }) - 1;
    this.#next.set(this.#here, index);
    this.#here = index;
    return index;
  }

  undo(): void {
    const { parent } = this.#step(this.#here);
    if (parent < 0) return;
    this.#next.set(parent, this.#here);
    this.#here = parent;
  }

  redo(): void {
    this.#here = this.#next.get(this.#here) ?? this.#here;
  }

  /** Goes to any step; redo follows the path that led there. */
  go(index: number): void {
    this.#here = index;
    const path = this.path(index);
    path.slice(1).forEach((step, i) => this.#next.set(path[i] ?? 0, step));
  }

  /** Names the current face; an empty name removes the name. */
  name(name: string): void {
    const { parent, act } = this.#step(this.#here);
    this.#steps[this.#here] = name === '' ? { parent, act } : { parent, act, name };
  }

  /** Returns the steps from the first to the given one, inclusive. */
  path(to: number = this.#here): number[] {
    const path: number[] = [];
    for (let at = to; at >= 0; at = this.#step(at).parent) path.push(at);
    return path.reverse();
  }

  /** Returns the constraints after a step. */
  heldAt(index: number): Extract<Act, { kind: 'hold' }>['held'] {
    return this.#latest(index, 'hold')?.held ?? [];
  }

  /** Returns the hair and accessories of the head after a step. */
  lookAt(index: number): Extract<Act, { kind: 'look' }>['look'] | undefined {
    return this.#latest(index, 'look')?.look;
  }

  /** Returns the initial action of a step's face: the average, a face of the database or a random one. */
  #beginning(index: number): Act {
    for (let at = index; at > 0; at = this.#step(at).parent) {
      const { act } = this.#step(at);
      if (act.kind === 'example' || act.kind === 'average' || act.kind === 'random') return act;
    }
    return this.#step(0).act;
  }

  /** Returns the database face from which the face at a step started; undefined if it started otherwise, or was restarted since. */
  exampleAt(index: number): number | undefined {
    const act = this.#beginning(index);
    return act.kind === 'example' ? act.index : undefined;
  }

  /** Returns the seed of the random face from which the face at a step started; undefined if it started otherwise, or was restarted since. */
  randomAt(index: number): number | undefined {
    const act = this.#beginning(index);
    return act.kind === 'random' ? act.seed : undefined;
  }

  /** Returns a unique number for each initial face of a history; 0 for the average. */
  seedAt(index: number): number {
    const [example, random] = [this.exampleAt(index), this.randomAt(index)];
    if (example !== undefined) return 2 * example + 1;
    return random === undefined ? 0 : 2 * (random % 2 ** 30) + 2;
  }

  /** Returns the amount of an attribute added to the left half and subtracted from the right half since the face was started. */
  asymmetryAt(index: number, part: FacePart, name: string): number {
    let sum = 0;
    for (let at = index; at >= 0; at = this.#step(at).parent) {
      const { act } = this.#step(at);
      if (act.kind === 'example' || act.kind === 'average' || act.kind === 'random') break;
      if (act.kind === 'asymmetry' && act.part === part && act.name === name) sum += act.amount;
    }
    return sum;
  }

  /** Returns the marks on the skin after a step. */
  marksAt(index: number): Extract<Act, { kind: 'marks' }>['marks'] {
    return this.#latest(index, 'marks')?.marks ?? [];
  }

  /** Returns the last action of a kind on the path to a step. */
  #latest<K extends Act['kind']>(index: number, kind: K): Extract<Act, { kind: K }> | undefined {
    for (let at = index; at >= 0; at = this.#step(at).parent) {
      const { act } = this.#step(at);
      if (act.kind === kind) return act as Extract<Act, { kind: K }>;
    }
    return undefined;
  }

  save(pack: SavedHistory['pack']): SavedHistory {
    return { format: 'raconteur-composite', version: 2, pack, steps: this.#steps, here: this.#here };
  }

  /** Reads a saved history; throws an `Error` that describes the fault. */
  static read(saved: unknown, pack: SavedHistory['pack']): History {
    const { format, version, pack: own, steps, here } = (typeof saved === 'object' && saved !== null ? saved : {}) as Partial<Record<keyof SavedHistory, unknown>>;
    if (format !== 'raconteur-composite') throw new Error('This is not a session of the composite editor.');
    if (version !== 1 && version !== 2) throw new Error('This session was saved by a newer version of the composite editor.');
    const { faces, vertices } = (typeof own === 'object' && own !== null ? own : {}) as Partial<SavedHistory['pack']>;
    if (faces !== pack.faces || vertices !== pack.vertices) throw new Error('This session was made with another pack of faces.');
    if (!Array.isArray(steps) || steps.length === 0) throw new Error('This session has no readable steps.');
    if (steps.length > LIMITS.steps) throw new Error(`This session has ${steps.length} steps, more than ${LIMITS.steps}.`);
    const read = steps.map((step: unknown, i): Step => {
      const { parent, act, name } = (typeof step === 'object' && step !== null ? step : {}) as Partial<Step>;
      const follows = i === 0 ? parent === -1 : Number.isSafeInteger(parent) && (parent as number) >= 0 && (parent as number) < i;
      const fault = follows ? faultOf(act) : 'it does not follow any earlier step';
      if (fault !== undefined) throw new Error(`This session cannot be read. Step ${i}: ${fault}.`);
      return { parent: parent as number, act: act as Act, ...(typeof name === 'string' && name !== '' ? { name: name.slice(0, 100) } : {}) };
    });
    if (!Number.isSafeInteger(here) || (here as number) < 0 || (here as number) >= read.length) throw new Error('This session does not specify which face it shows.');
    const history = new History();
    history.#steps = read;
    history.go(here as number);
    return history;
  }
}

/** @deprecated Use `SavedHistory`. */
export type Saved = SavedHistory;
