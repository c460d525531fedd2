/** Conversion between the world and EML: positions in units, and frames as yaw, pitch and roll. */

import type { PosedJoint, PoseNow, Vector } from '../../element/engine/pose.js';
import type { LimbName, Vector3 } from './state.js';

/** Converts a position in EML's world coordinates (x left, y up, z back) to the world, metres. */
export function toWorld({ metresPerUnit }: Pick<PoseNow, 'metresPerUnit'>, [x, y, z]: Vector3): Vector {
  return [x * metresPerUnit, y * metresPerUnit, -z * metresPerUnit];
}

/** Converts a point in the world to EML's world coordinates; tenths of a unit. */
export function toPlace({ metresPerUnit }: Pick<PoseNow, 'metresPerUnit'>, [x, y, z]: Vector): Vector3 {
  const tenth = (metres: number): number => Math.round((metres / metresPerUnit) * 10) / 10 || 0;
  return [tenth(x), tenth(y), tenth(-z)];
}

/** Returns yaw, pitch and roll in EML's degrees of a frame with these axes: roll turns first, then pitch, then yaw (`Units::angles` in `crate/player`). */
export function anglesOf([x, y, z]: readonly [Vector, Vector, Vector]): Vector3 {
  const degrees = (radians: number): number => Math.round((radians * 180) / Math.PI) || 0;
  const level = Math.hypot(z[0], z[2]);
  const pitch = Math.atan2(-z[1], level);
  if (level < 1e-6) return [0, degrees(-pitch), degrees(Math.atan2(-y[0], x[0]))];
  return [degrees(-Math.atan2(z[0], z[2])), degrees(-pitch), degrees(Math.atan2(x[1], y[1]))];
}

/** Trunk and bones of each limb. */
const BONES: Readonly<Record<LimbName, readonly string[]>> = {
  leftArm: ['thoracic', 'l_shoulder', 'l_elbow', 'l_wrist'],
  rightArm: ['thoracic', 'r_shoulder', 'r_elbow', 'r_wrist'],
  leftLeg: ['sacroiliac', 'l_hip', 'l_knee', 'l_subtalar'],
  rightLeg: ['sacroiliac', 'r_hip', 'r_knee', 'r_subtalar'],
  head: ['thoracic', 'cervical', 'skull'],
};

/** Returns the current bones of a limb, as far as the figure has them. */
export const bonesOf = (pose: PoseNow, name: LimbName): PosedJoint[] => BONES[name].flatMap((bone) => pose.joints.find((joint) => joint.name === `bone_${bone}`) ?? []);

/** Returns the current joint at the end of a limb. */
export const endOf = (pose: PoseNow, name: LimbName): PosedJoint | undefined => bonesOf(pose, name).at(-1);

/** Returns the target at which a limb is now. Feet are set flat: their joint's frame leans with the instep. */
export function targetNow(pose: PoseNow, name: LimbName): { place: Vector3; angles: Vector3 } | undefined {
  const end = endOf(pose, name);
  if (end === undefined) return undefined;
  const place = toPlace(pose, end.position);
  const [x, y, z] = end.axes;
  if (name === 'head') return { place, angles: anglesOf([z, x, y]) };
  if (name === 'leftLeg' || name === 'rightLeg') return { place, angles: [0, 0, -90] };
  // A hand's joint has y to the back of the hand, its target z (GEVH table 3.1).
  return { place, angles: anglesOf([x, [-z[0], -z[1], -z[2]], y]) };
}
