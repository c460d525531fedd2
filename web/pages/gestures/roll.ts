/** Rotation of a palm by rolling its ball, and by turning its rim. */

import { along, cross, dot, unit } from '../../element/engine/pose.js';
import type { Vector3 } from './gesture.js';
import type { HandDirections } from './palm.js';

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** Returns a vector rotated about a unit axis (Rodrigues' rotation formula). */
function turned(v: Vector3, axis: Vector3, angle: number): Vector3 {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const beside = along([v[0] * cos, v[1] * cos, v[2] * cos], cross(axis, v), sin);
  return along(beside, axis, dot(axis, v) * (1 - cos));
}

/** Rotates a hand like a ball rolled by a finger, in shares of its radius to the right and up in the audience's view. */
export function roll({ normal, fingers }: HandDirections, right: number, up: number): HandDirections {
  const amount = Math.hypot(right, up);
  if (amount === 0) return { normal, fingers };
  // Seen by the audience in front of the speaker, +x points right and +z points towards the
  // audience.
  const axis = unit([-up, right, 0]);
  const n = unit(turned(normal, axis, amount));
  const f = turned(fingers, axis, amount);
  // Many small turns add up; normal and fingers stay square.
  return { normal: n, fingers: unit(along(f, n, -dot(n, f))) };
}

/** Rotates a hand about the line of sight, radians, counterclockwise in the audience's view. */
export function twist({ normal, fingers }: HandDirections, angle: number): HandDirections {
  const sight: Vector3 = [0, 0, 1];
  return { normal: turned(normal, sight, angle), fingers: turned(fingers, sight, angle) };
}
