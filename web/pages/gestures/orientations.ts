/** Typical palm orientations (GEVH C.3.6, figure C.5, whose angles are lost; `docs/hand-shapes.md`). */

import type { Hand, Vector3 } from './gesture.js';

/** Orientation of a hand: EML's angle in degrees, and the normal in EML's axes. */
export interface Orientation {
  readonly angle: number;
  readonly normal: Vector3;
}

/** Orientations of the right hand by name. */
export const ORIENTATIONS: Readonly<Record<string, Orientation>> = {
  'Handshake: to the left, fingers front': { angle: 90, normal: [1, 0, 0] },
  'To the left, fingers up': { angle: 180, normal: [1, 0, 0] },
  'Hanging: to the left, fingers down': { angle: 0, normal: [1, 0, 0] },
  'Offering: up, fingers front': { angle: 90, normal: [0, 1, 0] },
  'Across the body: up, fingers left': { angle: 0, normal: [0, 1, 0] },
  'On a surface: down, fingers front': { angle: 90, normal: [0, -1, 0] },
  'To the side: down, fingers right': { angle: 0, normal: [0, -1, 0] },
  'Stop or wave: to the listener, fingers up': { angle: 180, normal: [0, 0, -1] },
  'Giving: to the listener, fingers down': { angle: 0, normal: [0, 0, -1] },
  'Across the body: to the speaker, fingers left': { angle: 90, normal: [0, 0, 1] },
  'To the speaker, fingers up': { angle: 180, normal: [0, 0, 1] },
  'Thumb down: to the right, fingers front': { angle: -90, normal: [-1, 0, 0] },
};

/** Returns an orientation for a hand: that of the left one is the mirror image. */
export function orientationOf(hand: Hand, { angle, normal: [x, y, z] }: Orientation): Orientation {
  // Not the negative of zero, which would be written with its sign.
  return hand === 'left' ? { angle: 0 - angle, normal: [0 - x, y, z] } : { angle, normal: [x, y, z] };
}

/** Returns the name of an orientation of a hand, `undefined` if it is none of the typical ones. */
export function orientationName(hand: Hand, { angle, normal }: Orientation): string | undefined {
  const length = Math.hypot(...normal) || 1;
  const turns = (a: number): number => Math.abs((((a % 360) + 540) % 360) - 180);
  const is = (known: Orientation): boolean => turns(known.angle - angle) < 0.05 && known.normal.every((n, i) => Math.abs(n - (normal[i] ?? 0) / length) < 1e-3);
  return Object.keys(ORIENTATIONS).find((name) => {
    const known = ORIENTATIONS[name];
    return known !== undefined && is(orientationOf(hand, known));
  });
}
