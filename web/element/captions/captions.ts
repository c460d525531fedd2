/** Captions: lines of an utterance short enough to read at a glance, with the spoken word highlighted. */

import { BreakStrength, breaksOf } from './phrases.js';
import type { Utterance, Word } from '../base/types.js';

/** The most characters of a line, as subtitles on television have them; a caption has two lines at most. */
const LINE_CHARACTERS = 42;

/** Caption of the story. */
export interface Caption {
  /** Start time: that of its first word. */
  readonly startSecs: number;
  /** End time: the next caption's start, or shortly after its last word; immediately if that was interrupted. */
  readonly endSecs: number;
  readonly words: readonly Word[];
  /** Index of the word that begins the second line; the number of words where there is one line. */
  readonly second: number;
}

/** Time for which a caption remains after its last word, so it does not flicker at a breath. */
const LINGER_SECS = 1.2;

/** Returns the captions of a story, in order. `language` applies to utterances without their own. */
export function captionsOf(utterances: readonly Utterance[], language: string): Caption[] {
  const all = utterances.flatMap(({ words, cut, language: own = language }) => parts(words, own).map((part) => ({ ...part, linger: cut ? 0 : LINGER_SECS })));
  return all.map(({ words, second, linger }, i) => {
    const startSecs = words[0]?.startSecs ?? 0;
    const spokenUntil = words[words.length - 1]?.endSecs ?? startSecs;
    const next = all[i + 1]?.words[0]?.startSecs ?? Infinity;
    return { startSecs, endSecs: Math.min(next, spokenUntil + linger), words, second };
  });
}

/** Cost of ending a caption, and a line within one, at each kind of break. */
const CAPTION_COST = [0, 1, 5, 14, 26, 60];
const LINE_COST = [0, 0, 3, 5, 11, 40];
/** Cost of continuing past each kind of break within a line. */
const OVER_COST = [7, 14, 1, 0, 0, 0];
/** A caption more, and a second line. */
const CAPTION = 9;
const SECOND_LINE = 2;
/** Cost of a single word that is not a whole sentence: it disappears before it is read. */
const LONE_WORD = 10;
/** Lines of one caption are about as long as each other. */
const UNEVEN = 0.25;

interface Part {
  readonly words: readonly Word[];
  readonly second: number;
}

/** Best segmentation up to some word: its cost, and its last caption. */
interface CaptionLayout {
  cost: number;
  from: number;
  second: number;
}

/** Splits words into captions with minimum total cost of the breaks. */
function parts(words: readonly Word[], language: string): Part[] {
  const count = words.length;
  const texts = words.map((word) => word.text);
  const breaks = breaksOf(words, texts, language);
  const ways: CaptionLayout[] = Array.from({ length: count + 1 }, () => ({ cost: Infinity, from: 0, second: 0 }));
  if (ways[0] !== undefined) ways[0].cost = 0;
  const end = (costs: readonly number[], i: number): number => (i === count ? 0 : (costs[breaks[i - 1] ?? BreakStrength.Any] ?? 0));
  const ends = (i: number): boolean => i === 0 || i === count || breaks[i - 1] === BreakStrength.Sentence;
  const lone = (from: number, to: number): number => (to - from === 1 && !(ends(from) && ends(to)) ? LONE_WORD : 0);
  /** Calls for every end of a line that begins with a word, with its length and its cost. */
  const lines = (from: number, each: (to: number, length: number, cost: number) => void): void => {
    let length = texts[from]?.length ?? 0;
    let cost = 0;
    for (let to = from + 1; to <= count; to++) {
      each(to, length, cost + lone(from, to));
      if (to === count) return;
      length += 1 + (texts[to]?.length ?? 0);
      cost += OVER_COST[breaks[to - 1] ?? BreakStrength.Any] ?? 0;
      if (length > LINE_CHARACTERS) return;
    }
  };
  for (let from = 0; from < count; from++) {
    const before = ways[from]?.cost ?? Infinity;
    const offer = (to: number, second: number, cost: number): void => {
      const way = ways[to];
      const all = before + CAPTION + cost + end(CAPTION_COST, to);
      if (way === undefined || all >= way.cost) return;
      Object.assign(way, { cost: all, from, second });
    };
    lines(from, (middle, first, cost) => {
      offer(middle, middle, cost);
      if (middle === count) return;
      const broken = cost + SECOND_LINE + end(LINE_COST, middle);
      lines(middle, (to, second, more) => offer(to, middle, broken + more + UNEVEN * Math.abs(first - second)));
    });
  }
  const found: Part[] = [];
  for (let to = count; to > 0; ) {
    const { from, second } = ways[to] ?? { from: 0, second: to };
    found.push({ words: words.slice(from, to), second: second - from });
    to = from;
  }
  return found.reverse();
}

/** Returns the caption at a time, and the index in it of the word being spoken (-1 in a pause). */
export function captionAt(captions: readonly Caption[], secs: number): { caption: Caption; word: number } | undefined {
  const caption = captions[lastAtOrBefore(captions, secs)];
  if (caption === undefined || secs >= caption.endSecs) return undefined;
  const word = lastAtOrBefore(caption.words, secs);
  const spoken = caption.words[word];
  return { caption, word: spoken !== undefined && secs < spoken.endSecs ? word : -1 };
}

/** Returns the index of the last item that has begun, or -1. */
function lastAtOrBefore(items: readonly { readonly startSecs: number }[], secs: number): number {
  let [low, high] = [0, items.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((items[middle]?.startSecs ?? Infinity) <= secs) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
