/**
 * Decoder of the element's `pose()`: positions of joints and targets, and the projection of world points onto the canvas. Loaded only by pages that draw over
 * the image.
 */

import type { PoseNumbers } from '../base/types.js';

/** A point or direction: x to the character's left, y up, z to the front; world, metres. */
export type Vector = readonly [x: number, y: number, z: number];

/** A point of the canvas, CSS pixels from its upper left corner. */
export interface ScreenPoint {
  readonly x: number;
  readonly y: number;
}

/** Joint of the figure. */
export interface PosedJoint {
  readonly name: string;
  /** Index of its parent; -1 for the root. */
  readonly parent: number;
  /** Position. */
  readonly position: Vector;
  /** Columns of its rotation: its own axes. */
  readonly axes: readonly [Vector, Vector, Vector];
}

/** Target of a hand or foot. */
export interface Target {
  readonly name: string;
  readonly position: Vector;
  /** Distance from the target, metres. */
  readonly error: number;
}

/** Last displayed pose of a player. */
export interface PoseNow {
  readonly joints: readonly PosedJoint[];
  readonly targets: readonly Target[];
  readonly camera: Lens;
  /** EML's coordinates: the speaker's origin, and metres a unit. */
  readonly origin: Vector;
  readonly metresPerUnit: number;
}

/** The numbers of a pose one after another: the layout is that of `Player::pose` in `crate/web`. */
class Numbers {
  #at = 0;

  constructor(private readonly numbers: ArrayLike<number>) {}

  next(): number {
    return this.numbers[this.#at++] ?? 0;
  }

  vector(): Vector {
    return [this.next(), this.next(), this.next()];
  }
}

/** Decodes the numbers of a pose; undefined before there is a figure. */
export function decodePose({ names, numbers }: { readonly names: readonly string[]; readonly numbers: ArrayLike<number> }): PoseNow | undefined {
  if (numbers.length === 0) return undefined;
  const reader = new Numbers(numbers);
  const camera = new Lens(reader.vector(), reader.vector(), reader.next(), reader.next(), reader.next(), reader.next());
  const origin = reader.vector();
  const metresPerUnit = reader.next();
  const count = reader.next();
  const joints = names
    .slice(0, count)
    .map((name): PosedJoint => ({ name, parent: reader.next(), axes: [reader.vector(), reader.vector(), reader.vector()], position: reader.vector() }));
  const targets = names.slice(count).map((name): Target => ({ name, position: reader.vector(), error: reader.next() }));
  return { joints, targets, camera, origin, metresPerUnit };
}

/** Returns the present pose of a player; undefined before it shows a frame. */
export function readPose(player: { pose(): PoseNumbers | undefined }): PoseNow | undefined {
  const told = player.pose();
  return told && decodePose(told);
}

export const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const along = (a: Vector, d: Vector, s: number): Vector => [a[0] + d[0] * s, a[1] + d[1] * s, a[2] + d[2] * s];
/** Normalises a direction; returns the direction away from the audience for a zero vector. */
export const unit = (a: Vector): Vector => {
  const length = Math.hypot(...a);
  return length > 0 ? [a[0] / length, a[1] / length, a[2] / length] : [0, 0, -1];
};

/** Camera of an image: from the world to the canvas and back. */
export class Lens {
  /** View direction, and the vectors to the image's right and upper edge. */
  readonly forward: Vector;
  readonly right: Vector;
  readonly up: Vector;
  /** Half the image's height and width at distance 1. */
  readonly #halfHeight: number;
  readonly #halfWidth: number;

  constructor(
    readonly eye: Vector,
    /** Target point of the camera. */
    readonly target: Vector,
    fovYRad: number,
    aspect: number,
    readonly near: number,
    readonly far: number,
  ) {
    this.forward = unit(minus(target, eye));
    this.right = unit(cross(this.forward, [0, 1, 0]));
    this.up = cross(this.right, this.forward);
    this.#halfHeight = Math.tan(fovYRad / 2);
    this.#halfWidth = this.#halfHeight * aspect;
  }

  /** Column-major clip-from-world matrix, depth from 0 (near) to 1. */
  get clipFromWorld(): number[] {
    const { eye, forward, right, up, near, far } = this;
    const row = (d: Vector, scale: number) => [d[0] * scale, d[1] * scale, d[2] * scale, -dot(d, eye) * scale];
    const depth = far / (far - near);
    const ahead = row(forward, 1);
    const rows = [row(right, 1 / this.#halfWidth), row(up, 1 / this.#halfHeight), ahead.map((a, i) => a * depth - (i === 3 ? near * depth : 0)), ahead];
    return [0, 1, 2, 3].flatMap((column) => rows.map((r) => r[column] ?? 0));
  }

  /** Projects a point to a canvas of this size; undefined behind the camera. */
  project(point: Vector, width: number, height: number): ScreenPoint | undefined {
    const from = minus(point, this.eye);
    const depth = dot(from, this.forward);
    if (depth < this.near) return undefined;
    return {
      x: (0.5 + (0.5 * dot(from, this.right)) / (depth * this.#halfWidth)) * width,
      y: (0.5 - (0.5 * dot(from, this.up)) / (depth * this.#halfHeight)) * height,
    };
  }

  /** Returns the point under a canvas position in the plane through `through` that has this `normal`; undefined if the view only grazes the plane. */
  unproject(spot: ScreenPoint, width: number, height: number, through: Vector, normal: Vector): Vector | undefined {
    const x = ((2 * spot.x) / width - 1) * this.#halfWidth;
    const y = (1 - (2 * spot.y) / height) * this.#halfHeight;
    const ray = along(along(this.forward, this.right, x), this.up, y);
    const slope = dot(ray, normal);
    if (Math.abs(slope) < 1e-3) return undefined;
    return along(this.eye, ray, dot(minus(through, this.eye), normal) / slope);
  }

  /** Returns the pixels per metre at a point. */
  pixelsPerMetre(point: Vector, height: number): number {
    return height / (2 * this.#halfHeight * Math.max(this.near, dot(minus(point, this.eye), this.forward)));
  }
}
