/** A story as a course: follows the player, brings the learner back to where they were, and tells a record of it. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Answered } from '../element/lesson.js';
import { united, type Span } from '../element/ranges.js';
import type { Happening, Record, Report } from './report.js';
import { answersIn, readMemory, shareOf, writeMemory } from './seen.js';

/** What the author asks of a learner. */
export interface Rules {
  /** The share of the story that has to be seen, 0 to 1. */
  readonly watched: number;
  /** The share of the points that is enough, 0 to 1; undefined: nobody passes or fails. */
  readonly pass?: number | undefined;
}

/** What was told is kept no more often than this, but at once where something is complete. */
const KEEP_MS = 10_000;

export class Course {
  readonly #player: RaconteurPlayer;
  readonly #record: Record;
  readonly #rules: Rules;
  readonly #end = new AbortController();
  /** What was seen in this session and in those before. */
  #seen: readonly Span[] = [];
  #isComplete = false;
  /** The share of the points that is enough. */
  #pass: number | undefined;
  /** Where the learner was when that was told last. */
  #placeSecs = 0;
  #keptMs = -Infinity;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(player: RaconteurPlayer, record: Record, rules: Rules) {
    this.#player = player;
    this.#record = record;
    this.#rules = rules;
    this.#pass = rules.pass;
  }

  /** Begins the session: the story stands where the learner left it. Rejects with a `RecordError` where nobody keeps what they do; the story plays all the same. */
  async begin(): Promise<void> {
    const { memory, isComplete, pass } = await this.#record.open();
    this.#pass = pass ?? this.#pass;
    const { placeSecs, seen, answered, more } = readMemory(memory);
    this.#seen = seen;
    this.#isComplete = isComplete;
    if (placeSecs > 0 || answered !== undefined) this.#return(placeSecs, { ...more, answered });
    this.#listen();
    this.#tell();
  }

  #return(placeSecs: number, state: { readonly answered: unknown }): void {
    const player = this.#player;
    const go = () => {
      player.restore({ ...state, placeSecs: placeSecs < player.duration ? placeSecs : 0 });
    };
    if (player.readyState > 0) go();
    else player.addEventListener('loadedmetadata', go, { once: true });
  }

  #listen(): void {
    const { signal } = this.#end;
    const tell = () => this.#tell();
    for (const type of ['timeupdate', 'ended'] as const) this.#player.addEventListener(type, tell, { signal });
    const note = (kind: Happening['kind']) => () => this.#note({ kind });
    this.#player.addEventListener('playing', note('played'), { signal });
    this.#player.addEventListener('pause', note('paused'), { signal });
    this.#player.addEventListener('seeked', () => this.#note({ kind: 'seeked', fromSecs: this.#placeSecs }), { signal });
    let askedMs = performance.now();
    this.#player.addEventListener('question', () => (askedMs = performance.now()), { signal });
    this.#player.addEventListener('answer', ({ detail }) => this.#reply(detail, performance.now() - askedMs), { signal });
    // A tab that is hidden may be closed without a word.
    document.addEventListener('visibilitychange', () => document.hidden && this.#keep(), { signal });
    addEventListener('pagehide', () => this.close(), { signal });
  }

  /** Ends the session. */
  close(): void {
    if (this.#end.signal.aborted) return;
    this.#tell();
    this.#end.abort();
    clearTimeout(this.#timer);
    this.#record.close();
  }

  #report(): Report {
    const { duration, currentTime, ended, played, score } = this.#player;
    const now = Array.from({ length: played.length }, (_, i): Span => [played.start(i), played.end(i)]);
    this.#seen = united([...this.#seen, ...now]);
    const progress = shareOf(this.#seen, duration, this.#player.optional);
    // Who comes back to a story that has ended sees it from the start.
    const placeSecs = (this.#placeSecs = ended ? 0 : currentTime);
    const asks = score.most > 0;
    const share = asks ? score.points / score.most : 0;
    const { placeSecs: _, answered, ...more } = this.#player.state();
    const isOver = this.#isComplete || progress >= this.#rules.watched;
    return {
      placeSecs,
      score: asks ? score : undefined,
      isPassed: asks && isOver ? this.#isEnough(share, answersIn(answered) as readonly Answered[]) : undefined,
      durationSecs: duration,
      progress,
      seen: this.#seen,
      isComplete: isOver,
      memory: writeMemory({ placeSecs, seen: this.#seen, answered, more }, this.#record.mostMemory),
    };
  }

  /** Whether a share of the points is enough; nobody has failed while there is something to answer. Not all ways come to all questions. */
  #isEnough(share: number, answered: readonly Answered[]): boolean | undefined {
    if (this.#pass === undefined) return undefined;
    if (share >= this.#pass) return true;
    const isSettled = this.#player.ended || this.#player.questions.every(({ name }) => answered.some((it) => it.name === name && it.isFinal));
    return isSettled ? false : undefined;
  }

  #reply(answered: Answered, latencyMs: number): void {
    const question = this.#player.questions.find(({ name }) => name === answered.name);
    if (question === undefined) return;
    this.#record.reply?.({ question, answered, atMs: Date.now(), latencyMs });
    this.#tell();
    // What was answered is not to be lost.
    this.#keep();
  }

  #note(what: Happening): void {
    this.#tell();
    this.#record.note?.(what);
  }

  #tell(): void {
    // Before the story is there nothing is known of the learner's place in it.
    if (this.#player.readyState === 0) return;
    const report = this.#report();
    const isNews = report.isComplete && !this.#isComplete;
    this.#isComplete = report.isComplete;
    this.#record.tell(report);
    if (isNews) this.#keep();
    else this.#timer ??= setTimeout(() => this.#keep(), Math.max(0, this.#keptMs + KEEP_MS - performance.now()));
  }

  #keep(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#keptMs = performance.now();
    this.#record.keep();
  }
}
