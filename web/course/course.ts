/** A story as a course: follows the player, brings the learner back to where they were, and tells a record of it. */

import { newSeed } from '../element/lesson/chance.js';
import type { RaconteurPlayer } from '../element/element.js';
import type { Answered, Score } from '../element/base/answers.js';
import { united, type Span } from '../element/base/ranges.js';
import { bestOf, NOTHING, type Memory, type Remembered } from './memory.js';
import type { LearningEvent, KnownLearner, Record, Report } from './report.js';
import { shareOf } from './seen.js';

/** What the author asks of a learner. */
export interface Rules {
  /** The share of the story that has to be seen, 0 to 1. */
  readonly watched: number;
  /** The share of the points that is enough, 0 to 1; undefined: nobody passes or fails. */
  readonly pass?: number | undefined;
}

/** What was told is kept no more often than this, but at once where something is complete. */
const KEEP_MS = 10_000;
/** Who has come no further when the system answers is brought to where they were; others stay. */
const BARELY_SECS = 3;
/** A story that was brought elsewhere has gone on no further when that is told. */
const SOON_SECS = 1;
const NEARLY_SECS = 0.05;

/** Who leaves waits no longer for a system. */
const LEAVE_MS = 5000;

const NO_POINTS: Score = { points: 0, most: 0 };

export class Course {
  readonly #player: RaconteurPlayer;
  readonly #record: Record;
  readonly #rules: Rules;
  readonly #end = new AbortController();
  /** What is known from sessions before, of this attempt. */
  #memory: Memory = NOTHING;
  /** What was seen in this session and in those before. */
  #seen: readonly Span[] = [];
  #isComplete = false;
  #isReview = false;
  /** The learner has answered, or was somewhere, before the system has told where they were. */
  #isAtWork = false;
  /** The share of the points that is enough. */
  #pass: number | undefined;
  /** Where the learner was when that was told last. */
  #placeSecs = 0;
  /** Where the learner was when they began to seek. */
  #fromSecs: number | undefined;
  /** To where the course itself has brought the story: nobody has sought. */
  readonly #leaps: number[] = [];
  #keptMs = -Infinity;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(player: RaconteurPlayer, record: Record, rules: Rules) {
    this.#player = player;
    this.#record = record;
    this.#rules = rules;
    this.#pass = rules.pass;
  }

  /**
   * Begins the session: the story stands where the learner left it, as soon as the system tells that. What is done before is kept.
   * Rejects with a `RecordError` where nobody keeps what they do; the story plays all the same.
   */
  async begin(): Promise<KnownLearner> {
    this.#listen();
    this.#tell();
    const known = await this.#record.open();
    const { memory, isComplete, pass, isReview = false } = known;
    this.#pass = pass ?? this.#pass;
    this.#isComplete = isComplete;
    this.#isReview = isReview;
    const go = () => {
      this.#return(memory);
      this.#tell();
    };
    // A story that cannot be had leaves the way out.
    if (this.#player.readyState > 0) go();
    else this.#player.addEventListener('loadedmetadata', go, { once: true, signal: this.#end.signal });
    return known;
  }

  /** What the learner has done before: nobody who is at work is brought elsewhere. */
  #return(memory: Memory): void {
    const { placeSecs, answered, more } = memory;
    const session = memory.session + 1;
    this.#memory = { ...memory, session };
    this.#seen = united([...this.#seen, ...memory.seen]);
    const isAnything = placeSecs > 0 || answered.length > 0 || Object.keys(more).length > 0;
    if (!isAnything) return;
    if (this.#isAtWork) this.#player.restore({ ...more, answered, placeSecs: NaN });
    else this.#go({ ...more, answered, placeSecs: placeSecs < this.#player.duration ? placeSecs : 0 });
  }

  #go(state: Parameters<RaconteurPlayer['restore']>[0]): void {
    this.#leaps.push(state.placeSecs);
    this.#player.restore(state);
  }

  #listen(): void {
    const { signal } = this.#end;
    const tell = () => this.#tell();
    for (const type of ['timeupdate', 'ended'] as const) this.#player.addEventListener(type, tell, { signal });
    const note = (kind: LearningEvent['kind']) => () => this.#note({ kind });
    this.#player.addEventListener('playing', note('played'), { signal });
    this.#player.addEventListener('pause', note('paused'), { signal });
    this.#player.addEventListener('leap', ({ detail: { toSecs } }) => this.#leaps.push(toSecs), { signal });
    // What is told while it is sought is of the place to which it goes.
    this.#player.addEventListener('seeking', () => (this.#fromSecs ??= this.#placeSecs), { signal });
    this.#player.addEventListener('seeked', () => this.#sought(), { signal });
    let askedMs = performance.now();
    this.#player.addEventListener('question', () => (askedMs = performance.now()), { signal });
    this.#player.addEventListener('answer', ({ detail }) => this.#reply(detail, performance.now() - askedMs), { signal });
    // A tab that is hidden may be closed without a word.
    document.addEventListener('visibilitychange', () => document.hidden && this.#keep(), { signal });
    addEventListener('pagehide', () => this.close(), { signal });
    addEventListener('storage', ({ key, newValue }) => this.#hear(this.#record.others?.(key, newValue)), { signal });
  }

  /** What the learner does in another page of the course counts here, too. */
  #hear(memory: Memory | undefined): void {
    if (memory === undefined || this.#player.readyState === 0 || this.#isReview) return;
    const isLater = memory.attempt > this.#memory.attempt;
    if (memory.attempt < this.#memory.attempt) return;
    if (isLater) this.#memory = { ...memory, session: this.#memory.session };
    this.#seen = united([...this.#seen, ...memory.seen]);
    this.#player.restore({ ...memory.more, answered: memory.answered, placeSecs: isLater ? this.#player.currentTime : NaN });
    this.#tell();
  }

  /** Tells the system all that it can be told now, and ends the session; resolves when that is done, or has taken too long. */
  async leave(): Promise<void> {
    const isLate = () => new Promise<void>((done) => setTimeout(done, LEAVE_MS));
    this.#tell();
    this.#keep();
    await Promise.race([this.#record.settle?.(), isLate()]);
    this.close();
    await Promise.race([this.#record.settle?.(), isLate()]);
  }

  /** Ends the session. */
  close(): void {
    if (this.#end.signal.aborted) return;
    this.#tell();
    this.#end.abort();
    clearTimeout(this.#timer);
    this.#record.close();
  }

  /** Begins the story anew: what was answered before does not count any more, but the points of the best attempt do. */
  again(): void {
    const { score } = this.#player;
    const { attempt, session, best } = this.#memory;
    this.#memory = { ...NOTHING, attempt: attempt + 1, session, best: score.most > 0 ? bestOf(best, score) : undefined };
    // What is by chance comes out anew.
    this.#go({ answered: [], seed: newSeed(), placeSecs: 0 });
    this.#tell();
    this.#keep();
    void this.#player.play().catch(() => undefined);
  }

  /** Points of this attempt and of the best one, and whether those are enough; undefined where there is no such rule. */
  get outcome(): { readonly score: Score; readonly best: Score; readonly isPassed: boolean | undefined } {
    const { score } = this.#player;
    return { score, best: bestOf(this.#memory.best, score) ?? score, isPassed: this.#verdict() };
  }

  /** Nothing is left to answer in this attempt. */
  get isSettled(): boolean {
    return this.#player.readyState > 0 && this.#player.questions.length > 0 && this.#isSettled();
  }

  #played(): readonly Span[] {
    const { played } = this.#player;
    return Array.from({ length: played.length }, (_, i): Span => [played.start(i), played.end(i)]);
  }

  /** The attempt as it is now. */
  #remembered(): Memory {
    const { ended, currentTime } = this.#player;
    const { placeSecs: _, answered, ...more } = this.#player.state();
    // Who comes back to a story that has ended sees it from the start.
    const placeSecs = (this.#placeSecs = ended ? 0 : currentTime);
    return { ...this.#memory, placeSecs, seen: this.#seen, answered: answered as readonly Remembered[], more };
  }

  #report(): Report {
    const { duration, score } = this.#player;
    this.#seen = united([...this.#seen, ...this.#played()]);
    const memory = this.#remembered();
    const progress = shareOf(this.#seen, duration, this.#player.optional);
    const isOver = this.#isComplete || progress >= this.#rules.watched;
    const best = bestOf(this.#memory.best, score.most > 0 ? score : undefined);
    return {
      placeSecs: memory.placeSecs,
      durationSecs: duration,
      progress,
      seen: this.#seen,
      isComplete: isOver,
      score: best,
      isSettled: this.#isSettled(),
      isPassed: best !== undefined && isOver ? this.#verdict() : undefined,
      memory,
    };
  }

  /** Nothing is left to answer. Not all ways come to all questions: who is at the end has come by all of theirs. */
  #isSettled(): boolean {
    const { ended, questions } = this.#player;
    const answered = this.#player.state().answered as readonly Answered[];
    return ended || questions.every(({ name }) => answered.some((it) => it.name === name && it.isFinal));
  }

  /** Whether the points are enough; nobody has failed while there is something to answer. */
  #verdict(): boolean | undefined {
    const { points, most } = bestOf(this.#memory.best, this.#player.score) ?? NO_POINTS;
    if (this.#pass === undefined || most === 0) return undefined;
    if (points / most >= this.#pass) return true;
    return this.#isSettled() ? false : undefined;
  }

  #reply(answered: Answered, latencyMs: number): void {
    this.#isAtWork = true;
    const question = this.#player.questions.find(({ name }) => name === answered.name);
    if (question === undefined) return;
    this.#record.reply?.({ question, answered, atMs: Date.now(), latencyMs });
    this.#tell();
    // What was answered is not to be lost.
    this.#keep();
  }

  /** The story stands elsewhere: by what the learner has done, unless it was brought there by its own ways. */
  #sought(): void {
    const { currentTime } = this.#player;
    const fromSecs = this.#fromSecs ?? this.#placeSecs;
    this.#fromSecs = undefined;
    const at = this.#leaps.findIndex((secs) => secs < currentTime + NEARLY_SECS && currentTime < secs + SOON_SECS);
    if (at >= 0) {
      this.#leaps.splice(0, at + 1);
      this.#tell();
      return;
    }
    this.#isAtWork = true;
    this.#note({ kind: 'seeked', fromSecs });
  }

  #note(what: LearningEvent): void {
    this.#tell();
    this.#record.note?.(what);
  }

  #tell(): void {
    // Before the story is there nothing is known of the learner's place in it; who only looks at it does nothing.
    if (this.#player.readyState === 0 || this.#isReview) return;
    if (this.#player.currentTime > BARELY_SECS) this.#isAtWork = true;
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
