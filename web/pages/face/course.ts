/** Contents of the strip's course: dominance, and the most active curves. */

import { curvesOf, DIRECT_CONTROLS, type DirectControl, type FaceCurves, type Segment } from '../../element/face/course.js';
import type { FaceCourse } from '../../element/base/face-types.js';
import { MUSCLE_ORDER, namesOf } from './dials.js';

/** Returns the dominance of a segment at a time: α·exp(−θ·|τ|), full while it is held (F&H 3.1.3). */
export function dominance({ held, alpha, rates }: Segment, secs: number): number {
  return alpha * Math.exp(-(rates[0] * Math.max(0, held[0] - secs) + rates[1] * Math.max(0, secs - held[1])));
}

/** Curve of a muscle or a direct parameter, from 0 or -1 to 1. */
export interface Curve {
  readonly name: string;
  readonly values: readonly number[];
}

/** Labels of the non-muscle controls, and the meaning of 1 for each. */
const DIRECT: Readonly<Record<DirectControl, readonly [name: string, full: number]>> = {
  jawPitch: ['Jaw', 0.35],
  jawYaw: ['Jaw, sideways', 0.1],
  jawForward: ['Jaw, forward', 0.008],
  jawDown: ['Jaw, down', 0.004],
  upperLidLeft: ['Upper lid, left', 1],
  upperLidRight: ['Upper lid, right', 1],
  lowerLidLeft: ['Lower lid, left', 1],
  lowerLidRight: ['Lower lid, right', 1],
  protrusionUpper: ['Upper lip forward', 1],
  protrusionLower: ['Lower lip forward', 1],
  lipSeal: ['Lips sealed', 1],
  lipBite: ['Lip at teeth', 1],
  tongueTip: ['Tongue’s tip', 1],
  tongueBack: ['Tongue’s back', 1],
  tongueOut: ['Tongue out', 1],
  blush: ['Blush', 1],
};

/** Labels of the muscles, in the order of the table. */
const MUSCLE_NAMES: readonly string[] = MUSCLE_ORDER.flatMap((dial) =>
  namesOf(dial).map((own) => (dial.paired ? `${dial.label}, ${own.endsWith('Left') ? 'left' : 'right'}` : dial.label)),
);

/** Returns the most active curves in descending order; of two identical sides, only the left one. */
export function liveliest({ muscles, direct }: FaceCurves, most: number): readonly Curve[] {
  const named: Curve[] = [
    ...muscles.map((values, i) => ({ name: MUSCLE_NAMES[i] ?? '', values })),
    ...DIRECT_CONTROLS.map((control) => {
      const [name, full] = DIRECT[control];
      return { name, values: direct[control].map((value) => value / full) };
    }),
  ];
  const all = named.map((curve) => ({ ...curve, range: Math.max(...curve.values, 0) - Math.min(...curve.values, 0) }));
  const same = (i: number): boolean => {
    const [own, left] = [all[i], all[i - 1]];
    return own !== undefined && left !== undefined && own.name.endsWith(', right') && own.values.every((v, k) => Math.abs(v - (left.values[k] ?? 0)) < 0.05);
  };
  return all
    .map((curve, i) => (same(i + 1) ? { ...curve, name: curve.name.replace(/, left$/, '') } : curve))
    .filter((curve, i) => curve.range > 0.06 && !same(i))
    .sort((a, b) => b.range - a.range)
    .slice(0, most);
}

/** Closure of a lid below which the eye is visible. */
const OPEN_LID = 0.25;
/** Maximum duration of a blink, in steps of this length. */
const BLINK = { stepSecs: 0.02, steps: 30 } as const;

/** Returns the first time, within the length of a blink, at which the eyes are open; the given time if their state is unknown. */
export function openEyesAt(player: { course(from: number, to: number, count: number): FaceCourse | undefined }, secs: number): number {
  const { stepSecs, steps } = BLINK;
  const course = player.course(secs, secs + steps * stepSecs, steps + 1);
  if (course === undefined) return secs;
  const open = curvesOf(course, steps + 1).direct.upperLidLeft.findIndex((closed) => closed < OPEN_LID);
  return secs + Math.max(0, open) * stepSecs;
}
