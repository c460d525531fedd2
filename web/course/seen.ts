/** How much of a story a learner has seen, and the text that brings them back to it. */

import { united, without, type Span } from '../element/ranges.js';

/** What is read from a memory is bounded: it comes from outside. */
const MOST_SPANS = 200;
const VERSION = 1;
/** Times are written so finely. */
const STEPS_A_SEC = 100;

/** The share of a story that lies in spans, in order and apart; 0 to 1. What of it is `optional`, as answers that nobody has given, does not count. */
export function shareOf(seen: readonly Span[], durationSecs: number, optional: readonly Span[] = []): number {
  if (!(durationSecs > 0) || !Number.isFinite(durationSecs)) return 0;
  const length = (spans: readonly Span[]): number => spans.reduce((sum, [from, to]) => sum + to - from, 0);
  const wanted = without(durationSecs, optional);
  const missing = wanted.flatMap(([from, to]) => without(to, [...seen, [0, from]]));
  const whole = length(wanted);
  return whole > 0 ? Math.max(0, 1 - length(missing) / whole) : 0;
}

export interface Memory {
  readonly placeSecs: number;
  /** What the player's `state` had of answers. */
  readonly answered: unknown;
  /** What else it had; only the player reads it. */
  readonly more?: object | undefined;
  readonly seen: readonly Span[];
}

/** What a number of steps may miss by as it is computed. */
const NEARLY = 1e-6;
const down = (secs: number): number => Math.floor(secs * STEPS_A_SEC + NEARLY) / STEPS_A_SEC;
const up = (secs: number): number => Math.ceil(secs * STEPS_A_SEC - NEARLY) / STEPS_A_SEC;

const isObject = (value: unknown): value is object => typeof value === 'object' && value !== null;

/** The answers in what a player tells of them: a list, or what has one. */
export function answersIn(told: unknown): readonly unknown[] {
  const list = Array.isArray(told) ? (told as unknown[]) : isObject(told) ? (told as { answered?: unknown }).answered : undefined;
  return Array.isArray(list) ? (list as unknown[]) : [];
}

/** All but the longest values, as many as take up so many characters of a list. */
function fitting(values: readonly unknown[], most: number): unknown[] {
  const lengths = values.map((value) => JSON.stringify(value).length + 1);
  // The first has no comma before it.
  let rest = most + 1;
  const places = lengths.map((_, i) => i).sort((a, b) => (lengths[a] ?? 0) - (lengths[b] ?? 0));
  const kept = new Set(places.filter((i) => (rest -= lengths[i] ?? 0) >= 0));
  return values.filter((_, i) => kept.has(i));
}

/**
 * As a text of a few characters a span. The shortest are left out where there are too many: no more is claimed than was seen. Where the
 * text is longer than the `most` characters that a system keeps, the longest answers are left out, and will be asked for again.
 */
export function writeMemory({ placeSecs, seen, answered, more = {} }: Memory, most = Infinity): string {
  const whole = seen.map(([from, to]): Span => [up(from), down(to)]).filter(([from, to]) => to > from);
  const longest = whole.sort(([a, b], [c, d]) => d - c - (b - a)).slice(0, MOST_SPANS);
  const told = { v: VERSION, at: down(placeSecs), seen: united(longest).flat(), ...(Object.keys(more).length > 0 ? { more } : {}) };
  const answersWith = (list: readonly unknown[]) => (isObject(answered) && !Array.isArray(answered) ? { ...answered, answered: list } : list);
  const left = fitting(answersIn(answered), most - JSON.stringify({ ...told, answered: answersWith([]) }).length);
  return JSON.stringify({ ...told, ...(isObject(answered) && (left.length > 0 || !Array.isArray(answered)) ? { answered: answersWith(left) } : {}) });
}

/** What `writeMemory` wrote; nothing seen where it was not that. */
export function readMemory(text: string): Memory {
  const nothing: Memory = { placeSecs: 0, seen: [], answered: undefined };
  let told: unknown;
  try {
    told = JSON.parse(text);
  } catch {
    return nothing;
  }
  const { v, at, seen, answered, more } = (told ?? {}) as { v?: unknown; at?: unknown; seen?: unknown; answered?: unknown; more?: unknown };
  if (v !== VERSION || !Array.isArray(seen) || seen.length > 2 * MOST_SPANS) return nothing;
  const times = seen.filter((secs): secs is number => typeof secs === 'number' && Number.isFinite(secs) && secs >= 0);
  if (times.length !== seen.length || times.length % 2 !== 0) return nothing;
  const pairs = times.flatMap((from, i) => (i % 2 === 0 ? [[from, times[i + 1] ?? from] as const] : []));
  const placeSecs = typeof at === 'number' && Number.isFinite(at) ? Math.max(0, at) : 0;
  return { placeSecs, answered, more: isObject(more) ? more : undefined, seen: united(pairs.filter(([from, to]) => to > from)) };
}
