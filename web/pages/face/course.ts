/** How a face speaks, as numbers of the player: the order is that of `crate/web/src/curves.rs`. */

import type { FaceCourse } from '../../element/types.js';
import { MUSCLE_ORDER, namesOf } from './dials.js';

/** A phone, or a part of a diphthong, as it moves the mouth. Story seconds. */
export interface Segment {
  readonly name: string;
  readonly start: number;
  readonly end: number;
  /** Its dominance is full between these. */
  readonly held: readonly [number, number];
  /** Magnitude of its dominance over the lips' opening. */
  readonly alpha: number;
  /** How fast dominance rises before and falls after, 1/s. */
  readonly rates: readonly [number, number];
}

const SEGMENT = 10;

export function segmentsOf({ segments, names }: FaceCourse): readonly Segment[] {
  return names.map((name, i) => {
    const [start = 0, end = 0, from = 0, to = 0, alpha = 0, , , , before = 0, after = 0] = segments.slice(i * SEGMENT, (i + 1) * SEGMENT);
    return { name, start, end, held: [from, to], alpha, rates: [before, after] };
  });
}

/** Dominance of a segment at a time: α·exp(−θ·|τ|), full while it is held (F&H 3.1.3). */
export function dominance({ held, alpha, rates }: Segment, secs: number): number {
  return alpha * Math.exp(-(rates[0] * Math.max(0, held[0] - secs) + rates[1] * Math.max(0, secs - held[1])));
}

/** One curve: a muscle or a direct parameter, from 0 or -1 to 1. */
export interface Curve {
  readonly name: string;
  readonly values: readonly number[];
}

/** What comes after the muscles, and what of it is 1. */
const DIRECT: readonly (readonly [name: string, full: number])[] = [
  ['Jaw', 0.35],
  ['Jaw, sideways', 0.1],
  ['Jaw, forward', 0.008],
  ['Jaw, down', 0.004],
  ['Upper lid, left', 1],
  ['Upper lid, right', 1],
  ['Lower lid, left', 1],
  ['Lower lid, right', 1],
  ['Upper lip forward', 1],
  ['Lower lip forward', 1],
  ['Lips sealed', 1],
  ['Lip at teeth', 1],
  ['Tongue’s tip', 1],
  ['Tongue’s back', 1],
  ['Tongue out', 1],
  ['Blush', 1],
];

/** What each number of a sample is, and what of it is 1. */
const NAMES: readonly (readonly [name: string, full: number])[] = [
  ...MUSCLE_ORDER.flatMap((dial) =>
    namesOf(dial).map((own): readonly [string, number] => [dial.paired ? `${dial.label}, ${own.endsWith('Left') ? 'left' : 'right'}` : dial.label, 1]),
  ),
  ...DIRECT,
];

/** Numbers of a sample. */
export const WIDTH = NAMES.length;

/** The curves that move most, the liveliest first; of two sides that do the same, the left one stands for both. */
export function liveliest({ curves }: FaceCourse, most: number): readonly Curve[] {
  const count = Math.floor(curves.length / WIDTH);
  const all = NAMES.map(([name, full], i) => {
    const values = Array.from({ length: count }, (_, k) => (curves[k * WIDTH + i] ?? 0) / full);
    return { name, values, range: Math.max(...values, 0) - Math.min(...values, 0) };
  });
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

/** The first moment from a time on, within a blink's length, in which the eyes are open; that time itself where they are not told of. */
export function openEyesAt(player: { course(from: number, to: number, count: number): FaceCourse | undefined }, secs: number): number {
  const lid = NAMES.findIndex(([name]) => name === 'Upper lid, left');
  const STEP_SECS = 0.02;
  const STEPS = 30;
  const curves = player.course(secs, secs + STEPS * STEP_SECS, STEPS + 1)?.curves ?? [];
  for (let i = 0; i <= STEPS; i++) if ((curves[i * WIDTH + lid] ?? 0) < 0.25) return secs + i * STEP_SECS;
  return secs;
}
