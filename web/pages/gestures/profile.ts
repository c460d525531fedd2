/** Timing curves as functions from a share of time to a share of the path, as in `crate/base/src/profile.rs`. */

import type { Course } from './gesture.js';

/** Kinds of curves and their labels; `natural` leaves the timing to the storyteller. */
export const KINDS = { natural: 'Natural', linear: 'Linear', cosine: 'Cosine', bezier: 'Bézier', hermite: 'Hermite' } as const;
export type Kind = keyof typeof KINDS;

/** Initial controls of a newly chosen kind. */
export const DEFAULT_CONTROLS: Readonly<Record<Course['kind'], readonly number[]>> = { linear: [], cosine: [], bezier: [0.4, 0, 0.2, 1], hermite: [0, 0] };

const cubic = (a: number, b: number, u: number): number => u * (3 * (1 - u) * ((1 - u) * a + u * b) + u * u);

/** Returns the share of the path at a share of the time. */
export function wayAt(course: Course | undefined, s: number): number {
  const [a = 0, b = 0, c = 0, d = 0] = course?.controls ?? [];
  switch (course?.kind) {
    case 'linear':
      return s;
    case 'cosine':
      return 0.5 - 0.5 * Math.cos(Math.PI * s);
    case 'hermite':
      return s * (s * (s - 2) + 1) * a + s * s * (3 - 2 * s) + s * s * (s - 1) * b;
    case 'bezier': {
      const within = (x: number) => Math.min(1, Math.max(0, x));
      let [low, high] = [0, 1];
      for (let i = 0; i < 30; i += 1) {
        const middle = (low + high) / 2;
        if (cubic(within(a), within(c), middle) < s) low = middle;
        else high = middle;
      }
      return cubic(b, d, (low + high) / 2);
    }
    default:
      // As people move their hands: minimum jerk.
      return s * s * s * (10 + s * (6 * s - 15));
  }
}
