/**
 * SCORM 1.2 and SCORM 2004 as a course speaks them: the object that the learning management system puts beside the page, and the
 * names of its data (SCORM 1.2 Run-Time Environment, 3.4; SCORM 2004 4th Edition Run-Time Environment, 4.2).
 */

import { interaction12, interaction2004, type Elements } from './interactions.js';
import { RecordError, type Known, type Record, type Reply, type Report } from './report.js';
import { decimal } from './texts.js';

/** The object of the system: texts in, texts out. */
type Api = { readonly [method: string]: (...given: string[]) => string };

/** The texts that a version has for what a course says. */
interface Version {
  readonly title: string;
  /** The object's name. */
  readonly object: string;
  /** What its methods begin with. */
  readonly prefix: string;
  readonly begin: string;
  readonly end: string;
  readonly names: {
    readonly mode: string;
    readonly memory: string;
    readonly place: string;
    readonly status: string;
    readonly exit: string;
    readonly spent: string;
    /** Only the newer one has a share, and a success apart from completion. */
    readonly progress?: string;
    readonly success?: string;
    readonly scaled?: string;
    /** Of the score: with `raw`, `min` and `max` after it. */
    readonly score: string;
  };
  /** Texts of a status that is not to be taken back. */
  readonly complete: readonly string[];
  spent(ms: number): string;
  interaction(n: number, reply: Reply): Elements;
  /** The most characters of `memory`. */
  readonly mostMemory: number;
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
    place: 'cmi.core.lesson_location',
    status: 'cmi.core.lesson_status',
    exit: 'cmi.core.exit',
    spent: 'cmi.core.session_time',
    score: 'cmi.core.score',
  },
  complete: ['completed', 'passed', 'failed'],
  spent: (ms) => `${String(Math.min(9999, Math.floor(ms / 3_600_000))).padStart(4, '0')}:${two(Math.floor(ms / 60_000) % 60)}:${hundredths(ms)}`,
  interaction: interaction12,
  mostMemory: 4096,
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
    place: 'cmi.location',
    status: 'cmi.completion_status',
    exit: 'cmi.exit',
    spent: 'cmi.session_time',
    progress: 'cmi.progress_measure',
    success: 'cmi.success_status',
    scaled: 'cmi.score.scaled',
    score: 'cmi.score',
  },
  complete: ['completed'],
  spent: (ms) => `PT${Math.floor(ms / 3_600_000)}H${Math.floor(ms / 60_000) % 60}M${Number(hundredths(ms))}S`,
  interaction: interaction2004,
  mostMemory: 64_000,
};

const MOST_SCORE = 100;

/** So many windows are looked at: systems put the course into frames of frames. */
const MOST_PARENTS = 20;

/** The object of a window, of those around it, and of the one that has opened it. */
function find(object: string, from: Window): Api | undefined {
  let at = from;
  for (let i = 0; i < MOST_PARENTS; i++) {
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
  readonly mostMemory: number;
  readonly #version: Version;
  readonly #from: Window;
  readonly #sinceMs = performance.now();
  #api: Api | undefined;
  /** What the system has of each element. */
  readonly #set = new Map<string, string>();
  /** Somebody looks at what a learner did before: nothing is told. */
  #isReview = false;
  /** The status when the session began. */
  #was = '';
  #wasComplete = false;
  #isKept = true;
  /** How many answers the system has. */
  #replies = 0;

  /** `from`: the window in and around which the system is looked for. */
  constructor(version: Version, from: Window = window) {
    this.#version = version;
    this.mostMemory = version.mostMemory;
    this.#from = from;
  }

  open(): Promise<Known> {
    const { title, object, begin, names, complete } = this.#version;
    this.#api = find(object, this.#from);
    if (this.#api === undefined) return Promise.reject(new RecordError(`No learning management system with ${title} was found around this page; nothing is recorded.`));
    if (this.#call(begin, '') !== 'true') return Promise.reject(new RecordError(`The learning management system did not begin a session (${this.#fault()}); nothing is recorded.`));
    const mode = this.#get(names.mode);
    this.#isReview = mode === 'review' || mode === 'browse';
    this.#was = this.#get(names.status);
    this.#wasComplete = complete.includes(this.#was);
    this.#replies = Number(this.#get('cmi.interactions._count')) || 0;
    return Promise.resolve({ memory: this.#get(names.memory), isComplete: this.#wasComplete });
  }

  tell({ placeSecs, progress, isComplete, memory, score, isPassed }: Report): void {
    const { names } = this.#version;
    this.#put(names.place, String(Math.round(placeSecs * 1000) / 1000));
    if (names.progress !== undefined) this.#put(names.progress, String(Math.round(progress * 10_000) / 10_000));
    if (memory.length <= this.mostMemory) this.#put(names.memory, memory);
    if (score !== undefined) {
      // Scores of the older one end at 100.
      const most = names.scaled === undefined ? Math.min(MOST_SCORE, score.most) : score.most;
      this.#put(`${names.score}.min`, '0');
      this.#put(`${names.score}.max`, decimal(most) ?? '0');
      this.#put(`${names.score}.raw`, decimal(most < score.most ? (score.points / score.most) * most : score.points) ?? '0');
      if (names.scaled !== undefined && score.most > 0) this.#put(names.scaled, String(Math.round((score.points / score.most) * 10_000) / 10_000));
    }
    const outcome = isPassed === undefined ? undefined : isPassed ? 'passed' : 'failed';
    if (outcome !== undefined && names.success !== undefined) this.#put(names.success, outcome);
    // The older one has one status for both.
    const done = names.success === undefined && outcome !== undefined ? outcome : 'completed';
    // Who had seen enough before may pass or fail later.
    if (!this.#wasComplete || (this.#was === 'completed' && done !== 'completed')) this.#put(names.status, isComplete ? done : 'incomplete');
  }

  reply(reply: Reply): void {
    for (const [element, value] of this.#version.interaction(this.#replies, reply)) this.#put(element, value);
    this.#replies += 1;
  }

  keep(): void {
    const { names, spent } = this.#version;
    if (this.#isKept || this.#api === undefined) return;
    // A session that is never closed, as where a machine goes down, has its time as well.
    this.#put(names.spent, spent(performance.now() - this.#sinceMs));
    this.#isKept = this.#call('Commit', '') === 'true';
  }

  close(): void {
    const { names, end } = this.#version;
    if (this.#api === undefined) return;
    this.#put(names.exit, 'suspend');
    this.#isKept = false;
    this.keep();
    this.#call(end, '');
    this.#api = undefined;
  }

  #get(element: string): string {
    return this.#call('GetValue', element);
  }

  /** Sets what is new; what was refused is tried again with the next report. */
  #put(element: string, value: string): void {
    if (this.#isReview || this.#api === undefined || this.#set.get(element) === value) return;
    if (this.#call('SetValue', element, value) !== 'true') return;
    this.#set.set(element, value);
    this.#isKept = false;
  }

  #call(method: string, ...given: string[]): string {
    try {
      return String(this.#api?.[`${this.#version.prefix}${method}`]?.(...given) ?? '');
    } catch {
      // The system is another's code: what it does wrong must not end the story.
      return '';
    }
  }

  #fault(): string {
    return `error ${this.#call('GetLastError')}`;
  }
}
