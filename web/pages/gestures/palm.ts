/**
 * Palm orientation: conversion between EML's normal and angle and directions of the hand. The engine computes both (`crate/web/src/palm.rs`; GEVH 3.5.1), so
 * that the page and the performance agree. Engine axes: x to the character's left, y up, z to the front.
 */

import { openInstance, type PalmFunctions } from '../../element/engine/backend.js';
import type { Backend } from '../../element/base/types.js';
import type { Hand, Vector3 } from './gesture.js';

/** Hand orientation: directions of the palm and of the fingers, orthogonal unit vectors. */
export interface HandDirections {
  readonly normal: Vector3;
  readonly fingers: Vector3;
}

/** Replacement for a zero normal: to the front, in EML's axes. */
const FRONT: Vector3 = [0, 0, -1];

const triple = (numbers: ArrayLike<number>, at: number): Vector3 => [numbers[at] ?? 0, numbers[at + 1] ?? 0, numbers[at + 2] ?? 0];

/** The engine's reading of palms. */
export class Palms {
  constructor(private readonly engine: PalmFunctions) {}

  static async open(backend: Backend): Promise<Palms> {
    return new Palms(await openInstance(backend));
  }

  /** Returns the directions that a normal and an angle mean for a hand. EML axes, degrees by the left-hand rule. */
  directionsOf(hand: Hand, normal: Vector3, angle: number): HandDirections {
    const read = (...[x, y, z]: Vector3): Float64Array => this.engine.handDirections(hand === 'left', x, y, z, Number.isFinite(angle) ? angle : 0);
    const known = read(...normal);
    const numbers = known.length === 0 ? read(...FRONT) : known;
    return { normal: triple(numbers, 0), fingers: triple(numbers, 3) };
  }

  /** The normal and angle, -180 to 180 degrees, of a hand's directions, in EML's axes. */
  palmOf(hand: Hand, { normal, fingers }: HandDirections): { normal: Vector3; angle: number } {
    const numbers = this.engine.palmOf(hand === 'left', Float64Array.of(...normal, ...fingers));
    return { normal: triple(numbers, 0), angle: numbers[3] ?? 0 };
  }
}
