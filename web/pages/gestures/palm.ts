/**
 * Where a palm looks: the normal and angle of EML, and the rotation of the hand that they mean
 * (GEVH 3.5.1; the reading is that of `crate/actor/src/palm.rs`). Engine axes: x to the
 * character's left, y up, z to the front.
 */

import type { Hand, Triple } from './gesture.js';

export type Quaternion = readonly [x: number, y: number, z: number, w: number];

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;
export const degrees = (rad: number): number => (rad * 180) / Math.PI;

/** EML's axes have z to the back, the engine's to the front. */
export const flipDepth = ([x, y, z]: Triple): Triple => [x, y, z === 0 ? 0 : -z];

export function unit([x, y, z]: Triple): Triple {
  const length = Math.hypot(x, y, z);
  return length > 0 ? [x / length, y / length, z / length] : [0, 0, 1];
}

export const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Triple, b: Triple): Triple => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export function aboutAxis(axis: Triple, angle: number): Quaternion {
  const [x, y, z] = unit(axis);
  const s = Math.sin(angle / 2);
  return [x * s, y * s, z * s, Math.cos(angle / 2)];
}

/** First `b`, then `a`. */
export function times(a: Quaternion, b: Quaternion): Quaternion {
  const [ax, ay, az, aw] = a;
  const [bx, by, bz, bw] = b;
  return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

export function turn([x, y, z, w]: Quaternion, v: Triple): Triple {
  const t = cross([x, y, z], v);
  const [tx, ty, tz] = [2 * t[0], 2 * t[1], 2 * t[2]];
  const u = cross([x, y, z], [tx, ty, tz]);
  return [v[0] + w * tx + u[0], v[1] + w * ty + u[1], v[2] + w * tz + u[2]];
}

/** The smallest turn that carries one unit vector to another; half a turn about the vertical when they are opposed. */
function arc(from: Triple, to: Triple): Quaternion {
  const d = dot(from, to);
  if (d < -1 + 1e-9) return [0, 1, 0, 0];
  const [x, y, z] = cross(from, to);
  const w = 1 + d;
  const length = Math.hypot(x, y, z, w);
  return [x / length, y / length, z / length, w / length];
}

/** The base pose: the arm hangs, the palm looks to the thigh, the fingers point down. */
const hangingNormal = (hand: Hand): Triple => [hand === 'left' ? -1 : 1, 0, 0];
const HANGING_FINGERS: Triple = [0, -1, 0];

/** An orientation of a hand: where the palm looks and where the fingers point, unit vectors square to each other. */
export interface HandDirections {
  readonly normal: Triple;
  readonly fingers: Triple;
}

/** The directions that a normal and an angle mean for a hand. EML axes, degrees by the left-hand rule. */
export function directionsOf(hand: Hand, normal: Triple, angle: number): HandDirections {
  const to = unit(flipDepth(normal));
  const carry = arc(hangingNormal(hand), to);
  return { normal: to, fingers: turn(aboutAxis(to, -radians(angle)), turn(carry, HANGING_FINGERS)) };
}

/** The normal and angle, -180 to 180 degrees, of a hand's directions, in EML's axes. */
export function palmOf(hand: Hand, { normal, fingers }: HandDirections): { normal: Triple; angle: number } {
  const to = unit(normal);
  const zero = turn(arc(hangingNormal(hand), to), HANGING_FINGERS);
  // Seen along the normal: from the zero direction to the fingers, left-handed.
  const angle = -degrees(Math.atan2(dot(cross(zero, fingers), to), dot(zero, fingers)));
  return { normal: flipDepth(to), angle };
}

/** Turns a hand as a ball is turned by a finger that moves over it, in shares of its radius to the right and up as the audience sees it. */
export function roll({ normal, fingers }: HandDirections, right: number, up: number): HandDirections {
  const amount = Math.hypot(right, up);
  if (amount === 0) return { normal, fingers };
  // The audience stands before the speaker and sees +x to the right, +z towards itself.
  const rotation = aboutAxis([-up, right, 0], amount);
  const n = unit(turn(rotation, normal));
  const f = turn(rotation, fingers);
  const s = dot(n, f);
  return { normal: n, fingers: unit([f[0] - n[0] * s, f[1] - n[1] * s, f[2] - n[2] * s]) };
}

/** Turns a hand about the line of sight, radians, against the clock as the audience sees it. */
export function twist({ normal, fingers }: HandDirections, angle: number): HandDirections {
  const rotation = aboutAxis([0, 0, 1], angle);
  return { normal: turn(rotation, normal), fingers: turn(rotation, fingers) };
}
