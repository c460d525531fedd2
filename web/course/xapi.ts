/**
 * A course with a record store: launched by a link with the store's address, like Tin Can packages, or by a cmi5 system
 * (https://aicc.github.io/CMI-5_Spec_Current, 8 to 11), whose session has rules of its own.
 */

import type { Score } from '../element/base/answers.js';
import { answeredOf } from './answered.js';
import { StateKeeper } from './keeper.js';
import { launchOf, linkOf, textOf, type Launch, type Link } from './launch.js';
import { bestOf, joined, NOTHING, readMemory, writeMemory, type Memory } from './memory.js';
import { Outbox } from './outbox.js';
import type { LearningEvent, KnownLearner, Record, Reply, Report } from './report.js';
import { LocalCopy, Slot, type Shelf } from './shelf.js';
import { hasVerb, launchedAs, movedTo, statementOf, type LearnerPosition, type Session, type Verb } from './statements.js';
import { RecordStore, type Outcome, type Statement } from './store.js';
import { StorageProblems } from './storage-problems.js';

/** Identifier of the course's memory in the store. */
const STATE = 'raconteur';

/** The author's description of the course. */
export interface Course {
  readonly activityId: string;
  readonly title: string;
  readonly language: string;
  readonly watched: number;
}

/** Statements already made that are allowed once per registration, and the last reported score. */
interface SentStatement {
  readonly isComplete: boolean;
  readonly verdict?: 'passed' | 'failed' | undefined;
  readonly score?: Score | undefined;
}

/** Reads the made statements from the state. */
function saidIn(text: string): SentStatement & { readonly memory: string } {
  try {
    const { memory, isComplete, verdict, score } = JSON.parse(text) as { [name in keyof SentStatement | 'memory']?: unknown };
    return {
      memory: typeof memory === 'string' ? memory : '',
      isComplete: isComplete === true,
      verdict: verdict === 'passed' || verdict === 'failed' ? verdict : undefined,
      score: typeof (score as Score | undefined)?.points === 'number' ? (score as Score) : undefined,
    };
  } catch {
    return { memory: '', isComplete: false };
  }
}

/** A session with a record store. */
export class XapiRecord implements Record {
  readonly troubles = new StorageProblems();
  readonly #link: Link | undefined;
  readonly #failure: unknown;
  readonly #course: Course;
  readonly #shelf: Shelf | undefined;
  readonly #sinceMs = performance.now();
  #session: Session | undefined;
  #outbox: Outbox | undefined;
  #copy: LocalCopy | undefined;
  /** Memory at the start of the session, extended until the store answers. */
  #earlier: Memory = NOTHING;
  /** Slot with the made statements in addition to the memory, which the store may lack. */
  #saidSlot: Slot | undefined;
  /** Undefined until the store has answered. */
  #launch: Launch | undefined;
  #keeper: StateKeeper | undefined;
  #last: Report = { placeSecs: 0, progress: 0, seen: [], durationSecs: 0, isComplete: false, memory: NOTHING, score: undefined, isSettled: false, isPassed: undefined };
  #said: SentStatement = { isComplete: false };
  /** True if passed or failed was stated in this session; a cmi5 session allows only one of them. */
  #isJudged = false;
  #isClosed = false;

  /** Creates the record; `address`: that of the page; `shelf`: storage of statements and answers that the store has not accepted. */
  constructor(address: string, course: Course, shelf: Shelf | undefined) {
    this.#course = course;
    this.#shelf = shelf;
    try {
      this.#link = linkOf(address, course.activityId);
    } catch (error) {
      // `open` reports the failure.
      this.#failure = error;
      return;
    }
    this.#begin(this.#link);
  }

  /** Begins the session; statements made before the store answers wait in the outbox. */
  #begin({ actor, owner, fetch }: Link): void {
    const { title, language, watched } = this.#course;
    const { activityId, registration, agent } = owner;
    const isCmi5 = fetch !== undefined;
    this.#session = { actor, activityId, title, language: language || 'und', registration, sessionId: crypto.randomUUID(), threshold: watched, isCmi5, masteryScore: undefined };
    const name = `${registration ?? ''}:${activityId}:${agent}`;
    this.#copy = new LocalCopy(this.#shelf, `raconteur-state:${name}`);
    this.#earlier = this.#copy.get();
    this.troubles.isKept = this.#shelf !== undefined;
    this.#saidSlot = new Slot(this.#shelf, `raconteur-said:${name}`);
    this.#outbox = new Outbox(`raconteur-statements:${name}`, this.#shelf, {
      send: (batch) => this.#send(batch),
      trouble: (what, trouble) => this.troubles.set(what, trouble),
    });
    this.#say('initialized');
  }

  async #send(batch: readonly Statement[]): Promise<Outcome> {
    if (this.#launch === undefined) return 'away';
    const { access, template } = this.#launch;
    return new RecordStore(access).send(batch.map((statement) => launchedAs(statement, template)));
  }

  async open(): Promise<KnownLearner> {
    if (this.#link === undefined || this.#session === undefined) throw this.#failure;
    const { owner } = this.#link;
    const waiting = { trouble: this.troubles.set.bind(this.troubles), isClosed: () => this.#isClosed };
    const launch = await launchOf(this.#link, waiting);
    const text = launch && (await textOf(() => new RecordStore(launch.access).state(owner, STATE), waiting));
    // The page unloaded first: the results stay in local storage for the next session.
    if (launch === undefined || text === undefined) return new Promise(() => undefined);
    const { masteryScore: pass, isReview, isMuted, returnAddress } = launch;
    this.#launch = launch;
    this.#session = { ...this.#session, masteryScore: pass };
    this.#keeper = new StateKeeper(
      text,
      (state) => new RecordStore(launch.access).putState(owner, STATE, state),
      (outcome) => this.#stateTold(outcome),
    );
    const { memory, ...said } = saidIn(text);
    this.#said = this.#saidOf(said, saidIn(this.#saidSlot?.get() ?? ''));
    this.#outbox?.open((waiting) => this.#arranged(waiting));
    const known = joined(this.#copy?.get() ?? NOTHING, readMemory(memory));
    // A learner who leaves before the story has loaded has seen nothing new.
    this.#last = { ...this.#last, memory: known };
    return { memory: known, isComplete: this.#said.isComplete, pass, isReview, isMuted, returnAddress };
  }

  /** Merges the statements already made, from the store, this browser and the outbox: they are not repeated. */
  #saidOf(...known: readonly SentStatement[]): SentStatement {
    const waiting = this.#outbox?.waiting ?? [];
    const has = (verb: Verb) => waiting.some((statement) => hasVerb(statement, verb));
    const verdicts = new Set(known.map(({ verdict }) => verdict));
    const isPassed = verdicts.has('passed') || has('passed');
    const isFailed = verdicts.has('failed') || has('failed');
    return {
      isComplete: known.some(({ isComplete }) => isComplete) || has('completed'),
      verdict: isPassed ? 'passed' : isFailed ? 'failed' : undefined,
      score: known.reduce<Score | undefined>((best, { score }) => bestOf(best, score), undefined),
    };
  }

  #stateTold(outcome: Outcome): void {
    this.troubles.set('state', outcome === 'taken' ? undefined : outcome);
    // Data in the store is removed from the computer, because others may use it.
    if (outcome === 'taken' && this.#keeper?.isKept) {
      this.#copy?.clear();
      this.#saidSlot?.clear();
    }
  }

  /**
   * Returns the order for sending statements left over from earlier sessions. A cmi5 session begins and ends with its own statements (9.3): older ones are
   * sent inside it, without the marks of ended sessions.
   */
  #arranged(waiting: readonly Statement[]): readonly Statement[] {
    const session = this.#session;
    if (session === undefined) return waiting;
    const isMark = (statement: Statement) => hasVerb(statement, 'initialized', 'terminated');
    if (this.#launch?.isReview) return waiting.filter((statement) => isMark(statement) && isOf(statement, session));
    if (!session.isCmi5) return waiting;
    const own = waiting.filter((statement) => isOf(statement, session));
    const older = waiting.filter((statement) => !isOf(statement, session) && !isMark(statement));
    this.#isJudged ||= older.some((statement) => hasVerb(statement, 'passed', 'failed'));
    return [...own.slice(0, 1), ...older.map((statement) => movedTo(statement, session)), ...own.slice(1)];
  }

  save(report: Report): void {
    this.#last = report;
    if (this.#launch?.isReview !== true) this.#copy?.follow(this.#known(report.memory));
    // The earlier results are not known yet.
    if (this.#launch === undefined || this.#launch.isReview) return;
    if (report.isComplete && !this.#said.isComplete) {
      this.#say('completed', { isComplete: true });
    }
    if (report.isSettled) this.#judge(false);
  }

  /**
   * States passed or failed: as soon as no question is left to answer, with the final score, or at the end of a session. A learner who has passed can no
   * longer fail (cmi5, 9.3), and a cmi5 session contains only one of them: after failing, a learner may retry until it ends.
   */
  #judge(isEnd: boolean): void {
    const { isPassed, score, isSettled } = this.#last;
    const verdict = isPassed === undefined ? undefined : isPassed ? 'passed' : 'failed';
    const isOpen = this.#said.verdict !== 'passed' && this.#said.verdict !== verdict && !(this.#session?.isCmi5 && this.#isJudged);
    if (verdict !== undefined && isOpen && (isEnd || isPassed || !this.#session?.isCmi5)) {
      this.#isJudged = true;
      this.#say(verdict, { verdict, score });
      this.keep();
    } else if (score !== undefined && (isEnd || (isSettled && this.#said.verdict !== undefined)) && score.points !== (this.#said.score?.points ?? 0)) {
      this.#say('scored', { score });
    }
  }

  note({ kind, fromSecs }: LearningEvent): void {
    this.#say(kind, {}, fromSecs);
  }

  reply(reply: Reply): void {
    if (this.#session !== undefined && this.#launch?.isReview !== true) this.#outbox?.add(answeredOf(this.#session, reply));
  }

  /** Merges a memory with this browser's earlier data, until the store has answered. */
  #known(memory: Memory): Memory {
    return this.#launch === undefined ? joined(memory, this.#earlier) : memory;
  }

  keep(): void {
    if (this.#launch?.isReview || this.#isClosed) return;
    const { memory } = this.#last;
    if (this.#copy?.put(this.#known(memory)) === false) this.troubles.set('the browser', 'unkept');
    if (this.#launch !== undefined) this.#keeper?.keep(JSON.stringify({ memory: writeMemory(memory), ...this.#said }));
  }

  others(key: string | null, text: string | null): Memory | undefined {
    return this.#copy?.others(key, text);
  }

  async settle(): Promise<void> {
    if (this.#isClosed) await this.#outbox?.settle();
    else await this.#outbox?.flush();
  }

  close(): void {
    if (this.#isClosed || this.#session === undefined) return;
    if (this.#launch?.isReview === false) this.#judge(true);
    this.keep();
    this.#say('terminated');
    this.#isClosed = true;
    this.#keeper?.close();
    this.#outbox?.close();
  }

  /** Makes a statement. In review mode only the start and the end of the session are stated (cmi5, 10: `launchMode`). */
  #say(verb: Verb, said: Partial<SentStatement> = {}, fromSecs?: number): void {
    if (this.#session === undefined || this.#isClosed) return;
    if (this.#launch?.isReview && verb !== 'initialized' && verb !== 'terminated') return;
    const { placeSecs, durationSecs, progress, seen, isSettled } = this.#last;
    // Before the store has answered, the earlier score is unknown.
    const score = this.#launch === undefined ? undefined : this.#last.score;
    const moment: LearnerPosition = { placeSecs, fromSecs, durationSecs, progress, seen, score, isSettled, spentMs: performance.now() - this.#sinceMs };
    if (Object.keys(said).length > 0) this.#saidSlot?.set(JSON.stringify((this.#said = { ...this.#said, ...said })));
    this.#outbox?.add(statementOf(verb, this.#session, moment));
  }
}

const isOf = (statement: Statement, { sessionId }: Session): boolean => JSON.stringify(statement['context'] ?? {}).includes(sessionId);
