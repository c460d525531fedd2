/** Words and times of a story before playback: the words of its speech bundle, at the engine's times. */

import { type Segment, segmentsOf } from '../../element/face/course.js';
import type { FaceCourse } from '../../element/base/face-types.js';
import type { Utterance, Word } from '../../element/base/types.js';

/** Subset of `speech.json` read here; docs/speech-bundle.md describes the whole. */
interface Bundle {
  readonly voices: readonly { readonly language: string }[];
  readonly utterances: readonly BundledUtterance[];
}

interface BundledUtterance {
  /** Index of its voice. */
  readonly voice: number;
  readonly text: string;
  /** Lengths of its phones. */
  readonly msecs: readonly number[];
  /** Position of each word in the text, in bytes of UTF-8, and among the phones. */
  readonly words: readonly (readonly [start: number, bytes: number, firstPhone: number, phones: number])[];
}

/** Tolerance for equal times, seconds: the engine returns 32-bit floats, which are exact to a tenth of a millisecond over ten minutes. */
const SAME_SECS = 1e-3;
/** Imperceptible delay of a highlight. */
const HEARD_SECS = 0.05;

/** Returns the spoken words of a text; a lone dash is not a word. */
const wordsOf = (text: string): string[] => text.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word));

/** The entities of XML. */
const ENTITIES: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', apos: "'", quot: '"' };

/** Decodes XML text. The browser's parser does not accept strings under the page's trusted types. */
const read = (text: string): string =>
  text.replace(/&(?:#(\d+)|(\w+));/g, (whole, code?: string, name = '') => (code === undefined ? (ENTITIES[name] ?? whole) : String.fromCodePoint(Number(code))));

/** Returns the utterances of a script written by `told`. */
export function textsOf(script: string): string[] {
  return [...script.matchAll(/<voice-text\b[^>]*>(.*?)<\/voice-text>/gs)].map(([, said = '']) => read(said.replace(/<[^>]*>/g, '')));
}

/** Returns an utterance of which only the bounds are known: its words share the time by their length. */
export function guessed(text: string, startSecs: number, endSecs: number): Utterance {
  const texts = wordsOf(text);
  const whole = texts.reduce((sum, word) => sum + word.length, 0);
  let at = startSecs;
  const words = texts.map((word): Word => {
    const begun = at;
    at += ((endSecs - startSecs) * word.length) / whole;
    return { text: word, startSecs: begun, endSecs: at, emphasized: false };
  });
  return { startSecs, durationSecs: endSecs - startSecs, audio: [], words, estimated: true };
}

/** Returns the utterance with one of its words at its actual time; later words start no earlier. */
export function corrected(utterance: Utterance, index: number, heard: Word): Utterance {
  const later = ({ startSecs, endSecs, ...word }: Word): Word => ({ ...word, startSecs: Math.max(startSecs, heard.endSecs), endSecs: Math.max(endSecs, heard.endSecs) });
  return { ...utterance, words: utterance.words.map((word, i) => (i < index ? word : i === index ? heard : later(word))) };
}

/** Returns true if this utterance has the given text and time. */
export function matches(known: Utterance, text: string, startSecs: number): boolean {
  return Math.abs(known.startSecs - startSecs) < HEARD_SECS && known.words.map((word) => word.text).join(' ') === wordsOf(text).join(' ');
}

/**
 * Returns the articulation of each utterance: one begins where the mouth does not continue from the previous segment. Its first segment is the silence from
 * which the mouth opens, and ends when the utterance begins.
 */
function tracksOf(segments: readonly Segment[]): Segment[][] {
  const tracks: Segment[][] = [];
  let endSecs = NaN;
  for (const segment of segments) {
    const goesOn = Math.abs(segment.start - endSecs) < SAME_SECS;
    if (goesOn) tracks.at(-1)?.push(segment);
    else tracks.push([segment]);
    endSecs = segment.end;
  }
  return tracks;
}

const sumSecs = (msecs: readonly number[]): number => msecs.reduce((sum, ms) => sum + ms, 0) / 1000;

/** Returns true if an articulation track matches an utterance: a phone ends at its end. */
function fits(track: readonly Segment[], startSecs: number, { msecs }: BundledUtterance): boolean {
  const endSecs = startSecs + sumSecs(msecs);
  return track.some(({ end }) => Math.abs(end - endSecs) < SAME_SECS);
}

function timed({ text, msecs, words }: BundledUtterance, startSecs: number, language: string): Utterance {
  const bytes = new TextEncoder().encode(text);
  const decoder = new TextDecoder();
  const at = (phone: number): number => startSecs + sumSecs(msecs.slice(0, phone));
  const spoken = words.map(([start, length, first, count]): Word => {
    return { text: decoder.decode(bytes.subarray(start, start + length)), startSecs: at(first), endSecs: at(first + count), emphasized: false };
  });
  return { startSecs, durationSecs: at(msecs.length) - startSecs, audio: [], words: spoken, estimated: false, language };
}

/** Returns the utterances by the index in events. A bundle contains each text once, in the order of first occurrence; a story may repeat it. */
export function scriptOf({ utterances, voices }: Bundle, course: FaceCourse): Utterance[] {
  let fresh = 0;
  return tracksOf(segmentsOf(course)).map((track) => {
    const startSecs = track[0]?.end ?? 0;
    const next = utterances[fresh];
    const isNext = next !== undefined && fits(track, startSecs, next);
    if (isNext) fresh += 1;
    const said = isNext ? next : utterances.slice(0, fresh).find((known) => fits(track, startSecs, known));
    // An utterance that the bundle lacks keeps its position; its event provides the text.
    return said === undefined ? guessed('', startSecs, startSecs) : timed(said, startSecs, voices[said.voice]?.language ?? '');
  });
}

/** Returns the available utterances of texts spoken by a voice in the page: the times of their words follow during playback. */
export function scriptOfTexts(texts: readonly string[], course: FaceCourse): Utterance[] {
  // The last segment is the silence to which the mouth closes.
  return tracksOf(segmentsOf(course)).map((track, i) => guessed(texts[i] ?? '', track[0]?.end ?? 0, track.at(-1)?.start ?? 0));
}
