/** A plain text as a script: what gestures and feelings come from its signs and small words. */

import { script, tag } from './markup.js';
import { GREETING, SMALL } from './words.js';

/** As long as a text is that somebody types, characters; more is a story. */
export const MOST_CHARACTERS = 600;

/** Signs of feelings, and the emotion that they elicit. The longest first, where one begins another. */
const FEELINGS: readonly (readonly [signs: readonly string[], emotion: string])[] = [
  [['>:(', '😠', '😡'], 'anger'],
  [[":'(", '😢', '😭', ':-(', ':(', '🙁', '☹'], 'distress'],
  [[';-)', ';)', '😉', ':-P', ':P', '😜'], 'kidding'],
  [[':-O', ':-o', ':O', ':o', '😮', '😲'], 'surprise'],
  [['<3', '❤', '😍', '🥰'], 'love'],
  [['😱', '😨'], 'fear'],
  [['🤢', '🤮'], 'disgust'],
  [[':-D', ':D', ':-)', ':)', '🙂', '😊', '😀', '😄'], 'joy'],
];
/** The signs as a pattern. */
const SIGNS = FEELINGS.flatMap(([own]) => own)
  .map((sign) => sign.replace(/[()*+?.^$|[\]\\]/g, '\\$&'))
  .join('|');
/** How strong, of 10. */
const POTENTIAL = 4;

/** The first word comes soon: who has typed it waits for it. */
const BEGINS = '0.15';
/** A hand that waves to the first words is on its way when they are said; if it came with them they would wait for it, seconds. */
const WAVE_LATER = 0.65;
/** Between beats there are at least so many words, and before the first. */
const BETWEEN_BEATS = 4;

interface Sentence {
  readonly words: readonly string[];
  readonly emotion: string | undefined;
  /** More of the same sentence follows. */
  readonly goesOn?: boolean;
}

/** A phrase has so many words. */
const PHRASE = { least: 4, most: 12 } as const;

/** The phrases of a sentence, which end at commas and the like, or where it becomes long. */
function phrases({ words, emotion }: Sentence): Sentence[] {
  const out: Sentence[] = [];
  let from = 0;
  for (let i = 1; i <= words.length; i++) {
    const length = i - from;
    const parts = /[,;:—–]["'”’)]*$/.test(words[i - 1] ?? '') && length >= PHRASE.least && words.length - i >= 2;
    if (i < words.length && !parts && length < PHRASE.most) continue;
    out.push({ words: words.slice(from, i), emotion, goesOn: i < words.length });
    from = i;
  }
  return out;
}

/** A text without the signs of feelings, and the first feeling in it. */
function felt(text: string): { rest: string; emotion: string | undefined } {
  let rest = text;
  let first: { at: number; emotion: string } | undefined;
  for (const [signs, emotion] of FEELINGS) {
    for (const sign of signs) {
      const at = rest.indexOf(sign);
      if (at < 0) continue;
      if (first === undefined || at < first.at) first = { at, emotion };
      // As long as before, so that places stay.
      rest = rest.replaceAll(sign, ' '.repeat(sign.length));
    }
  }
  return { rest, emotion: first?.emotion };
}

/** Sentences, without their signs of feelings; a sign after the mark of its sentence is of that one. */
function sentences(text: string, most = MOST_CHARACTERS): Sentence[] {
  const parts = text.slice(0, most).split(new RegExp(`(?<=[.!?…](?:\\s*(?:${SIGNS}))*)(?=\\s)(?!\\s*(?:${SIGNS}))|\\n+`, 'u'));
  return parts.flatMap((part) => {
    const { rest, emotion } = felt(part);
    const words = rest.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word));
    return words.length > 0 ? [{ words, emotion }] : [];
  });
}

const bare = (word: string): string => word.replace(/[^\p{L}\p{N}'’-]/gu, '');
const escaped = (text: string): string => text.replace(/[&<>]/g, (c) => `&#${c.charCodeAt(0)};`);
/** Letters that are all large, and more than one. */
const isLoud = (word: string): boolean => /^\p{Lu}{2,}$/u.test(bare(word));

const gesture = (time: string, shape: number, palm: readonly number[], path: readonly (readonly number[])[], hand: string): string => {
  const [a, x, y, z] = palm;
  return tag('gesture-key', { time, duration: 0.5, handedness: hand }, [
    tag('hand-shapes', {}, [tag('key', { time: 0, id: shape })]),
    tag('palms', {}, [tag('key', { time: 0, a, x, y, z })]),
    tag(
      'motion',
      { coords: 'speaker' },
      path.map(([time, px, py, pz]) => tag('key', { time, x: px, y: py, z: pz })),
    ),
  ]);
};
/** One hand is raised, open. */
const wave = (mark: string, isFirst: boolean): string =>
  gesture(
    isFirst ? `${mark}+${WAVE_LATER}s` : `${mark}-0.1s`,
    7,
    [120, 0, 0, -1],
    [
      [0, -7, 42, 3],
      [0.15, -13, 40, 3],
    ],
    'right',
  );
/** Both hands go down a little, half open. */
const beat = (mark: string): string =>
  gesture(
    `${mark}-0.1s`,
    4,
    [90, 0.6, 0.8, 0],
    [
      [0, -5, 14, -11],
      [0.2, -6, 11, -13],
    ],
    'both',
  );

/** The words with marks where hands move, and the gestures. */
function performed(words: readonly string[], index: number): { said: string; gestures: string[] } {
  const gestures: string[] = [];
  const isFirst = index === 0;
  let since = isFirst ? 0 : BETWEEN_BEATS;
  const said = words.map((word, i) => {
    const own = bare(word);
    const loud = isLoud(word);
    const text = loud ? tag('emph', {}, []).replace('/>', `>${escaped(word.toLowerCase())}</emph>`) : escaped(word);
    since += 1;
    const greets = GREETING.test(own);
    if (!greets && !(loud && since > 1) && (since < BETWEEN_BEATS || own.length < 4 || SMALL.has(own.toLowerCase()))) return text;
    since = 0;
    const mark = `g${index}w${i}`;
    gestures.push(greets ? wave(mark, isFirst && i < BETWEEN_BEATS) : beat(mark));
    return `${tag('tm', { name: mark })}${text}`;
  });
  return { said: said.join(' '), gestures };
}

/** The clauses that tell sentences, the first at `begins`; the feeling before them, and what they leave. */
function clausesOf(all: readonly Sentence[], begins: string, felt: string): { clauses: string[]; feels: string } {
  let [before, feels] = [begins, felt];
  const clauses = all.flatMap(({ words, emotion = 'neutral', goesOn }, i) => {
    const { said, gestures } = performed(words, i);
    const feeling = emotion === feels ? [] : [tag('r:emotion', { time: before, type: emotion, potential: emotion === 'neutral' ? undefined : POTENTIAL })];
    feels = emotion;
    const voice = tag('voice-text', { time: before, timeId: `v${i}` }, [`<div type="sentence">${said}</div>`, tag('tm', { name: `e${i}` })]);
    before = `e${i}+${goesOn ? 0.05 : 0.35}s`;
    return [...feeling, voice, ...gestures];
  });
  const on = tag('gesture-is-on', { time: 0, isOn: true });
  return { clauses: [on, ...clauses, tag('null', { time: `e${all.length - 1}+1.2s` })], feels };
}

/** How a text is told. */
export interface Telling {
  /** A tag of BCP 47. */
  readonly language?: string;
  /** Sentences are said phrase by phrase, by a voice that takes long: it is heard after the first. */
  readonly isPhrased?: boolean;
  /** What is longer is told so far, characters. */
  readonly most?: number;
}

/** The script that tells a text; undefined where it has no word. */
export function told(text: string, { language = 'en', isPhrased = false, most }: Telling = {}): string | undefined {
  const whole = sentences(text, most);
  const all = isPhrased ? whole.flatMap(phrases) : whole;
  if (all.length === 0) return undefined;
  return script('said', true, clausesOf(all, BEGINS, 'neutral').clauses, [tag('r:performer', { language })]);
}

/** The fragment that goes on telling after a text that has left a feeling, and the feeling that this one leaves; undefined where it has no word. */
export function toldOn(text: string, felt: string): { fragment: string; feels: string } | undefined {
  const all = sentences(text);
  if (all.length === 0) return undefined;
  const { clauses, feels } = clausesOf(all, '0', felt);
  return { fragment: script('said', true, clauses), feels };
}

/** A sign of a feeling at the beginning of a text, after spaces, and before another one or the end. */
export const SIGN_FIRST = new RegExp(`^\\s*(?:${SIGNS})(?=\\s|$)`, 'u');
