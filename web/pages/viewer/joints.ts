/**
 * Joint angles of a limb in the figure's current pose: the parameters of `body-non-deterministic-fk` (GEVH table 3.1; `LimbRig` and `HeadRig` in
 * `crate/actor/src/manipulator`), so that joint control continues from the current position.
 */

import { cross, dot, minus, type PosedJoint, type PoseNow, type Vector } from '../../element/engine/pose.js';
import { RANGES, type JointRange, type LimbName } from './state.js';
import { bonesOf } from './turns.js';

/** The columns of a rotation. */
type Axes = PosedJoint['axes'];

const X: Vector = [1, 0, 0];
const Y: Vector = [0, 1, 0];
const Z: Vector = [0, 0, 1];
/** Returns a vector in the axes of a rotation; `turned` is the inverse. */
const within = ([x, y, z]: Axes, v: Vector): Vector => [dot(x, v), dot(y, v), dot(z, v)];
const turned = (axes: Axes, v: Vector): Vector => within(back(axes), v);
const times = (...all: readonly Axes[]): Axes => all.reduceRight((after, m) => after.map((v) => turned(m, v)) as [Vector, Vector, Vector]);
const back = ([x, y, z]: Axes): Axes => [
  [x[0], y[0], z[0]],
  [x[1], y[1], z[1]],
  [x[2], y[2], z[2]],
];
/** Returns the rotation by an angle about a unit axis. */
function about(axis: Vector, angle: number): Axes {
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  const column = (v: Vector): Vector => within(back([v, cross(axis, v), axis]), [cos, sin, dot(axis, v) * (1 - cos)]);
  return [column(X), column(Y), column(Z)];
}
const QUARTER = Math.PI / 2;
const wrapped = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));

/** Bones of trunk, neck and head in the zero pose: up, to the front, to the left. */
const MIDDLE: Axes = [Y, Z, X];

/** Rows of GEVH table A.1: the turns about z, y and z of the left bones, degrees. */
const ROWS = {
  shoulder: [90.623, 90, -89.9994],
  elbow: [90.0086, 90, -89.9994],
  wrist: [86.1526, 89.9999, -89.9994],
  hip: [-96.1374, 1.8407, 6.1522],
  knee: [91.7311, 6.5409, 178.269],
  subtalar: [-90.2381, 36.4449, 0.1221],
} as const;

/** Returns the axes of a bone in the zero pose, arms stretched out sideways (`zero_frames` in `crate/body`). */
function zeroOf(part: keyof typeof ROWS, left: boolean): Axes {
  const [a, b, c] = ROWS[part].map((degrees) => (degrees * Math.PI) / 180) as [number, number, number];
  const [x, y] = times(about(Z, a), about(Y, b), about(Z, c));
  // The table's z points to the back; the right side mirrors the left.
  const ours = (v: Vector): Vector => [left ? v[0] : -v[0], v[1], -v[2]];
  return [ours(x), ours(y), cross(ours(x), ours(y))];
}

/** Limb: its bones, and the values that do not depend on the pose. */
class Rig {
  readonly #sign: number;
  /** Signs that convert the table's joints to those of EML, which are mirrored. */
  readonly #signs: readonly [number, number, number];
  readonly #linkFromUpper: Axes;
  readonly #lowerFromUpper: Axes;
  readonly #endFromLower: Axes;
  readonly #endFromTarget: Axes;
  /** Hinge axis of elbow or knee, in the lower bone. */
  readonly #hinge: Vector;

  constructor(
    left: boolean,
    arm: boolean,
    private readonly ranges: readonly JointRange[],
  ) {
    const [upper, lower, end] = (arm ? (['shoulder', 'elbow', 'wrist'] as const) : (['hip', 'knee', 'subtalar'] as const)).map((part) => zeroOf(part, left)) as [Axes, Axes, Axes];
    const sign = left ? 1 : -1;
    const target = about(Z, arm && left ? 0 : arm ? -Math.PI : -QUARTER);
    this.#sign = sign;
    this.#signs = arm ? [sign, 1, -sign] : [sign, -1, sign];
    this.#linkFromUpper = times(back(about(X, QUARTER)), back(target), upper);
    this.#lowerFromUpper = times(back(upper), lower);
    this.#endFromLower = times(back(lower), end);
    this.#endFromTarget = times(back(end), target);
    this.#hinge = arm ? Z : within(lower, X);
  }

  /**
   * Returns the angles in degrees that preserve the end of the limb. The seventh joint, the axial rotation of the upper bone, does not exist in EML and counts
   * as 0.
   */
  joints(trunk: PosedJoint, upper: PosedJoint, lower: PosedJoint, end: PosedJoint): number[] {
    const base = times(trunk.axes, back(MIDDLE), about(Z, -QUARTER));
    const bend = times(back(this.#lowerFromUpper), back(upper.axes), lower.axes);
    const [x, y, z] = bend;
    const flexion = Math.atan2(dot([y[2] - z[1], z[0] - x[2], x[1] - y[0]], this.#hinge), x[0] + y[1] + z[2] - 1);
    const reach = minus(end.position, upper.position);
    // The end from the first joint: in the second frame of the table, and in the base.
    const own = turned(this.#linkFromUpper, within(upper.axes, reach));
    const to = within(base, reach);
    const level = Math.hypot(own[0], own[1]);
    const lift = Math.asin(Math.min(1, Math.max(-1, to[2] / level)));
    const ways = [lift, Math.PI - lift].flatMap((raised) => {
      const first = wrapped(Math.atan2(to[1], to[0]) - Math.atan2(-own[2], level * Math.cos(raised)));
      const second = wrapped(raised - Math.atan2(own[1], own[0]));
      const shoulder = [this.#sign * first, second, flexion];
      const link = times(about(Z, first), about(X, QUARTER), about(Z, second));
      const stretched = times(base, link, this.#linkFromUpper, this.#lowerFromUpper, about(this.#hinge, flexion), this.#endFromLower, this.#endFromTarget);
      return this.#turns(times(back(stretched), end.axes, this.#endFromTarget)).map((turn) => [...shoulder, ...turn]);
    });
    return nearest(ways, this.ranges);
  }

  /** Returns both solutions for the wrist or ankle. */
  #turns([x, y, z]: Axes): number[][] {
    const a = Math.atan2(-z[1], z[2]);
    const b = Math.atan2(z[0], Math.hypot(x[0], y[0]));
    const c = Math.atan2(-y[0], x[0]);
    const out = (...[a, b, c]: [number, number, number]): number[] => [this.#signs[0] * wrapped(a), -this.#signs[1] * wrapped(b), this.#signs[2] * wrapped(c)];
    return [out(a, b, c), out(a + Math.PI, Math.PI - b, c + Math.PI)];
  }
}

/** Returns the angles of neck and skull, degrees. A twist of the neck is omitted: it has no joint for that. */
function headJoints(trunk: PosedJoint, neck: PosedJoint, skull: PosedJoint): number[] {
  const base = times(trunk.axes, back(MIDDLE));
  const [, up] = times(back(base), neck.axes, back(MIDDLE));
  const tilt = Math.atan2(up[0], up[1]);
  const lean = Math.atan2(up[2], Math.hypot(up[0], up[1]));
  const [x, y, z] = times(back(about(X, lean)), back(about(Z, -tilt)), back(base), skull.axes, back(MIDDLE));
  return degrees([tilt, lean, Math.atan2(z[0], z[2]), Math.atan2(-z[1], Math.hypot(z[0], z[2])), -Math.atan2(x[1], y[1])]);
}

const degrees = (angles: readonly number[]): number[] => angles.map((angle) => Math.round((angle * 180) / Math.PI) || 0);

/** Returns the set of angles that least exceeds human ranges, and among those the one nearest to the neutral pose. */
function nearest(sets: readonly (readonly number[])[], ranges: readonly JointRange[]): number[] {
  const cost = (angles: readonly number[]): number =>
    angles.reduce((sum, angle, i) => {
      const { least, most } = ranges[i] ?? { least: -180, most: 180 };
      return sum + 1000 * Math.max(0, least - angle, angle - most) + Math.abs(angle);
    }, 0);
  return sets.map(degrees).reduce((best, next) => (cost(next) < cost(best) ? next : best));
}

const RIGS: Readonly<Record<Exclude<LimbName, 'head'>, Rig>> = {
  leftArm: new Rig(true, true, RANGES.leftArm),
  rightArm: new Rig(false, true, RANGES.rightArm),
  leftLeg: new Rig(true, false, RANGES.leftLeg),
  rightLeg: new Rig(false, false, RANGES.rightLeg),
};

/** Returns the current joint angles of a limb, whole degrees; undefined if the figure lacks a bone. */
export function jointsNow(pose: PoseNow, name: LimbName): number[] | undefined {
  const [trunk, first, second, third] = bonesOf(pose, name);
  if (!trunk || !first || !second) return undefined;
  return name === 'head' ? headJoints(trunk, first, second) : third && RIGS[name].joints(trunk, first, second, third);
}
