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
  readonly seen: readonly Span[];
}

/** What a number of steps may miss by as it is computed. */
const NEARLY = 1e-6;
const down = (secs: number): number => Math.floor(secs * STEPS_A_SEC + NEARLY) / STEPS_A_SEC;
const up = (secs: number): number => Math.ceil(secs * STEPS_A_SEC - NEARLY) / STEPS_A_SEC;

/** As a text of a few characters a span. The shortest are left out where there are too many: no more is claimed than was seen. */
export function writeMemory({ placeSecs, seen, answered }: Memory): string {
  const whole = seen.map(([from, to]): Span => [up(from), down(to)]).filter(([from, to]) => to > from);
  const longest = whole.sort(([a, b], [c, d]) => d - c - (b - a)).slice(0, MOST_SPANS);
  return JSON.stringify({ v: VERSION, at: down(placeSecs), seen: united(longest).flat(), ...(Array.isArray(answered) && answered.length > 0 ? { answered } : {}) });
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
  const { v, at, seen, answered } = (told ?? {}) as { v?: unknown; at?: unknown; seen?: unknown; answered?: unknown };
  if (v !== VERSION || !Array.isArray(seen) || seen.length > 2 * MOST_SPANS) return nothing;
  const times = seen.filter((secs): secs is number => typeof secs === 'number' && Number.isFinite(secs) && secs >= 0);
  if (times.length !== seen.length || times.length % 2 !== 0) return nothing;
  const pairs = times.flatMap((from, i) => (i % 2 === 0 ? [[from, times[i + 1] ?? from] as const] : []));
  return { placeSecs: typeof at === 'number' && Number.isFinite(at) ? Math.max(0, at) : 0, answered, seen: united(pairs.filter(([from, to]) => to > from)) };
}
