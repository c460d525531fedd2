/**
 * Decoder of the element's `course()`: the controls of the face over time, and the segments of speech that drive the mouth. Loaded only by pages that plot
 * them.
 */

import type { FaceCourse } from '../base/face-types.js';

/** A phone, or a part of a diphthong, as it moves the mouth. Story seconds. */
export interface Segment {
  readonly name: string;
  readonly start: number;
  readonly end: number;
  /** Time span in which its dominance is full. */
  readonly held: readonly [from: number, to: number];
  /** Magnitude of its dominance over the lips' opening. */
  readonly alpha: number;
  /** Rates at which dominance rises before and falls after, 1/s. */
  readonly rates: readonly [before: number, after: number];
}

/** The numbers of a segment: the layout of `Player::segments` in `crate/web`. */
const SEGMENT = ['start', 'end', 'heldFrom', 'heldTo', 'opening', 'rounding', 'spreading', 'tongue', 'before', 'after'] as const;

/** Returns the segments of all speech, in order. */
export function segmentsOf({ segments, names }: FaceCourse): readonly Segment[] {
  return names.map((name, i) => {
    const value = (field: (typeof SEGMENT)[number]): number => segments[i * SEGMENT.length + SEGMENT.indexOf(field)] ?? 0;
    return {
      name,
      start: value('start'),
      end: value('end'),
      held: [value('heldFrom'), value('heldTo')],
      alpha: value('opening'),
      rates: [value('before'), value('after')],
    };
  });
}

/**
 * Controls after the muscles, which are in the order of `crate/tissue/src/muscles.tsv`, with those on two sides twice. Jaw: radians and metres; the others 0
 * or -1 to 1. The layout of `Player::face_curves` in `crate/web`.
 */
export const DIRECT_CONTROLS = [
  'jawPitch',
  'jawYaw',
  'jawForward',
  'jawDown',
  'upperLidLeft',
  'upperLidRight',
  'lowerLidLeft',
  'lowerLidRight',
  'protrusionUpper',
  'protrusionLower',
  'lipSeal',
  'lipBite',
  'tongueTip',
  'tongueBack',
  'tongueOut',
  'blush',
] as const;
export type DirectControl = (typeof DIRECT_CONTROLS)[number];

/** The values of each control, one for each time. */
export interface FaceCurves {
  readonly muscles: readonly (readonly number[])[];
  readonly direct: Readonly<Record<DirectControl, readonly number[]>>;
}

/** Returns the curves of `course(from, to, count)`, control by control; `count` is at most 4,096. */
export function curvesOf({ curves }: Pick<FaceCourse, 'curves'>, count: number): FaceCurves {
  const width = Math.floor(curves.length / count);
  const column = (i: number): number[] => Array.from({ length: count }, (_, sample) => curves[sample * width + i] ?? 0);
  const muscles = Math.max(0, width - DIRECT_CONTROLS.length);
  const direct = Object.fromEntries(DIRECT_CONTROLS.map((name, i) => [name, column(muscles + i)])) as Record<DirectControl, number[]>;
  return { muscles: Array.from({ length: muscles }, (_, i) => column(i)), direct };
}
