/**
 * A course with a record store: launched by a link with the store's address, as Tin Can packages are, or by a cmi5 system
 * (https://aicc.github.io/CMI-5_Spec_Current, 8 to 10), whose session has rules of its own.
 */

import { Outbox, type Shelf } from './outbox.js';
import { RecordError, type Happening, type Known, type Record, type Report } from './report.js';
import { statementOf, type Moment, type Session, type Verb } from './statements.js';
import { RecordStore, type Access, type Owner } from './store.js';

/** Under which a course keeps its memory in the store. */
const STATE = 'raconteur';
const CMI5 = 'https://w3id.org/xapi/cmi5/context/categories/';
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
  readonly isCmi5: boolean;
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
  const { contextTemplate = {}, launchMode = 'Normal' } = data as { contextTemplate?: { [part: string]: unknown }; launchMode?: string };
  const session: Session = {
    actor: parsed(actor),
    activityId,
    title: course.title,
    language: course.language,
    registration,
    context: contextTemplate,
    sessionId: crypto.randomUUID(),
    threshold: course.watched,
  };
  return { access, owner, session, isCmi5: fetchAddress !== null, isReview: launchMode !== 'Normal' };
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
  /** The memory that the store has. */
  #kept = '';

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
    const { memory = '', isComplete = false } = remembered(state);
    this.#kept = state;
    // Who leaves before the story is there has seen nothing new.
    this.#last = { ...this.#last, memory };
    this.#isComplete = isComplete;
    this.#say('initialized');
    return { memory, isComplete };
  }

  tell(report: Report): void {
    this.#last = report;
    if (!report.isComplete || this.#isComplete) return;
    this.#isComplete = true;
    this.#say('completed');
  }

  note({ kind, fromSecs }: Happening): void {
    this.#say(kind, fromSecs);
  }

  keep(): void {
    const { owner, isReview } = this.#launched ?? {};
    const text = JSON.stringify({ memory: this.#last.memory, isComplete: this.#isComplete });
    if (owner === undefined || isReview || text === this.#kept) return;
    void this.#store?.putState(owner, STATE, text).then((isKept) => {
      if (isKept) this.#kept = text;
    });
  }

  close(): void {
    if (this.#launched === undefined) return;
    this.keep();
    this.#say('terminated');
    this.#outbox?.close();
    this.#launched = undefined;
  }

  #say(verb: Verb, fromSecs?: number): void {
    if (this.#launched === undefined) return;
    const { session, isCmi5, isReview } = this.#launched;
    if (isReview && verb === 'completed') return;
    const { placeSecs, durationSecs, progress, seen } = this.#last;
    const moment: Moment = { placeSecs, fromSecs, durationSecs, progress, seen, spentMs: performance.now() - this.#sinceMs };
    this.#outbox?.add(statementOf(verb, session, moment, isCmi5 ? categoriesOf(verb) : []));
  }
}

/** The categories of cmi5's own statements (9.6.2); others are statements that it allows. */
function categoriesOf(verb: Verb): string[] {
  if (verb === 'completed') return [`${CMI5}cmi5`, `${CMI5}moveon`];
  return verb === 'initialized' || verb === 'terminated' ? [`${CMI5}cmi5`] : [];
}

function remembered(text: string): { memory?: string; isComplete?: boolean } {
  try {
    const { memory, isComplete } = JSON.parse(text) as { memory?: unknown; isComplete?: unknown };
    return { ...(typeof memory === 'string' ? { memory } : {}), isComplete: isComplete === true };
  } catch {
    return {};
  }
}
