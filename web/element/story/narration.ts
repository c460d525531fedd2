/** Streaming narration: incoming text is split into clauses, each performed as soon as it is complete. Fetched only where it is used. */

import { openInstance, type NarrationFunctions } from '../engine/backend.js';
import { languageOf, type PlayerContext } from './context.js';
import { perform, Sender } from './fragments.js';
import type { Show } from './show.js';
import type { Answer } from '../base/performance.js';
import type { Diagnostic, Words } from '../base/types.js';

/** Length to which a longer text is truncated. */
const MAX_CHARACTERS = 100_000;
/** Maximum queued speech: later text may be interrupted, and the queue takes memory. */
const AHEAD_SECS = 20;
/** Polling interval for the story time, and for an engine that is busy or absent. */
const LOOK_MS = 100;
/** Number of attempts after which an unresponsive engine is given up. */
const MAX_TRIES = 300;

/** Stage on which a text is narrated. */
export interface NarrationContext {
  /** Narration functions of its engine. */
  readonly telling: Pick<NarrationFunctions, 'continueNarration' | 'splitClauses'>;
  /** Language of the text, a BCP 47 tag. */
  readonly language: string;
  perform(fragment: string): readonly Answer[] | Promise<readonly Answer[]>;
  /** Returns the story time. */
  now(): number;
  report(diagnostic: Diagnostic): void;
}

/** Temporary refusals, worth a retry. */
const LATER = new Set(['live::busy', 'live::full', 'live::absent']);

/** Speaks clauses one after another, until aborted. */
class Speaker {
  readonly #stage: NarrationContext;
  readonly #end: AbortSignal;
  #emotion = 'neutral';
  /** End of all accepted speech. */
  #endSecs = 0;

  constructor(stage: NarrationContext, end: AbortSignal) {
    this.#stage = stage;
    this.#end = end;
  }

  async say(clause: string): Promise<void> {
    const made = this.#stage.telling.continueNarration(clause, this.#stage.language, this.#emotion);
    if (made === undefined) return;
    for (let tries = 0; tries < MAX_TRIES; tries++) {
      await this.#until(AHEAD_SECS);
      if (this.#end.aborted) return;
      const answers = await this.#stage.perform(made.fragment);
      const clauses = answers.flatMap((answer) => (answer.kind === 'accepted' ? answer.clauses : []));
      const said = clauses.filter(({ element }) => element === 'voice-text');
      this.#endSecs = Math.max(this.#endSecs, ...said.map(({ endSecs }) => endSecs));
      this.#emotion = made.emotion;
      if (clauses.length > 0 || !answers.some((answer) => answer.kind === 'failed' && LATER.has(answer.code))) return;
      await this.#look();
    }
  }

  /** Waits until everything has been spoken. */
  silence(): Promise<void> {
    return this.#until(0);
  }

  /** Waits until at most this many seconds of speech remain. */
  async #until(secs: number): Promise<void> {
    while (!this.#end.aborted && this.#endSecs - this.#stage.now() > secs) await this.#look();
  }

  #look(): Promise<void> {
    return new Promise((done) => setTimeout(done, LOOK_MS));
  }
}

/** Source of text in pieces. */
interface TextPieces {
  next(): Promise<{ readonly done?: boolean | undefined; readonly value?: unknown }>;
  return?(): Promise<unknown>;
}

function piecesOf(words: Words): TextPieces {
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
  message: `A text has more than ${MAX_CHARACTERS} characters; the rest is left out.`,
  hints: ['Split it into parts.'],
};

/** Narrates a text until it is spoken, or aborted by `end`; rethrows errors of the source after the text before them. */
export async function tellTo(stage: NarrationContext, words: Words, end: AbortSignal): Promise<void> {
  const speaker = new Speaker(stage, end);
  const cut = (text: string, whole: boolean) => stage.telling.splitClauses(text, stage.language, whole);
  const over = new Promise<undefined>((done) => end.addEventListener('abort', () => done(undefined), { once: true }));
  let pieces: TextPieces | undefined;
  let failure: { readonly error: unknown } | undefined;
  let [rest, room] = ['', MAX_CHARACTERS];
  try {
    pieces = piecesOf(words);
    while (!end.aborted) {
      const next = await Promise.race([pieces.next(), over]);
      if (next === undefined || next.done) break;
      const piece = String(next.value);
      const whole = cut(rest + piece.slice(0, room), false);
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
  // A source that is not read to its end is closed; errors of a failed source are ignored.
  pieces?.return?.().catch(() => undefined);
  for (const clause of cut(rest, true).clauses) await speaker.say(clause);
  await speaker.silence();
  if (failure !== undefined && !end.aborted) throw failure.error;
}

/** Narrates a text on the stage of a player; the clock does not stop while text is missing. */
export async function tellWords(context: PlayerContext, show: Show, words: Words, end: AbortSignal): Promise<void> {
  const stage: NarrationContext = {
    telling: await openInstance(show.picture.backend),
    language: languageOf(context.player, show.story),
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
