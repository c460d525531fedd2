/** Where what may be pointed at is marked: in the picture, above the bar of controls, not under the form, and each apart from the others. */

import type { ScreenPoint } from '../engine/pose.js';

/** Pixels from the left and the top of the picture. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** A mark is so large, and keeps so far from the edge of its room, pixels. */
export const MARK = 36;
const EDGE = MARK / 2 + 2;
/** The bar of controls. */
const BAR = 84;
/** Places around a spot that are tried, and how far one is from the next. */
const RINGS = 40;
const STEP = MARK / 2;

/** The rooms that a form leaves of a picture: above it, and to its sides. The whole picture where there is no form, or no room. */
function rooms(picture: Box, form: Box | undefined): readonly Box[] {
  const whole = { left: picture.left + EDGE, top: picture.top + EDGE, right: picture.right - EDGE, bottom: picture.bottom - BAR - EDGE };
  if (form === undefined) return [whole];
  const parts = [
    { ...whole, bottom: Math.min(whole.bottom, form.top - EDGE) },
    { ...whole, right: Math.min(whole.right, form.left - EDGE) },
    { ...whole, left: Math.max(whole.left, form.right + EDGE) },
  ].filter(({ left, top, right, bottom }) => left <= right && top <= bottom);
  return parts.length > 0 ? parts : [whole];
}

const within = ({ left, top, right, bottom }: Box, { x, y }: ScreenPoint): ScreenPoint => ({ x: Math.min(right, Math.max(left, x)), y: Math.min(bottom, Math.max(top, y)) });
const apart = (a: ScreenPoint, b: ScreenPoint): number => Math.hypot(a.x - b.x, a.y - b.y);

/** The place in one of the rooms that is nearest to a spot. */
function nearest(spot: ScreenPoint, all: readonly Box[]): ScreenPoint {
  const places = all.map((room) => within(room, spot));
  return places.reduce((best, place) => (apart(place, spot) < apart(best, spot) ? place : best));
}

/** Places for what lies at spots, in their order; `undefined` stays so. */
export function arranged(spots: readonly (ScreenPoint | undefined)[], picture: Box, form: Box | undefined): readonly (ScreenPoint | undefined)[] {
  const all = rooms(picture, form);
  const taken: ScreenPoint[] = [];
  return spots.map((spot) => {
    if (spot === undefined) return undefined;
    const place = free(nearest(spot, all), all, taken);
    taken.push(place);
    return place;
  });
}

/** The place nearest to a spot that no mark has; the spot where the rooms are full. */
function free(spot: ScreenPoint, all: readonly Box[], taken: readonly ScreenPoint[]): ScreenPoint {
  const isFree = (place: ScreenPoint) => taken.every((other) => apart(place, other) >= MARK);
  for (let ring = 0; ring <= RINGS; ring += 1) {
    const around = ring === 0 ? [spot] : ringOf(spot, ring);
    const found = around.map((place) => nearest(place, all)).find(isFree);
    if (found !== undefined) return found;
  }
  return spot;
}

/** Places at one distance around a spot, those to its sides first. */
function ringOf({ x, y }: ScreenPoint, ring: number): ScreenPoint[] {
  const places: ScreenPoint[] = [];
  for (let i = -ring; i <= ring; i += 1) {
    for (const [dx, dy] of [
      [ring, i],
      [-ring, i],
      [i, ring],
      [i, -ring],
    ] as const) {
      places.push({ x: x + dx * STEP, y: y + dy * STEP });
    }
  }
  return places.sort((a, b) => apart(a, { x, y }) - apart(b, { x, y }));
}
