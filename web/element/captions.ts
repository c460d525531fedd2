/** Captions: lines of an utterance short enough to read at a glance, with the word being spoken. */

import type { Utterance, Word } from './types.js';

/** A caption fills at most two lines of 42 characters, as subtitles on television do. */
const MOST_CHARACTERS = 84;
/** A caption may end at a comma once it is this long. */
const ENOUGH_CHARACTERS = 42;
/** Shorter sentences share a caption with the next one if both fit. */
const SHORT_CHARACTERS = 32;

/** One caption. */
export interface Caption {
  /** When it appears: its first word's start. */
  readonly startSecs: number;
  /** When it goes: the next caption's start, or a moment after its last word; at once where that was cut. */
  readonly endSecs: number;
  readonly words: readonly Word[];
}

/** How long a caption stays after its last word, so that a breath does not blink it away. */
const LINGER_SECS = 1.2;

/** The captions of a story, in order. */
export function captionsOf(utterances: readonly Utterance[]): Caption[] {
  const lines = utterances.flatMap(({ words, cut }) => linesOf(words).map((line) => ({ words: line, linger: cut ? 0 : LINGER_SECS })));
  return lines.map(({ words, linger }, i) => {
    const startSecs = words[0]?.startSecs ?? 0;
    const spokenUntil = words[words.length - 1]?.endSecs ?? startSecs;
    const next = lines[i + 1]?.words[0]?.startSecs ?? Infinity;
    return { startSecs, endSecs: Math.min(next, spokenUntil + linger), words };
  });
}

/** A sentence ends with the word. */
const ENDS = /[.!?…]["'”’)]*$/;
/** So does a part of one. */
const PAUSES = /[,;:–—]["'”’)]*$/;
/** No sign of punctuation and closing is longer: what comes before need not be looked at. */
const TAIL = 16;

/** Cuts words into lines: at sentence ends and commas where possible, at the limit where not. */
function linesOf(words: readonly Word[]): Word[][] {
  const lines: Word[][] = [];
  let line: Word[] = [];
  let length = 0;
  const rests = sentenceRests(words);
  const flush = () => {
    if (line.length > 0) lines.push(line);
    line = [];
    length = 0;
  };
  words.forEach((word, i) => {
    if (length > 0 && length + 1 + word.text.length > MOST_CHARACTERS) flush();
    line.push(word);
    length += (length > 0 ? 1 : 0) + word.text.length;
    const tail = word.text.slice(-TAIL);
    const alone = length >= SHORT_CHARACTERS || length + 1 + (rests[i + 1] ?? 0) > MOST_CHARACTERS;
    if ((ENDS.test(tail) && alone) || (PAUSES.test(tail) && length >= ENOUGH_CHARACTERS)) flush();
  });
  flush();
  return lines;
}

/** For each word, the characters from it to the end of its sentence: counted once, from the end. */
function sentenceRests(words: readonly Word[]): Uint32Array {
  const rests = new Uint32Array(words.length);
  let after = 0;
  for (let i = words.length - 1; i >= 0; i--) {
    const text = words[i]?.text ?? '';
    const ends = ENDS.test(text.slice(-TAIL));
    after = text.length + (ends || after === 0 ? 0 : 1 + after);
    rests[i] = after;
  }
  return rests;
}

/** The caption at a time, and the index in it of the word being spoken (-1 in a pause). */
export function captionAt(captions: readonly Caption[], secs: number): { caption: Caption; word: number } | undefined {
  const caption = captions[lastAtOrBefore(captions, secs)];
  if (caption === undefined || secs >= caption.endSecs) return undefined;
  const word = lastAtOrBefore(caption.words, secs);
  const spoken = caption.words[word];
  return { caption, word: spoken !== undefined && secs < spoken.endSecs ? word : -1 };
}

/** Index of the last item that has begun, or -1. */
function lastAtOrBefore(items: readonly { readonly startSecs: number }[], secs: number): number {
  let [low, high] = [0, items.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((items[middle]?.startSecs ?? Infinity) <= secs) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
