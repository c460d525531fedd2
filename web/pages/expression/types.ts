/** The types of emotions of Ortony, Clore and Collins, and where the page's disc has them. */

import emotions from '../emotions.json';
import { WORDS, type EmotionWord } from '../face/disc.js';

/** Names of the good emotions, as in `EMOTIONS` in `crate/stage/src/emotion.rs`. */
export const GOOD: readonly EmotionName[] = emotions.good;
export const BAD: readonly EmotionName[] = emotions.bad;

/** Name of an emotion, or `neutral`. */
export type EmotionName = string;

/** The greatest potential of `r:emotion`, and how exactly the page sets it. */
export const STRONGEST = 10;
export const POTENTIAL_STEP = 0.1;

export const rounded = (potential: number): number => Math.round(Math.min(STRONGEST, Math.max(0, potential)) / POTENTIAL_STEP) / Math.round(1 / POTENTIAL_STEP);

/** A type's direction on the disc. */
export interface EmotionRay {
  readonly name: EmotionName;
  /** 1 to the right, where evaluation is positive, or -1. */
  readonly side: 1 | -1;
  /** Angle from the horizontal upwards, degrees. */
  readonly rise: number;
}

/** Degrees between two rays. */
const APART = 12;

/** Returns the position of a type in F&H table 4.4. */
function placeOf(name: EmotionName): EmotionWord {
  const place = WORDS.find((w) => w.word === name || w.also.includes(name));
  if (place === undefined) throw new Error(`the disc has no ${name}`);
  return place;
}

/**
 * Returns one side of the disc, from the most active to the most passive direction of F&H table 4.4. Several types share a direction there, so they are spread
 * evenly: each can be dragged to.
 */
function fan(names: readonly EmotionName[], side: 1 | -1): readonly EmotionRay[] {
  const rise = (name: EmotionName): number => {
    const { activation, evaluation } = placeOf(name);
    return Math.atan2(activation, side * evaluation);
  };
  const ordered = [...names].sort((a, b) => rise(b) - rise(a));
  return ordered.map((name, i) => ({ name, side, rise: ((ordered.length - 1) / 2 - i) * APART }));
}

const RIGHT = fan(GOOD, 1);
const LEFT = fan(BAD, -1);

export const RAYS: readonly EmotionRay[] = [...RIGHT, ...LEFT];

export const rayOf = (name: EmotionName): EmotionRay | undefined => RAYS.find((ray) => ray.name === name);

/** Position on the disc: to the right and upwards, 1 at its rim. */
export interface DiscPoint {
  readonly x: number;
  readonly y: number;
}

/** Returns the point of a ray at a distance from the centre. */
export function spotOf({ side, rise }: EmotionRay, distance: number): DiscPoint {
  const radians = (rise * Math.PI) / 180;
  return { x: side * distance * Math.cos(radians), y: distance * Math.sin(radians) };
}

/** Emotion: a type and the potential of the events that elicit it. */
export interface CurrentEmotion {
  readonly emotion: EmotionName;
  readonly potential: number;
}

/** Returns the type in the direction of a position, with its distance from the centre as the potential; none at the very centre. */
export function feltAt({ x, y }: DiscPoint): CurrentEmotion {
  const potential = rounded(Math.hypot(x, y) * STRONGEST);
  if (potential === 0) return { emotion: 'neutral', potential };
  const along = (ray: EmotionRay): number => {
    const to = spotOf(ray, 1);
    return to.x * x + to.y * y;
  };
  const nearest = RAYS.reduce((best, ray) => (along(ray) > along(best) ? ray : best));
  return { emotion: nearest.name, potential };
}

/**
 * Returns the emotion after an arrow key on the disc: up and down to the next type of a side, stronger towards the rim, through the centre to the other side.
 */
export function stepFrom({ emotion, potential }: CurrentEmotion, right: number, up: number): CurrentEmotion {
  const own = rayOf(emotion);
  if (own === undefined) return right === 0 ? { emotion, potential } : feltAt({ x: (right * POTENTIAL_STEP) / STRONGEST, y: 0 });
  const [near, far] = own.side > 0 ? [RIGHT, LEFT] : [LEFT, RIGHT];
  const index = Math.min(near.length - 1, Math.max(0, near.indexOf(own) - Math.sign(up)));
  const along = potential + own.side * right * POTENTIAL_STEP;
  const ray = (along < 0 ? far : near)[index] ?? own;
  return { emotion: ray.name, potential: rounded(Math.abs(along)) };
}
