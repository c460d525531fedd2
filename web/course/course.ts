/** A story as a course: follows the player, restores the learner's position, and reports to a record. */

import { newSeed } from '../element/lesson/chance.js';
import type { RaconteurPlayer } from '../element/element.js';
import type { Answered, Score } from '../element/base/answers.js';
import { united, type Span } from '../element/base/ranges.js';
import { bestOf, NOTHING, type Memory, type Remembered } from './memory.js';
import type { LearningEvent, KnownLearner, Record, Report } from './report.js';
import { shareOf } from './seen.js';

/** The author's rules for a learner. */
export interface Rules {
  /** Share of the story that must be seen, 0 to 1. */
  readonly watched: number;
  /** Share of the points required to pass, 0 to 1; undefined: there is no pass or fail. */
  readonly pass?: number | undefined;
}

/** Minimum interval between saves, milliseconds; completion is saved immediately. */
const KEEP_MS = 10_000;
/** Story time up to which a late response of the system restores the learner's position, seconds; later the learner stays. */
const BARELY_SECS = 3;
/** Maximum progress of a story after a jump when the jump is reported, seconds. */
const SOON_SECS = 1;
const NEARLY_SECS = 0.05;

/** Maximum time that leaving waits for a system, milliseconds. */
const LEAVE_MS = 5000;

const NO_POINTS: Score = { points: 0, most: 0 };

export class Course {
  readonly #player: RaconteurPlayer;
  readonly #record: Record;
  readonly #rules: Rules;
  readonly #end = new AbortController();
  /** Data from earlier sessions of this attempt. */
  #memory: Memory = NOTHING;
  /** Spans seen in this session and in earlier ones. */
  #seen: readonly Span[] = [];
  #isComplete = false;
  #isReview = false;
  /** True if the learner has answered, or moved, before the system reported their position. */
  #isAtWork = false;
  /** The share of the points that is enough. */
  #pass: number | undefined;
  /** Last reported position of the learner, seconds. */
  #placeSecs = 0;
  /** Position of the learner at the start of a seek. */
  #fromSecs: number | undefined;
  /** Destinations of jumps made by the course itself, which are not seeks by the learner. */
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
   * Begins the session: the story is at the learner's last position, as soon as the system reports it. Earlier actions are kept. Rejects with a `RecordError`
   * if there is no record; the story still plays.
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
    // A story that fails to load omits the path.
    if (this.#player.readyState > 0) go();
    else this.#player.addEventListener('loadedmetadata', go, { once: true, signal: this.#end.signal });
    return known;
  }

  /** Restores the learner's earlier state; a learner who is already active is not moved. */
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
    // Reports during a seek refer to the target position.
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

  /** Merges the learner's actions from another page of the course. */
  #hear(memory: Memory | undefined): void {
    if (memory === undefined || this.#player.readyState === 0 || this.#isReview) return;
    const isLater = memory.attempt > this.#memory.attempt;
    if (memory.attempt < this.#memory.attempt) return;
    if (isLater) this.#memory = { ...memory, session: this.#memory.session };
    this.#seen = united([...this.#seen, ...memory.seen]);
    this.#player.restore({ ...memory.more, answered: memory.answered, placeSecs: isLater ? this.#player.currentTime : NaN });
    this.#tell();
  }

  /** Reports the final state to the system and ends the session; resolves when done, or after a time limit. */
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

  /** Restarts the story: earlier answers no longer count, but the points of the best attempt do. */
  again(): void {
    const { score } = this.#player;
    const { attempt, session, best } = this.#memory;
    this.#memory = { ...NOTHING, attempt: attempt + 1, session, best: score.most > 0 ? bestOf(best, score) : undefined };
    // Random choices are drawn again.
    this.#go({ answered: [], seed: newSeed(), placeSecs: 0 });
    this.#tell();
    this.#keep();
    void this.#player.play().catch(() => undefined);
  }

  /** Points of this attempt and of the best one, and true if they suffice; undefined without such a rule. */
  get outcome(): { readonly score: Score; readonly best: Score; readonly isPassed: boolean | undefined } {
    const { score } = this.#player;
    return { score, best: bestOf(this.#memory.best, score) ?? score, isPassed: this.#verdict() };
  }

  /** True if no question is left to answer in this attempt. */
  get isSettled(): boolean {
    return this.#player.readyState > 0 && this.#player.questions.length > 0 && this.#isSettled();
  }

  #played(): readonly Span[] {
    const { played } = this.#player;
    return Array.from({ length: played.length }, (_, i): Span => [played.start(i), played.end(i)]);
  }

  /** Current state of the attempt, for storage. */
  #remembered(): Memory {
    const { ended, currentTime } = this.#player;
    const { placeSecs: _, answered, ...more } = this.#player.state();
    // Learners who return to an ended story see it from the start.
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

  /** Returns true if no question is left to answer. Not all paths lead to all questions: at the end all reachable ones have been passed. */
  #isSettled(): boolean {
    const { ended, questions } = this.#player;
    const answered = this.#player.state().answered as readonly Answered[];
    return ended || questions.every(({ name }) => answered.some((it) => it.name === name && it.isFinal));
  }

  /** Returns true if the points suffice; undefined while questions are open and the points do not suffice. */
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
    // Stores the answers so that they are not lost.
    this.#keep();
  }

  /** Handles a changed position: a seek by the learner, or a jump by the story itself. */
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
    // Before the story has loaded, the learner's position is unknown; in review mode nothing is
    // recorded.
    if (this.#player.readyState === 0 || this.#isReview) return;
    if (this.#player.currentTime > BARELY_SECS) this.#isAtWork = true;
    const report = this.#report();
    const isNews = report.isComplete && !this.#isComplete;
    this.#isComplete = report.isComplete;
    this.#record.save(report);
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
