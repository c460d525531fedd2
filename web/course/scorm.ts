/**
 * SCORM 1.2 and SCORM 2004 interface of a course: the API object that the learning management system provides to the page, and the names of its data (SCORM
 * 1.2 Run-Time Environment, 3.4; SCORM 2004 4th Edition Run-Time Environment, 4.2).
 */

import { interaction12, interaction2004, type Elements } from './interactions.js';
import { until } from './retry-timer.js';
import { bestOf, joined, NOTHING, readMemory, writeMemory, type Memory } from './memory.js';
import { RecordError, type KnownLearner, type Record, type Reply, type Report } from './report.js';
import { LocalCopy, Slot, type Shelf } from './shelf.js';
import { decimal } from './texts.js';
import { StorageProblems } from './storage-problems.js';

/** API object of the system: its methods take and return texts. */
type Api = { readonly [method: string]: (...given: string[]) => string };

/** Vocabulary of a SCORM version. */
interface Version {
  readonly title: string;
  /** The object's name. */
  readonly object: string;
  /** Prefix of its methods. */
  readonly prefix: string;
  readonly begin: string;
  readonly end: string;
  readonly names: {
    readonly mode: string;
    readonly memory: string;
    /** Elements of the learner's identity and of the resumed session. */
    readonly learner: string;
    readonly entry: string;
    readonly place: string;
    readonly status: string;
    readonly exit: string;
    readonly spent: string;
    /** Element for the progress; only the newer version has progress, and a success separate from completion. */
    readonly progress?: string;
    readonly success?: string;
    readonly scaled?: string;
    /** Prefix of the score elements: `raw`, `min` and `max` follow it. */
    readonly score: string;
  };
  spent(ms: number): string;
  interaction(n: number, reply: Reply): Elements;
}

const two = (n: number): string => String(n).padStart(2, '0');

/** Hundredths of a second, as both versions have them at the finest. */
const hundredths = (ms: number): string => ((Math.floor(ms / 10) % 6000) / 100).toFixed(2).padStart(5, '0');

export const SCORM_12: Version = {
  title: 'SCORM 1.2',
  object: 'API',
  prefix: 'LMS',
  begin: 'Initialize',
  end: 'Finish',
  names: {
    mode: 'cmi.core.lesson_mode',
    memory: 'cmi.suspend_data',
    learner: 'cmi.core.student_id',
    entry: 'cmi.core.entry',
    place: 'cmi.core.lesson_location',
    status: 'cmi.core.lesson_status',
    exit: 'cmi.core.exit',
    spent: 'cmi.core.session_time',
    score: 'cmi.core.score',
  },
  spent: (ms) => `${String(Math.min(9999, Math.floor(ms / 3_600_000))).padStart(4, '0')}:${two(Math.floor(ms / 60_000) % 60)}:${hundredths(ms)}`,
  interaction: interaction12,
};

export const SCORM_2004: Version = {
  title: 'SCORM 2004',
  object: 'API_1484_11',
  prefix: '',
  begin: 'Initialize',
  end: 'Terminate',
  names: {
    mode: 'cmi.mode',
    memory: 'cmi.suspend_data',
    learner: 'cmi.learner_id',
    entry: 'cmi.entry',
    place: 'cmi.location',
    status: 'cmi.completion_status',
    exit: 'cmi.exit',
    spent: 'cmi.session_time',
    progress: 'cmi.progress_measure',
    success: 'cmi.success_status',
    scaled: 'cmi.score.scaled',
    score: 'cmi.score',
  },
  spent: (ms) => `PT${Math.floor(ms / 3_600_000)}H${Math.floor(ms / 60_000) % 60}M${Number(hundredths(ms))}S`,
  interaction: interaction2004,
};

const MAX_SCORE = 100;
/**
 * Maximum length of the memory, characters: the limit that 1.2 guarantees (3.4.5). 2004 guarantees 64,000 (4.2.25), but systems of earlier editions, which
 * accept its packages as well, have 4,000.
 */
export const MAX_MEMORY = 4000;
/** Statuses in ascending order; a status is never lowered. */
const STATUSES = ['', 'not attempted', 'unknown', 'browsed', 'incomplete', 'completed', 'failed', 'passed'];
/** SCORM 1.2 error code of an optional element that is not implemented. */
const NOT_IMPLEMENTED = '401';
/** Elements that systems may reject without loss: right answers and question texts are in the course. */
const BESIDE = /correct_responses|description|weighting|latency|time(stamp)?$/;

/** Maximum number of windows searched: systems nest the course in frames. */
const MAX_PARENTS = 20;

/** Finds the API object in a window, in those around it, or in the one that opened it. */
function find(object: string, from: Window): Api | undefined {
  let at = from;
  for (let i = 0; i < MAX_PARENTS; i++) {
    try {
      const found = (at as unknown as { [name: string]: unknown })[object];
      if (typeof found === 'object' && found !== null) return found as Api;
    } catch {
      // A window of another origin.
    }
    if (at.parent === at) break;
    at = at.parent;
  }
  return at.opener ? find(object, at.opener as Window) : undefined;
}

/** A session with a system that has SCORM. */
export class Scorm implements Record {
  readonly troubles = new StorageProblems();
  readonly #version: Version;
  readonly #course: string;
  readonly #shelf: Shelf | undefined;
  readonly #from: Window;
  readonly #sinceMs = performance.now();
  #api: Api | undefined;
  /** Value of each element in the system. */
  readonly #set = new Map<string, string>();
  /** True if a learner's earlier work is reviewed: nothing is reported. */
  #isReview = false;
  /** The statuses that the system has had: of completion, and of success where that is apart. */
  readonly #had = new Map<string, string>();
  #isKept = true;
  /** Number of answers in the system. */
  #replies = 0;
  /** False if the system does not support answers: in 1.2 they are optional. */
  #takesReplies = true;
  /** Answers not yet accepted, answers accepted but not confirmed, by their numbers, and their parts not yet accepted. */
  #waiting: Reply[] = [];
  #taken: TakenReply[] = [];
  #late: Elements = [];
  #waitingSlot: Slot | undefined;
  /** Slot that marks unconfirmed reports. */
  #openSlot: Slot | undefined;
  /** Slot that marks a complete attempt. */
  #doneSlot: Slot | undefined;
  #copy: LocalCopy | undefined;
  #last: Memory = NOTHING;
  #isClosed = false;
  #isComplete = false;

  /**
   * Creates the record; `course`: its address; `from`: the window from which the system is searched, including its parents; `shelf`: storage of a copy against
   * data loss in the system.
   */
  constructor(version: Version, course: string, shelf: Shelf | undefined, from: Window = window) {
    this.#version = version;
    this.#course = course;
    this.#shelf = shelf;
    this.#from = from;
  }

  async open(): Promise<KnownLearner> {
    const { title, object, begin, names } = this.#version;
    const api = find(object, this.#from);
    if (api === undefined) return Promise.reject(new RecordError('no-system', `No system with ${title} was found around the page.`));
    // Before the session begins, the owner of a local copy is unknown.
    this.troubles.isKept = false;
    const begun = await until(
      () => Promise.resolve(this.#began(api, begin)),
      () => this.#isClosed,
    );
    if (begun === undefined) return new Promise(() => undefined);
    this.#api = api;
    const mode = this.#get(names.mode);
    this.#isReview = mode === 'review' || mode === 'browse';
    // A session that is never closed counts as suspended.
    this.#put(names.exit, 'suspend');
    for (const name of [names.status, names.success]) if (name !== undefined) this.#had.set(name, this.#get(name));
    const count = this.#get('cmi.interactions._count');
    this.#takesReplies = count !== '' || this.#call('GetLastError') !== NOT_IMPLEMENTED;
    this.#replies = Number(count) || 0;
    const memory = this.#isReview ? readMemory(this.#get(names.memory)) : this.#memory();
    const isComplete = STATUSES.indexOf(this.#had.get(names.status) ?? '') >= STATUSES.indexOf('completed');
    this.#last = memory;
    return { memory, isComplete, isReview: this.#isReview };
  }

  /** Begins the session; returns undefined if the system cannot at present. */
  #began(api: Api, begin: string): true | undefined {
    this.#api = api;
    const isBegun = this.#call(begin, '') === 'true';
    this.#api = undefined;
    this.troubles.set('opening', isBegun ? undefined : 'away');
    return isBegun || undefined;
  }

  /** Returns the memory of the system, merged with that of this browser. */
  #memory(): Memory {
    const { names } = this.#version;
    const learner = this.#get(names.learner);
    // A learner without an identifier may be anybody.
    const shelf = learner === '' ? undefined : this.#shelf;
    this.troubles.isKept = shelf !== undefined;
    const slot = (what: string) => `raconteur-scorm-${what}:${this.#course}:${learner}`;
    this.#copy = new LocalCopy(shelf, slot('state'));
    this.#openSlot = new Slot(shelf, slot('open'));
    this.#doneSlot = new Slot(shelf, slot('done'));
    this.#waitingSlot = new Slot(shelf, slot('answers'));
    const text = this.#get(names.memory);
    const theirs = readMemory(text);
    // A system that begins a new attempt after a completed one does so deliberately. A system that
    // lost an attempt reports the same and is not trusted.
    const isNew = text === '' && this.#get(names.entry) === 'ab-initio' && this.#doneSlot.get() !== undefined && this.#openSlot.get() === undefined;
    if (isNew) {
      this.#copy.clear();
      this.#waitingSlot.clear();
      this.#doneSlot.clear();
      return theirs;
    }
    this.#recall(this.#copy.get().session >= theirs.session);
    const [points, most] = ['raw', 'max'].map((part) => Number(this.#get(`${names.score}.${part}`) || NaN));
    const known = joined(this.#copy.get(), theirs);
    // The points stored in the system are not reduced to those known here.
    const had = points !== undefined && most !== undefined && points >= 0 && most > 0 && points <= most ? { points, most } : undefined;
    return { ...known, best: bestOf(known.best, had) };
  }

  /** Queues answers that the system may lack: answers with the number of an existing one are reported again, unless that one belongs to another page. */
  #recall(isOurs: boolean): void {
    for (const { n, reply } of takenIn(this.#waitingSlot?.get())) {
      if (n === undefined || n >= this.#replies || !isOurs) this.#waiting.push(reply);
      else {
        this.#taken.push({ n, reply });
        this.#late = [...this.#late, ...this.#version.interaction(n, reply)];
      }
    }
  }

  save({ placeSecs, progress, isComplete, memory, score, isPassed }: Report): void {
    if (this.#api === undefined) return;
    const { names } = this.#version;
    this.#last = memory;
    this.#isComplete ||= isComplete;
    if (!this.#isReview) this.#copy?.follow(memory);
    this.#put(names.exit, 'suspend');
    this.#put(names.place, String(Math.round(placeSecs * 1000) / 1000));
    if (names.progress !== undefined) this.#put(names.progress, String(Math.round(Math.min(1, Math.max(0, progress)) * 10_000) / 10_000));
    this.#put(names.memory, writeMemory(memory, MAX_MEMORY));
    if (score !== undefined) this.#tellScore(score);
    const outcome = isPassed === undefined ? undefined : isPassed ? 'passed' : 'failed';
    if (outcome !== undefined && names.success !== undefined) this.#raise(names.success, outcome);
    // The older one has one status for both.
    const done = names.success === undefined && outcome !== undefined ? outcome : 'completed';
    this.#raise(names.status, isComplete ? done : 'incomplete');
  }

  #tellScore({ points, most }: { readonly points: number; readonly most: number }): void {
    const { score, scaled } = this.#version.names;
    // Scores of the older one end at 100.
    const end = scaled === undefined ? Math.min(MAX_SCORE, most) : most;
    this.#put(`${score}.min`, '0');
    this.#put(`${score}.max`, decimal(end) ?? '0');
    this.#put(`${score}.raw`, decimal(end < most ? (points / most) * end : points) ?? '0');
    if (scaled !== undefined && most > 0) this.#put(scaled, String(Math.round((points / most) * 10_000) / 10_000));
  }

  /** Sets a status that is further than the one that the system has. */
  #raise(name: string, status: string): void {
    if (STATUSES.indexOf(status) < STATUSES.indexOf(this.#had.get(name) ?? '')) return;
    if (this.#put(name, status)) this.#had.set(name, status);
  }

  reply(reply: Reply): void {
    if (this.#isReview || !this.#takesReplies) return;
    this.#waiting.push(reply);
    this.#tellReplies();
  }

  /** Reports pending answers, in order. */
  #tellReplies(): void {
    this.#late = this.#late.filter(([element, value]) => !this.#put(element, value));
    while (this.#api !== undefined) {
      const [reply] = this.#waiting;
      if (reply === undefined) break;
      const [first, ...more] = this.#version.interaction(this.#replies, reply);
      if (first === undefined || !this.#put(...first)) break;
      this.#late = [...this.#late, ...more.filter(([element, value]) => !this.#put(element, value) && !BESIDE.test(element))];
      this.#taken.push({ n: this.#replies, reply });
      this.#replies += 1;
      this.#waiting.shift();
    }
    this.#keepReplies();
  }

  #keepReplies(): void {
    const all: readonly TakenReply[] = [...this.#taken, ...this.#waiting.map((reply) => ({ n: undefined, reply }))];
    if (all.length === 0) this.#waitingSlot?.clear();
    else this.#waitingSlot?.set(JSON.stringify(all));
  }

  keep(): void {
    if (this.#api === undefined || this.#isReview) return;
    this.#tellReplies();
    if (this.#copy?.put(this.#last) === false) this.troubles.set('the browser', 'unkept');
    if (this.#isKept) return;
    // A session that is never closed, for example on a power failure, records its time as well.
    this.#put(this.#version.names.spent, this.#version.spent(performance.now() - this.#sinceMs));
    this.#isKept = this.#call('Commit', '') === 'true';
    this.troubles.set('commit', this.#isKept ? undefined : 'away');
    if (!this.#isKept) return;
    if (this.#late.length === 0) this.#taken = [];
    this.#keepReplies();
    this.#openSlot?.clear();
    if (this.#isComplete) this.#doneSlot?.set('1');
  }

  others(key: string | null, text: string | null): Memory | undefined {
    return this.#copy?.others(key, text);
  }

  close(): void {
    this.#isClosed = true;
    if (this.#api === undefined) return;
    this.#isKept = false;
    this.keep();
    this.#call(this.#version.end, '');
    this.#api = undefined;
  }

  #get(element: string): string {
    return this.#call('GetValue', element);
  }

  /** Sets a changed element, and returns true if the system accepted it; rejected ones are retried with the next report. */
  #put(element: string, value: string): boolean {
    if (this.#isReview || this.#api === undefined || this.#set.get(element) === value) return true;
    const isTaken = this.#call('SetValue', element, value) === 'true';
    if (!BESIDE.test(element)) this.troubles.set(element, isTaken ? undefined : 'refused');
    // Rejected data is committed again.
    this.#isKept = false;
    this.#openSlot?.set('1');
    if (isTaken) this.#set.set(element, value);
    return isTaken;
  }

  #call(method: string, ...given: string[]): string {
    try {
      return String(this.#api?.[`${this.#version.prefix}${method}`]?.(...given) ?? '');
    } catch {
      // The system is foreign code: its faults must not stop the story.
      return '';
    }
  }
}

/** An answer, with its number once the system has accepted it. */
interface TakenReply {
  readonly n: number | undefined;
  readonly reply: Reply;
}

function takenIn(text: string | undefined): TakenReply[] {
  const isTaken = (told: unknown): told is TakenReply => {
    const { reply } = (told ?? {}) as { reply?: Partial<Reply> };
    return typeof reply?.question?.name === 'string' && typeof reply.answered?.name === 'string';
  };
  try {
    const list = JSON.parse(text ?? '[]') as unknown;
    return Array.isArray(list) ? list.filter(isTaken) : [];
  } catch {
    return [];
  }
}
