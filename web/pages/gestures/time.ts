/**
 * Start times of a text's clauses, as far as they follow from the text alone. The wasm parser is not used: it estimates the duration of speech, and an
 * estimate must not appear on the timeline.
 */

import { attribute, type Element } from '../source.js';

const UNITS: Readonly<Record<string, number>> = { '': 1, s: 1, m: 60, h: 3600 };

/** Parses a plain duration such as `2`, `0.5s` or `1m` to seconds; undefined for anything else. */
export function parseSecs(written: string): number | undefined {
  const [, number, unit = ''] = /^\s*(\d+\.?\d*|\.\d+)\s*([smh]?)\s*$/.exec(written) ?? [];
  return number === undefined ? undefined : Number(number) * (UNITS[unit] ?? 1);
}

/** Evaluates a time expression: seconds, and true if it is relative to a named mark. */
function evaluate(written: string, moments: ReadonlyMap<string, number>): { secs: number; named: boolean } | undefined {
  let secs = 0;
  let named = false;
  let at = 0;
  const term = /\s*([-+]?)\s*(?:(\d+\.?\d*|\.\d+)([smh]?)(?![\w.])|([A-Za-z_][\w.-]*?)(?=\s*[-+]|\s*$))/y;
  while (at < written.trimEnd().length) {
    term.lastIndex = at;
    const [whole, sign, number, unit = '', name] = term.exec(written) ?? [];
    if (whole === undefined || (at > 0 && sign === '')) return undefined;
    const value = number === undefined ? moments.get(name ?? '') : Number(number) * (UNITS[unit] ?? 1);
    if (value === undefined) return undefined;
    named ||= number === undefined;
    secs += sign === '-' ? -value : value;
    at += whole.length;
  }
  return at === 0 ? undefined : { secs, named };
}

/** Clauses whose length is written; speech and animations have one that only the player knows. */
const LENGTHLESS = new Set(['null', 'event', 'gesture-is-on']);

/**
 * Returns the start times of the clauses in a body, seconds, in the time of the text. Clauses that depend on speech, or follow something of unknown length in
 * a `seq`, are omitted.
 */
export function timesOf(body: Element): Map<Element, number> {
  const starts = new Map<Element, number>();
  const moments = new Map<string, number>();
  // A name may be used before its definition, so a second pass finds what the first one missed.
  for (let look = 0, known = -1; look < 8 && known !== moments.size; look += 1) {
    known = moments.size;
    starts.clear();
    play(body.children, 0, false);
  }
  return starts;

  /** Returns the end of the clauses that play from `from`; undefined if it is not known. */
  function play(clauses: readonly Element[], from: number | undefined, inSequence: boolean): number | undefined {
    let end = from;
    let all: number | undefined = from;
    for (const clause of clauses) {
      const time = evaluate(attribute(clause, 'time') ?? '0', moments);
      const base = inSequence ? end : from;
      const start = time === undefined ? undefined : time.named ? time.secs : base === undefined ? undefined : base + time.secs;
      const id = attribute(clause, 'timeId');
      if (start !== undefined) {
        starts.set(clause, start);
        if (id !== undefined) moments.set(id, start);
      }
      end = endOf(clause, start);
      all = all === undefined || end === undefined ? undefined : Math.max(all, end);
    }
    return inSequence ? end : all;
  }

  function endOf(clause: Element, start: number | undefined): number | undefined {
    if (clause.name === 'seq' || clause.name === 'par') {
      const end = play(clause.children, start, clause.name === 'seq');
      const written = attribute(clause, 'duration') ?? attribute(clause, 'dur');
      const count = Number(attribute(clause, 'repetitionCount') ?? attribute(clause, 'repeatCount') ?? 1);
      if (start === undefined || end === undefined) return undefined;
      const round = written === undefined ? end - start : parseSecs(written);
      // NaN counts as once.
      return round === undefined ? undefined : start + round * (count >= 1 ? count : 1);
    }
    if (start === undefined || LENGTHLESS.has(clause.name)) return start;
    const length = clause.name === 'gesture-key' ? parseSecs(attribute(clause, 'duration') ?? '') : undefined;
    return length === undefined ? undefined : start + length;
  }
}
