/** Words that come piece by piece: cut into clauses, each of which is performed as soon as it is whole. Fetched only where it is used. */

import { SIGN_FIRST, toldOn } from '../speech/told.js';
import type { PlayerContext } from './context.js';
import { perform, Sender } from './fragments.js';
import type { Show } from './show.js';
import type { Answer, Diagnostic, Words } from './types.js';

/** A longer text is told so far. */
const MOST_CHARACTERS = 100_000;
/** What has no end for so long is cut between two words. */
const LONGEST_CLAUSE = 240;
/** A comma or dash ends a clause of so many words. */
const ENOUGH_WORDS = 5;
/** No more than this is waiting to be said: what comes may be interrupted, and what waits takes room. */
const AHEAD_SECS = 20;
/** The story time, and an engine that is busy or away, are asked this often. */
const LOOK_MS = 100;
/** An engine that takes nothing for so long will not. */
const MOST_TRIES = 300;

/** A mark with the signs that close after it, before a space; a long dash needs none. The end of a line. */
const MARKS = /([.?!…;:]+|,)["'”’»)\]]*(?=\s)|\s[–-](?=\s)|—(?=.)|\n/gsu;
/** Words before a point that is no end, besides initials, numbers and what has points in it. */
const ABBREVIATIONS = new Set('mr mrs ms dr st prof sr jr vs etc no vol fig ca bzw usw nr hr fr evtl ggf inkl approx dept ave'.split(' '));

/** Whether the point after a word ends something. */
function ends(word: string): boolean {
  const bare = word.replace(/^["'“‘«([]+/, '').toLowerCase();
  return !(ABBREVIATIONS.has(bare) || /^(?:\p{L}|\d{1,2})$/u.test(bare) || /[\p{L}\d]\.[\p{L}\d]/u.test(bare));
}

const countWords = (text: string): number => text.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;

/** Where a text that is too long for one clause is cut: after a word, and never in the middle of a character. */
function tooLong(text: string): number {
  const space = text.lastIndexOf(' ', LONGEST_CLAUSE);
  if (space > 0) return space;
  return /[\uD800-\uDBFF]/.test(text.charAt(LONGEST_CLAUSE - 1)) ? LONGEST_CLAUSE - 1 : LONGEST_CLAUSE;
}

/** The clauses that are whole, and what is not; all of them put together are the text. */
export function cut(text: string): { clauses: string[]; rest: string } {
  const clauses: string[] = [];
  let from = 0;
  const take = (to: number) => {
    while (to - from > LONGEST_CLAUSE) {
      const next = from + tooLong(text.slice(from, from + LONGEST_CLAUSE + 1));
      clauses.push(text.slice(from, next));
      from = next;
    }
  };
  for (const { 0: mark, 1: sign, index } of text.matchAll(MARKS)) {
    if (index < from) continue;
    const before = text.slice(from, index);
    const words = countWords(before);
    const weak = mark !== '\n' && (sign === undefined || sign === ',');
    // What says nothing yet goes with what follows.
    if (words === 0 || (weak && words < ENOUGH_WORDS)) continue;
    if (sign === '.' && !ends(/\S+$/.exec(before)?.[0] ?? '')) continue;
    // A sign of a feeling belongs to what is before it.
    const felt = weak ? undefined : SIGN_FIRST.exec(text.slice(index + mark.length, index + mark.length + 16))?.[0];
    const end = index + mark.length + (felt?.length ?? 0);
    take(end);
    if (end > from) clauses.push(text.slice(from, end));
    from = Math.max(from, end);
  }
  take(text.length);
  return { clauses, rest: text.slice(from) };
}

/** Where a text is told. */
export interface Stage {
  perform(fragment: string): readonly Answer[] | Promise<readonly Answer[]>;
  /** Story time. */
  now(): number;
  report(diagnostic: Diagnostic): void;
}

/** Answers that may be others later. */
const LATER = new Set(['live::busy', 'live::full', 'live::absent']);

/** Says clauses one after another, until it ends. */
class Speaker {
  readonly #stage: Stage;
  readonly #end: AbortSignal;
  #feels = 'neutral';
  /** When all that was accepted has been said. */
  #endSecs = 0;

  constructor(stage: Stage, end: AbortSignal) {
    this.#stage = stage;
    this.#end = end;
  }

  async say(clause: string): Promise<void> {
    const made = toldOn(clause, this.#feels);
    if (made === undefined) return;
    for (let tries = 0; tries < MOST_TRIES; tries++) {
      await this.#until(AHEAD_SECS);
      if (this.#end.aborted) return;
      const answers = await this.#stage.perform(made.fragment);
      const clauses = answers.flatMap((answer) => (answer.kind === 'accepted' ? answer.clauses : []));
      const said = clauses.filter(({ element }) => element === 'voice-text');
      this.#endSecs = Math.max(this.#endSecs, ...said.map(({ endSecs }) => endSecs));
      this.#feels = made.feels;
      if (clauses.length > 0 || !answers.some((answer) => answer.kind === 'failed' && LATER.has(answer.code))) return;
      await this.#look();
    }
  }

  /** Waits until everything has been said. */
  silence(): Promise<void> {
    return this.#until(0);
  }

  /** Waits until no more than so many seconds are to be said. */
  async #until(secs: number): Promise<void> {
    while (!this.#end.aborted && this.#endSecs - this.#stage.now() > secs) await this.#look();
  }

  #look(): Promise<void> {
    return new Promise((done) => setTimeout(done, LOOK_MS));
  }
}

/** What gives a text piece by piece. */
interface Pieces {
  next(): Promise<{ readonly done?: boolean | undefined; readonly value?: unknown }>;
  return?(): Promise<unknown>;
}

function piecesOf(words: Words): Pieces {
  if (typeof words === 'string') {
    const all = [words];
    return { next: () => Promise.resolve(all.length > 0 ? { value: all.pop() } : { done: true }) };
  }
  // Not every browser iterates over streams.
  if ('getReader' in words) {
    const reader = words.getReader();
    return { next: () => reader.read(), return: () => reader.cancel() };
  }
  const iterator = words[Symbol.asyncIterator]();
  return { next: () => iterator.next(), return: () => Promise.resolve(iterator.return?.()) };
}

const tooMuch: Diagnostic = {
  code: 'tell-too-long',
  severity: 'warning',
  message: `A text of more than ${MOST_CHARACTERS} characters is told so far; the rest is left out.`,
  hints: ['Tell it in parts.'],
};

/** Tells a text until it is said, or `end`; throws what its source throws, after what came before. */
export async function tellTo(stage: Stage, words: Words, end: AbortSignal): Promise<void> {
  const speaker = new Speaker(stage, end);
  const over = new Promise<undefined>((done) => end.addEventListener('abort', () => done(undefined), { once: true }));
  let pieces: Pieces | undefined;
  let failure: { readonly error: unknown } | undefined;
  let [rest, room] = ['', MOST_CHARACTERS];
  try {
    pieces = piecesOf(words);
    while (!end.aborted) {
      const next = await Promise.race([pieces.next(), over]);
      if (next === undefined || next.done) break;
      const piece = String(next.value);
      const whole = cut(rest + piece.slice(0, room));
      rest = whole.rest;
      for (const clause of whole.clauses) await speaker.say(clause);
      if (piece.length > room) {
        stage.report(tooMuch);
        break;
      }
      room -= piece.length;
    }
  } catch (error) {
    failure = { error };
  }
  // A source that is not read to its end is let go; one that has failed has nothing to say about that.
  pieces?.return?.().catch(() => undefined);
  for (const clause of cut(`${rest}\n`).clauses) await speaker.say(clause);
  await speaker.silence();
  if (failure !== undefined && !end.aborted) throw failure.error;
}

/** Tells a text on the stage of a player; the clock does not stop for want of words meanwhile. */
export async function tellWords(context: PlayerContext, show: Show, words: Words, end: AbortSignal): Promise<void> {
  const stage: Stage = {
    perform: (fragment) => perform(context, show, Sender.Page, fragment),
    now: () => show.transport.position,
    report: (diagnostic) => context.diagnostics.report(diagnostic),
  };
  show.tellings += 1;
  try {
    await tellTo(stage, words, AbortSignal.any([end, show.turn.signal, show.end.signal]));
  } finally {
    show.tellings -= 1;
    context.advance();
  }
}
