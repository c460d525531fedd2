/** Gestures to begin with. */

import { script, tag } from '../../speech/markup.js';
import type { PhaseName } from './gesture.js';

type Point = readonly [x: number, y: number, z: number];
/** An angle about a normal. */
type Palm = readonly [a: number, x: number, y: number, z: number];
/** Keys of a track by time; a single one without a time is given directly. */
type Keys<T> = T | Readonly<Record<string, T>>;

/** Clause of an example. */
interface Step {
  readonly phase: PhaseName;
  readonly secs: number;
  /** Seconds after the clause before. */
  readonly after?: number;
  readonly shapes?: Keys<number>;
  readonly palms?: Keys<Palm>;
  readonly places?: Keys<Point>;
  /** Timing curve between the keys of palms and positions; with controls it applies only to positions. */
  readonly course?: string;
  readonly controls?: string;
}

/** Start of the first clause: late enough for an arm to arrive, so that the player adds no delay. */
const BEGIN_SECS = 0.9;

function track<T>(
  name: string,
  keys: Keys<T> | undefined,
  attributes: (value: T) => Readonly<Record<string, number>>,
  course: Readonly<Record<string, string | undefined>> = {},
): string[] {
  if (keys === undefined) return [];
  const timed = typeof keys === 'object' && !Array.isArray(keys);
  const all: [string | undefined, T][] = timed ? Object.entries(keys as Readonly<Record<string, T>>) : [[undefined, keys as T]];
  return [
    tag(
      name,
      course,
      all.map(([time, value]) => tag('key', { time, ...attributes(value) })),
    ),
  ];
}

/** Returns a script of one gesture. */
function example(name: string, handedness: 'right' | 'both', steps: readonly Step[]): string {
  const clauses = steps.map(({ phase, secs, after = 0, shapes, palms, places, course, controls }) =>
    tag('gesture-key', { time: after, duration: secs, handedness, 'r:phase': phase }, [
      ...track('hand-shapes', shapes, (id) => ({ id })),
      ...track('palms', palms, ([a, x, y, z]) => ({ a, x, y, z }), { 'r:interpolation': controls === undefined ? course : undefined }),
      ...track('motion', places, ([x, y, z]) => ({ x, y, z }), { 'r:interpolation': course, 'r:controls': controls }),
    ]),
  );
  return script(name, true, [tag('gesture-is-on', { time: 0, isOn: true }), tag('seq', { time: BEGIN_SECS }, clauses)]);
}

/** Their names and texts. */
export const EXAMPLES: Readonly<Record<string, string>> = {
  Wave: example('wave', 'right', [
    { phase: 'preparation', secs: 0.7, shapes: 4, palms: [160, 0, 0, -1], places: [-16, 34, -8] },
    {
      phase: 'stroke',
      secs: 1.2,
      course: 'cosine',
      palms: { 0: [160, 0, 0, -1], '33%': [205, 0, 0, -1], '66%': [155, 0, 0, -1], '100%': [195, 0, 0, -1] },
      places: { 0: [-16, 34, -8], '33%': [-12, 34, -8], '66%': [-17, 34, -8], '100%': [-13, 34, -8] },
    },
    { phase: 'poststroke', secs: 0.2 },
    { phase: 'retraction', secs: 0.9 },
  ]),
  Point: example('point', 'right', [
    { phase: 'preparation', secs: 0.6, places: [-10, 18, -10] },
    {
      phase: 'stroke',
      secs: 0.35,
      shapes: { '100%': 19 },
      palms: { '100%': [80, 0.4, -0.9, 0] },
      places: { 0: [-10, 18, -10], '100%': [-14, 24, -18] },
      course: 'bezier',
      controls: '0.5 0 0.2 1.15',
    },
    { phase: 'poststroke', secs: 0.8 },
    { phase: 'retraction', secs: 0.8 },
  ]),
  'Open hands': example('open-hands', 'both', [
    { phase: 'preparation', secs: 0.7, shapes: 13, palms: [90, 0.6, 0.7, 0], places: [-5, 15, -12] },
    { phase: 'stroke', secs: 0.6, shapes: { '100%': 4 }, palms: { '100%': [60, 0, 1, 0] }, places: { 0: [-5, 15, -12], '100%': [-15, 14, -13] } },
    { phase: 'poststroke', secs: 0.7 },
    { phase: 'retraction', secs: 0.9 },
  ]),
  'Only a stroke': example('stroke', 'right', [
    { phase: 'stroke', secs: 0.4, shapes: { 0: 24 }, places: { 0: [-9, 22, -13], '100%': [-10, 16, -14] } },
    { phase: 'retraction', secs: 0.8, after: 0.3 },
  ]),
};
