/** Disc of emotions: words at their positions in activation, evaluation and power, and the conversion of a position to words (F&H 4.4). */

import emotions from '../emotions.json';

/** Point in the emotion space; each coordinate from -100 to 100. */
export interface EmotionPoint {
  activation: number;
  evaluation: number;
  power: number;
}

export interface EmotionWord extends EmotionPoint {
  readonly word: string;
  /** Other words at the same position in the table. */
  readonly also: readonly string[];
}

const square = (a: EmotionPoint, b: EmotionPoint): number => (a.activation - b.activation) ** 2 + (a.evaluation - b.evaluation) ** 2 + (a.power - b.power) ** 2;

/** F&H table 4.4 (NECA), with the additional words of F&H (`WORDS` in `crate/speech/src/emotion.rs`), each position once. */
export const WORDS: readonly EmotionWord[] = emotions.words.reduce<(EmotionWord & { also: string[] })[]>((places, { word, ...place }) => {
  const there = places.find((other) => square(other, place) === 0);
  if (there === undefined) places.push({ word, also: [], ...place });
  else there.also.push(word);
  return places;
}, []);

/** Share of a word in a mixture, 0 to 1. */
export interface WeightShare {
  readonly word: EmotionWord;
  readonly value: number;
}

export const NEUTRAL: Readonly<EmotionPoint> = { activation: 0, evaluation: 0, power: 0 };

/** Words used in mixtures: half a wink is meaningless. */
const BLENDED = WORDS.filter((w) => w.word !== 'kidding');

/** Share of a word below which it is invisible. */
const MIN_WEIGHT = 0.005;
/**
 * Weight of the distance of a mixture's words from its position, relative to the error of its power. Designed: neighbours, unless others fit the power clearly
 * better.
 */
const NEAR = 0.12;

/**
 * Returns the words whose mixture lies at a position of the disc, with the closest possible power: at most two, with shares of at most 1 together, so that the
 * player adds them unchanged. A position outside all words is first moved inside.
 */
export function sharesAt(wanted: EmotionPoint): readonly WeightShare[] {
  const place = { ...wanted, ...within(wanted) };
  const { activation: a, evaluation: e } = place;
  if (Math.hypot(a, e) < 0.5) return [];
  const own = WORDS.find((w) => square(w, place) < 1e-6);
  if (own !== undefined) return [{ word: own, value: 1 }];
  let best: readonly WeightShare[] = [];
  let least = Infinity;
  const consider = (shares: readonly WeightShare[]): void => {
    const cost = (at(shares).power - place.power) ** 2 + NEAR * shares.reduce((sum, s) => sum + s.value * square(s.word, place), 0);
    if (cost < least) [best, least] = [shares, cost];
  };
  BLENDED.forEach((first, i) => {
    for (const second of BLENDED.slice(i + 1)) {
      const area = first.evaluation * second.activation - first.activation * second.evaluation;
      if (Math.abs(area) < 1e-6) continue;
      const x = (e * second.activation - a * second.evaluation) / area;
      const y = (first.evaluation * a - first.activation * e) / area;
      if (x < -1e-9 || y < -1e-9 || x + y > 1 + 1e-6) continue;
      consider(
        [
          { word: first, value: Math.min(1, x) },
          { word: second, value: Math.min(1, y) },
        ].filter((s) => s.value > MIN_WEIGHT),
      );
    }
  });
  return best;
}

/** Returns the position of a mixture. */
export function at(shares: readonly WeightShare[]): EmotionPoint {
  const sum = (key: keyof EmotionPoint): number => shares.reduce((total, { word: w, value }) => total + value * w[key], 0);
  return { activation: sum('activation'), evaluation: sum('evaluation'), power: sum('power') };
}

type Point = readonly [evaluation: number, activation: number];
const turn = (o: Point, a: Point, b: Point): number => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);

/** Outline of all words on the disc, counterclockwise: the range of expressible positions (Andrew's monotone chain). */
export const OUTLINE: readonly Point[] = ((): Point[] => {
  const points = WORDS.map((w): Point => [w.evaluation, w.activation]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list: readonly Point[]): Point[] => {
    const hull: Point[] = [];
    for (const p of list) {
      for (;;) {
        const [o, a] = hull.slice(-2);
        if (o === undefined || a === undefined || turn(o, a, p) > 0) break;
        hull.pop();
      }
      hull.push(p);
    }
    return hull.slice(0, -1);
  };
  return [...chain(points), ...chain([...points].reverse())];
})();

/** Returns the nearest expressible position of the disc. */
export function within({ evaluation, activation }: Pick<EmotionPoint, 'evaluation' | 'activation'>): Pick<EmotionPoint, 'evaluation' | 'activation'> {
  const p: Point = [evaluation, activation];
  const edges = OUTLINE.map((from, i) => [from, OUTLINE[(i + 1) % OUTLINE.length] ?? from] as const);
  if (edges.every(([from, to]) => turn(from, to, p) >= -1e-9)) return { evaluation, activation };
  let nearest: Point = p;
  let least = Infinity;
  for (const [from, to] of edges) {
    const way = [to[0] - from[0], to[1] - from[1]] as const;
    const along = ((p[0] - from[0]) * way[0] + (p[1] - from[1]) * way[1]) / (way[0] ** 2 + way[1] ** 2);
    const t = Math.min(1, Math.max(0, along));
    const q: Point = [from[0] + t * way[0], from[1] + t * way[1]];
    const far = (q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2;
    if (far < least) [nearest, least] = [q, far];
  }
  return { evaluation: nearest[0], activation: nearest[1] };
}

/** Returns a readable description of a position. */
export function inWords(shares: readonly WeightShare[]): string {
  if (shares.length === 0) return 'neutral';
  return [...shares]
    .sort((a, b) => b.value - a.value)
    .map(({ word: w, value }) => `${Math.round(100 * value)} % ${w.word}`)
    .join(' and ');
}
