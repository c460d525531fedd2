/** Positions of the markers for pointing: in the image, above the control bar, not under the form, and not overlapping. */

import type { ScreenPoint } from '../engine/pose.js';

/** Rectangle, in pixels from the left and the top of the image. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Size of a marker, and its distance from the edge of its area, pixels. */
export const MARK = 36;
const EDGE = MARK / 2 + 2;
/** The bar of controls. */
const BAR = 84;
/** Number of rings of candidate positions around a spot; the next constant is their distance. */
const RINGS = 40;
const STEP = MARK / 2;

/** Returns the areas of an image not covered by a form: above it, and to its sides. The whole image if there is no form, or no free area. */
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

/** Returns the position in one of the areas nearest to a spot. */
function nearest(spot: ScreenPoint, all: readonly Box[]): ScreenPoint {
  const places = all.map((room) => within(room, spot));
  return places.reduce((best, place) => (apart(place, spot) < apart(best, spot) ? place : best));
}

/** Returns positions for markers at spots, in order; `undefined` is preserved. */
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

/** Returns the free position nearest to a spot; the spot itself if the areas are full. */
function free(spot: ScreenPoint, all: readonly Box[], taken: readonly ScreenPoint[]): ScreenPoint {
  const isFree = (place: ScreenPoint) => taken.every((other) => apart(place, other) >= MARK);
  for (let ring = 0; ring <= RINGS; ring += 1) {
    const around = ring === 0 ? [spot] : ringOf(spot, ring);
    const found = around.map((place) => nearest(place, all)).find(isFree);
    if (found !== undefined) return found;
  }
  return spot;
}

/** Returns positions at one distance around a spot, those at its sides first. */
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
