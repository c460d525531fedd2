/**
 * A course with a record store: launched by a link with the store's address, as Tin Can packages are, or by a cmi5 system
 * (https://aicc.github.io/CMI-5_Spec_Current, 8 to 10), whose session has rules of its own.
 */

import { answeredOf } from './answered.js';
import { Backup, writeKept, type Verdict } from './kept.js';
import { Outbox, type Shelf } from './outbox.js';
import { RecordError, type Happening, type Known, type Record, type Reply, type Report } from './report.js';
import { statementOf, type Moment, type Session, type Verb } from './statements.js';
import { RecordStore, type Access, type Owner } from './store.js';

/** Under which a course keeps its memory in the store. */
const STATE = 'raconteur';
const NOT_FOUND = 'Nothing is recorded.';
/** After each of them a store that is away is asked again: some two minutes in all. */
const WAITS_MS = [1000, 2000, 4000, 8000, 16_000, 30_000, 60_000];

/** What the course's author says of it. */
export interface Course {
  readonly activityId: string;
  readonly title: string;
  readonly language: string;
  readonly watched: number;
}

interface Launched {
  readonly access: Access;
  readonly owner: Owner;
  readonly session: Session;
  /** Somebody only looks at it: nothing is said of what they have done. */
  readonly isReview: boolean;
}

/** What the address of the page says of the launch; where it says nothing of a store, it was not launched. */
async function launched(asked: URLSearchParams, course: Course): Promise<Launched> {
  const endpoint = asked.get('endpoint');
  const actor = asked.get('actor');
  if (endpoint === null || actor === null) throw new RecordError(`This course was opened without a record store. ${NOT_FOUND}`);
  const fetchAddress = asked.get('fetch');
  const access: Access = {
    endpoint: endpoint.endsWith('/') ? endpoint : `${endpoint}/`,
    authorization: fetchAddress === null ? (asked.get('auth') ?? '') : await tokenOf(fetchAddress),
  };
  const activityId = asked.get('activityId') ?? asked.get('activity_id') ?? course.activityId;
  const registration = asked.get('registration') ?? undefined;
  const owner: Owner = { activityId, agent: actor, registration };
  const data = fetchAddress === null ? {} : await launchData(access, owner);
  const { contextTemplate = {}, launchMode = 'Normal', masteryScore } = data as { contextTemplate?: { [part: string]: unknown }; launchMode?: string; masteryScore?: unknown };
  const session: Session = {
    actor: parsed(actor),
    activityId,
    title: course.title,
    language: course.language || 'und',
    registration,
    context: contextTemplate,
    sessionId: crypto.randomUUID(),
    threshold: course.watched,
    isCmi5: fetchAddress !== null,
    masteryScore: typeof masteryScore === 'number' && masteryScore >= 0 && masteryScore <= 1 ? masteryScore : undefined,
  };
  return { access, owner, session, isReview: launchMode !== 'Normal' };
}

function parsed(json: string): unknown {
  try {
    return JSON.parse(json) as unknown;
  } catch {
    throw new RecordError(`The address of this course names no learner. ${NOT_FOUND}`);
  }
}

/** The token of a session: the system gives it once (cmi5, 8.2). */
async function tokenOf(address: string): Promise<string> {
  const answer = await fetch(address, { method: 'POST' }).then(
    (response) => (response.ok ? (response.json() as Promise<{ 'auth-token'?: unknown }>) : undefined),
    () => undefined,
  );
  const token = answer?.['auth-token'];
  if (typeof token !== 'string') throw new RecordError(`The system that has opened this course did not let it in: open it there anew. ${NOT_FOUND}`);
  return `Basic ${token}`;
}

/** A document of the state, as soon as the store can be asked: what is not known must not be written over. */
async function stateOf(store: RecordStore, owner: Owner, id: string): Promise<string> {
  for (const waitMs of WAITS_MS) {
    const text = await store.state(owner, id);
    if (text !== undefined) return text;
    await new Promise((over) => setTimeout(over, waitMs));
  }
  throw new RecordError(`The record store cannot be reached. ${NOT_FOUND}`);
}

/** What the system says of the launch (cmi5, 10). */
async function launchData(access: Access, owner: Owner): Promise<object> {
  const text = await stateOf(new RecordStore(access), owner, 'LMS.LaunchData');
  const data = text === '' ? undefined : parsed(text);
  if (typeof data !== 'object' || data === null) throw new RecordError(`The record store does not say how this course is to be opened. ${NOT_FOUND}`);
  return data;
}

/** A session with a record store. */
export class XapiRecord implements Record {
  readonly #asked: URLSearchParams;
  readonly #course: Course;
  readonly #shelf: Shelf | undefined;
  readonly #sinceMs = performance.now();
  #launched: Launched | undefined;
  #store: RecordStore | undefined;
  #outbox: Outbox | undefined;
  #last: Report = { placeSecs: 0, progress: 0, seen: [], durationSecs: 0, isComplete: false, memory: '', score: undefined, isPassed: undefined };
  #isComplete = false;
  /** What was said of passing or failing, in this session or before. */
  #verdict: Verdict | undefined;
  /** One of them was said in this session, which has room for no other. */
  #isJudged = false;
  /** What the store has of the state. */
  #kept = '';
  /** The state that was sent last. */
  #sent = '';
  #backup: Backup | undefined;

  /** `address`: that of the page; `shelf`: what keeps statements that the store has not taken. */
  constructor(address: string, course: Course, shelf: Shelf | undefined) {
    this.#asked = new URL(address).searchParams;
    this.#course = course;
    this.#shelf = shelf;
  }

  async open(): Promise<Known> {
    const opened = (this.#launched = await launched(this.#asked, this.#course));
    const store = (this.#store = new RecordStore(opened.access));
    const { registration = '', activityId } = opened.owner;
    this.#outbox = new Outbox(`raconteur-statements:${registration || activityId}`, this.#shelf, (statement) => store.put(statement));
    const state = await stateOf(store, opened.owner, STATE);
    this.#backup = new Backup(`raconteur-state:${registration || activityId}:${opened.owner.agent}`, this.#shelf);
    const { memory, isComplete, verdict } = this.#backup.join(state);
    this.#kept = state;
    // Who leaves before the story is there has seen nothing new.
    this.#last = { ...this.#last, memory };
    this.#isComplete = isComplete;
    this.#verdict = verdict;
    this.#say('initialized');
    return { memory, isComplete, pass: opened.session.masteryScore };
  }

  tell(report: Report): void {
    this.#last = report;
    if (report.isComplete && !this.#isComplete) {
      this.#isComplete = true;
      this.#say('completed');
    }
    if (report.isPassed !== undefined) this.#judge(report.isPassed ? 'passed' : 'failed');
  }

  /** Says once that somebody has passed, or failed; who has passed does not fail any more (cmi5, 9.3). */
  #judge(verdict: Verdict): void {
    if (this.#isJudged || this.#verdict === 'passed' || this.#verdict === verdict || this.#launched?.isReview !== false) return;
    this.#verdict = verdict;
    this.#isJudged = true;
    this.#say(verdict);
    this.keep();
  }

  note({ kind, fromSecs }: Happening): void {
    this.#say(kind, fromSecs);
  }

  reply(reply: Reply): void {
    if (this.#launched?.isReview === false) this.#outbox?.add(answeredOf(this.#launched.session, reply));
  }

  keep(): void {
    const { owner, isReview } = this.#launched ?? {};
    const text = writeKept({ memory: this.#last.memory, isComplete: this.#isComplete, verdict: this.#verdict });
    if (owner === undefined || isReview || text === this.#kept) return;
    this.#sent = text;
    this.#backup?.put(text, this.#kept);
    void this.#store?.putState(owner, STATE, text).then((isKept) => {
      if (!isKept) return;
      this.#kept = text;
      // What was sent later is still on its way.
      if (this.#sent === text) this.#backup?.clear();
    });
  }

  close(): void {
    if (this.#launched === undefined) return;
    this.keep();
    this.#say('terminated');
    this.#outbox?.close();
    this.#launched = undefined;
  }

  /** Who only looks at it begins and ends a session, and nothing else is said (cmi5, 10: `launchMode`). */
  #say(verb: Verb, fromSecs?: number): void {
    if (this.#launched === undefined) return;
    const { session, isReview } = this.#launched;
    if (isReview && verb !== 'initialized' && verb !== 'terminated') return;
    const { placeSecs, durationSecs, progress, seen, score } = this.#last;
    const moment: Moment = { placeSecs, fromSecs, durationSecs, progress, seen, score, spentMs: performance.now() - this.#sinceMs };
    this.#outbox?.add(statementOf(verb, session, moment));
  }
}
