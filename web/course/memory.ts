/** Memory of a course, which restores the learner's state, as a text stored by a system: reading, writing, and merging. */

import { deflateSync, inflateSync, strFromU8, strToU8 } from 'fflate';
import type { Score } from '../element/base/answers.js';
import { lengthOf, united, type Span } from '../element/base/ranges.js';

/** Limits for reading a memory, which is external input. */
const MAX_SPANS = 200;
const MAX_ANSWERS = 10_000;
const MAX_TEXT = 1_000_000;
const VERSION = 2;
/** Version of memories without attempts and sessions, which are still read. */
const FIRST_VERSION = 1;
/** Times are written so finely. */
const STEPS_A_SEC = 100;
/** Prefix of a compressed text (RFC 1951, base 64). */
const PACKED = 'z:';

/** An answer as `Answered` of the player has it, or of another shape: only the player judges it. */
export interface Remembered {
  readonly name: string;
  /** Given answer; an answer without it was graded before, and its text left out. */
  readonly given?: readonly string[];
  readonly tries?: number;
  readonly isFinal?: boolean;
  readonly isRight?: boolean;
  readonly points?: number;
  readonly fits?: readonly string[];
}

export interface Memory {
  readonly placeSecs: number;
  readonly seen: readonly Span[];
  readonly answered: readonly Remembered[];
  /** Other members of the player's `state`; only the player reads them. */
  readonly more: object;
  /** Number of the attempt at the course, from 1. */
  readonly attempt: number;
  /** Number of the session in which it was written; later sessions continue the count. */
  readonly session: number;
  /** The points of the best attempt before this one. */
  readonly best?: Score | undefined;
}

export const NOTHING: Memory = { placeSecs: 0, seen: [], answered: [], more: {}, attempt: 1, session: 0 };

/** Tolerance of a computed number of steps. */
const NEARLY = 1e-6;
const down = (secs: number): number => Math.floor(secs * STEPS_A_SEC + NEARLY) / STEPS_A_SEC;
const up = (secs: number): number => Math.ceil(secs * STEPS_A_SEC - NEARLY) / STEPS_A_SEC;

const isObject = (value: unknown): value is object => typeof value === 'object' && value !== null && !Array.isArray(value);
const isCount = (value: unknown): value is number => Number.isSafeInteger(value) && (value as number) >= 0;

// --- writing ---

/** Returns the longest spans up to a maximum number: never more than was seen. */
function longest(seen: readonly Span[], most: number): Span[] {
  const whole = seen.map(([from, to]): Span => [up(from), down(to)]).filter(([from, to]) => to > from);
  return united(whole.sort((a, b) => lengthOf([b]) - lengthOf([a])).slice(0, most));
}

/** Returns an answer without derivable data: its matches are recomputed from the given answer. */
function brief({ name, given, tries, isFinal, isRight, fits = [], points = 0 }: Remembered): object {
  return {
    name,
    ...(given === undefined ? { ...(fits.length > 0 ? { fits } : {}) } : { given }),
    tries,
    ...(isFinal ? { isFinal } : {}),
    ...(isRight ? { isRight } : {}),
    ...(points > 0 ? { points } : {}),
  };
}

const written = ({ placeSecs, seen, answered, more, attempt, session, best }: Memory): string => {
  const told = { v: VERSION, attempt, session, at: down(placeSecs), seen: seen.flat(), answered: answered.map(brief) };
  return JSON.stringify({ ...told, ...(best === undefined ? {} : { best }), ...(Object.keys(more).length > 0 ? { more } : {}) });
};

/** Returns a text as base 64, which every system stores unchanged. */
function packed(text: string): string {
  const bytes = deflateSync(strToU8(text), { level: 9 });
  return PACKED + btoa(strFromU8(bytes, true));
}

/** Returns the shorter of a text and its compressed form. */
function shortest(memory: Memory, most: number): string {
  const text = written(memory);
  return text.length <= most ? text : packed(text);
}

/** Removes the text of an answer, keeping its points. */
const worth = ({ given: _, ...answer }: Remembered): Remembered => answer;

/** Returns a memory without the texts of its longest answers; `count` is their number. */
function withoutTexts(memory: Memory, count: number): Memory {
  const lengths = memory.answered.map(({ given }) => JSON.stringify(given ?? []).length);
  const order = lengths.map((_, i) => i).sort((a, b) => (lengths[b] ?? 0) - (lengths[a] ?? 0));
  const isCut = new Set(order.slice(0, count));
  return { ...memory, answered: memory.answered.map((answer, i) => (isCut.has(i) ? worth(answer) : answer)) };
}

/** Removes a number of answers, those with the fewest points first. */
function withoutAnswers(memory: Memory, count: number): Memory {
  const order = memory.answered.map((_, i) => i).sort((a, b) => (memory.answered[a]?.points ?? 0) - (memory.answered[b]?.points ?? 0));
  const isLeft = new Set(order.slice(count));
  return { ...memory, answered: memory.answered.filter((_, i) => isLeft.has(i)) };
}

/** Returns the first of a memory's forms, each shorter than the one before, that is short enough; undefined if none is. */
function firstFitting(form: (step: number) => Memory, steps: number, most: number): string | undefined {
  let [low, high] = [0, steps + 1];
  while (low < high) {
    const step = Math.floor((low + high) / 2);
    if (shortest(form(step), most).length <= most) high = step;
    else low = step + 1;
  }
  return low > steps ? undefined : shortest(form(low), most);
}

/**
 * Writes a memory as a text of a maximum length. A longer one is compressed; then the longest answers lose their texts, which a returning learner no longer
 * sees, but keep their points; then the shortest spans are left out. Whole answers are left out last, if there are too many.
 */
export function writeMemory(memory: Memory, most = Infinity): string {
  const whole: Memory = { ...memory, seen: longest(memory.seen, MAX_SPANS) };
  const text = shortest(whole, most);
  if (text.length <= most) return text;
  const { length } = whole.answered;
  const bare = withoutTexts(whole, length);
  const unseen = { ...bare, seen: [] };
  const forms: readonly (readonly [form: (step: number) => Memory, steps: number])[] = [
    [(step) => withoutTexts(whole, step), length],
    [(step) => ({ ...bare, seen: longest(memory.seen, MAX_SPANS - step) }), MAX_SPANS],
    [(step) => withoutAnswers({ ...unseen, more: step === 0 ? unseen.more : {} }, step), length],
  ];
  for (const [form, steps] of forms) {
    const found = firstFitting(form, steps, most);
    if (found !== undefined) return found;
  }
  return '';
}

// --- reading ---

function parsed(text: string): unknown {
  if (text.length > MAX_TEXT) return undefined;
  try {
    if (!text.startsWith(PACKED)) return JSON.parse(text);
    return JSON.parse(strFromU8(inflateSync(strToU8(atob(text.slice(PACKED.length)), true))));
  } catch {
    return undefined;
  }
}

function spansIn(seen: unknown): Span[] | undefined {
  if (!Array.isArray(seen) || seen.length > 2 * MAX_SPANS || seen.length % 2 !== 0) return undefined;
  if (!seen.every((secs) => typeof secs === 'number' && Number.isFinite(secs) && secs >= 0)) return undefined;
  const times = seen as number[];
  const pairs = times.flatMap((from, i): Span[] => (i % 2 === 0 ? [[from, times[i + 1] ?? from]] : []));
  return united(pairs.filter(([from, to]) => to > from));
}

function answerIn(told: unknown): Remembered[] {
  if (!isObject(told)) return [];
  const { name, given, tries, isFinal, isRight, points, fits } = told as { [name in keyof Remembered]?: unknown };
  if (typeof name !== 'string') return [];
  const texts = (list: unknown): string[] | undefined => (Array.isArray(list) ? list.map(String) : undefined);
  return [
    {
      name,
      ...(Array.isArray(given) ? { given: given.map(String) } : {}),
      ...(isCount(tries) ? { tries } : {}),
      ...(typeof isFinal === 'boolean' ? { isFinal } : {}),
      ...(typeof isRight === 'boolean' ? { isRight } : {}),
      ...(typeof points === 'number' && Number.isFinite(points) ? { points } : {}),
      ...(texts(fits) === undefined ? {} : { fits: texts(fits) ?? [] }),
    },
  ];
}

function scoreIn(told: unknown): Score | undefined {
  const { points, most } = (isObject(told) ? told : {}) as { points?: unknown; most?: unknown };
  return typeof points === 'number' && typeof most === 'number' && points >= 0 && points <= most ? { points, most } : undefined;
}

/** Reads a memory written by `writeMemory`; empty for other text. */
export function readMemory(text: string): Memory {
  const told = parsed(text);
  if (!isObject(told)) return NOTHING;
  const { v, at, seen, answered, more, attempt, session, best } = told as { [name: string]: unknown };
  const spans = spansIn(seen);
  if ((v !== VERSION && v !== FIRST_VERSION) || spans === undefined) return NOTHING;
  return {
    placeSecs: typeof at === 'number' && Number.isFinite(at) ? Math.max(0, at) : 0,
    seen: spans,
    answered: Array.isArray(answered) ? answered.slice(0, MAX_ANSWERS).flatMap(answerIn) : [],
    more: isObject(more) ? more : {},
    attempt: isCount(attempt) && attempt >= 1 ? attempt : 1,
    session: isCount(session) ? session : 0,
    best: scoreIn(best),
  };
}

// --- two of them ---

/** Returns the better of two answers: by points, then by being final, then by tries, then by having its text. */
function better(a: Remembered, b: Remembered): Remembered {
  const rank = ({ points = 0, isRight, isFinal, tries = 0, given }: Remembered) => [points, isRight ? 1 : 0, isFinal ? 1 : 0, tries, given === undefined ? 0 : 1];
  const [first, second] = [rank(a), rank(b)];
  const differs = first.findIndex((value, i) => value !== second[i]);
  return differs < 0 || (first[differs] ?? 0) > (second[differs] ?? 0) ? a : b;
}

export const bestOf = (a: Score | undefined, b: Score | undefined): Score | undefined => {
  const share = (score: Score) => (score.most > 0 ? score.points / score.most : 0);
  return a === undefined || (b !== undefined && share(b) > share(a)) ? b : a;
};

/**
 * Merges two memories of one learner. All seen spans are kept. A later attempt replaces an earlier one; in the same attempt the better of two answers to a
 * question is kept, and the position is that of the later session, or of `ours`.
 */
export function joined(ours: Memory, theirs: Memory): Memory {
  const best = bestOf(ours.best, theirs.best);
  const seen = united([...ours.seen, ...theirs.seen]);
  if (ours.attempt !== theirs.attempt) return { ...(ours.attempt > theirs.attempt ? ours : theirs), seen, best, session: Math.max(ours.session, theirs.session) };
  const [base, other] = ours.session >= theirs.session ? [ours, theirs] : [theirs, ours];
  const answered = new Map(other.answered.map((answer) => [answer.name, answer]));
  for (const answer of base.answered) {
    const before = answered.get(answer.name);
    answered.set(answer.name, before === undefined ? answer : better(answer, before));
  }
  return { ...base, seen, answered: [...answered.values()], best, more: { ...other.more, ...base.more } };
}
