/** The history of a face: a tree, because who goes back and does something else keeps what was there. */

import type { FacePart } from '../element/face/faces.js';
import type { Act } from './acts.js';
import { faultOf } from './checks.js';
import { LIMITS } from './limits.js';
import type { Scene } from './scene.js';

/** One step. */
export interface Step {
  /** The step that it goes on from; −1 for the first. */
  readonly parent: number;
  readonly act: Act;
  /** A name that its author gave to the face after it. */
  readonly name?: string;
}

/** A history as it is saved; the format of files and of what the browser keeps. */
export interface SavedHistory {
  readonly format: 'raconteur-composite';
  /** The first version had no scene. */
  readonly version: 1 | 2;
  /** How many faces and vertices the pack has that its numbers are of. */
  readonly pack: { readonly faces: number; readonly vertices: number };
  readonly steps: readonly Step[];
  readonly here: number;
  /** How the face is shown. */
  readonly scene?: Scene;
}

export class History {
  #steps: Step[] = [{ parent: -1, act: { kind: 'average' } }];
  #here = 0;
  /** Where one went last from each step. */
  #next = new Map<number, number>();

  get steps(): readonly Step[] {
    return this.#steps;
  }

  /** The step whose face is shown. */
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

  /** Goes on by an act from here; the new step. */
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

  /** Goes to any step; redo leads along the way that led there. */
  go(index: number): void {
    this.#here = index;
    const path = this.path(index);
    path.slice(1).forEach((step, i) => this.#next.set(path[i] ?? 0, step));
  }

  /** Names the face that is shown; an empty name takes it away. */
  name(name: string): void {
    const { parent, act } = this.#step(this.#here);
    this.#steps[this.#here] = name === '' ? { parent, act } : { parent, act, name };
  }

  /** The steps from the first to one, which is the last. */
  path(to: number = this.#here): number[] {
    const path: number[] = [];
    for (let at = to; at >= 0; at = this.#step(at).parent) path.push(at);
    return path.reverse();
  }

  /** What is held after a step. */
  heldAt(index: number): Extract<Act, { kind: 'hold' }>['held'] {
    return this.#latest(index, 'hold')?.held ?? [];
  }

  /** What hair the head has after a step, and what it wears. */
  lookAt(index: number): Extract<Act, { kind: 'look' }>['look'] | undefined {
    return this.#latest(index, 'look')?.look;
  }

  /** What the face of a step began with: the average, a face of the database or one by chance. */
  #beginning(index: number): Act {
    for (let at = index; at > 0; at = this.#step(at).parent) {
      const { act } = this.#step(at);
      if (act.kind === 'example' || act.kind === 'average' || act.kind === 'random') return act;
    }
    return this.#step(0).act;
  }

  /** The face of the database that the face began with, at a step; undefined where it did not, or began anew since. */
  exampleAt(index: number): number | undefined {
    const act = this.#beginning(index);
    return act.kind === 'example' ? act.index : undefined;
  }

  /** The seed of the random face that the face began with, at a step; undefined where it did not, or began anew since. */
  randomAt(index: number): number | undefined {
    const act = this.#beginning(index);
    return act.kind === 'random' ? act.seed : undefined;
  }

  /** A number of its own for each face that a history began with: another one for another face, 0 for the average. */
  seedAt(index: number): number {
    const [example, random] = [this.exampleAt(index), this.randomAt(index)];
    if (example !== undefined) return 2 * example + 1;
    return random === undefined ? 0 : 2 * (random % 2 ** 30) + 2;
  }

  /** How much of an attribute the left half was given and the right half was taken since the face was begun. */
  asymmetryAt(index: number, part: FacePart, name: string): number {
    let sum = 0;
    for (let at = index; at >= 0; at = this.#step(at).parent) {
      const { act } = this.#step(at);
      if (act.kind === 'example' || act.kind === 'average' || act.kind === 'random') break;
      if (act.kind === 'asymmetry' && act.part === part && act.name === name) sum += act.amount;
    }
    return sum;
  }

  /** What is painted on the skin after a step. */
  marksAt(index: number): Extract<Act, { kind: 'marks' }>['marks'] {
    return this.#latest(index, 'marks')?.marks ?? [];
  }

  /** The last act of a kind on the way to a step. */
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

  /** The history that was saved; throws an `Error` that says what is wrong with it. */
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
