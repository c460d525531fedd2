/** Time spans as in media elements (HTML, `TimeRanges`). */

export type Span = readonly [startSecs: number, endSecs: number];

/** Spans in order that neither touch nor overlap: a snapshot, as the interface has it. */
export class Ranges implements TimeRanges {
  readonly #spans: readonly Span[];

  constructor(spans: readonly Span[]) {
    this.#spans = united(spans);
  }

  get length(): number {
    return this.#spans.length;
  }

  /** Throws `IndexSizeError` beyond the last, and `TypeError` without an index. */
  start(index: number): number {
    return this.#at(index)[0];
  }

  /** Throws the same errors as `start`. */
  end(index: number): number {
    return this.#at(index)[1];
  }

  #at(index: number | undefined): Span {
    if (index === undefined) throw new TypeError('The index of a range is needed.');
    const span = this.#spans[index];
    if (span === undefined) throw new DOMException(`There is no range ${index}.`, 'IndexSizeError');
    return span;
  }
}

/** Returns the same times as the smallest number of spans, in order. */
export function united(spans: readonly Span[]): Span[] {
  const found: Span[] = [];
  for (const [start, end] of [...spans].sort(([a], [b]) => a - b)) {
    const last = found.at(-1);
    if (last !== undefined && start <= last[1]) found[found.length - 1] = [last[0], Math.max(last[1], end)];
    else found.push([start, end]);
  }
  return found;
}

/** Returns the time from 0 to an end, excluding some spans. */
export function without(endSecs: number, spans: readonly Span[]): Span[] {
  const left: Span[] = [];
  let from = 0;
  for (const [start, end] of united(spans)) {
    if (start >= endSecs) break;
    if (start > from) left.push([from, start]);
    from = Math.max(from, end);
  }
  if (from < endSecs) left.push([from, endSecs]);
  return left;
}

/** Returns the intersection of some spans with others. */
export function common(spans: readonly Span[], others: readonly Span[]): Span[] {
  const pieces = united(spans).flatMap(([from, to]) => others.map(([start, end]): Span => [Math.max(from, start), Math.min(to, end)]));
  return united(pieces.filter(([from, to]) => to > from));
}

/** Returns the total time covered by spans, seconds. */
export const lengthOf = (spans: readonly Span[]): number => united(spans).reduce((sum, [from, to]) => sum + Math.max(0, to - from), 0);
