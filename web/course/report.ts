/** What a course tells of a learner, whoever keeps it. */

import type { Answered, Score } from '../element/base/answers.js';
import type { Span } from '../element/base/ranges.js';
import type { Question } from '../element/base/questions.js';
import type { Memory } from './memory.js';
import type { StorageProblems } from './storage-problems.js';

/** Where a learner is and how far they have come. */
export interface Report {
  /** Story time, seconds. */
  readonly placeSecs: number;
  readonly durationSecs: number;
  /** How much of the story was seen, 0 to 1. */
  readonly progress: number;
  /** What of it, in order and apart. */
  readonly seen: readonly Span[];
  /** The author's rule of completion is met. It stays so. */
  readonly isComplete: boolean;
  /** Points of the story's questions, of the best attempt; undefined where it asks nothing. */
  readonly score: Score | undefined;
  /** Nothing is left to answer, in this attempt. */
  readonly isSettled: boolean;
  /** Enough points for the rule of the system, else the author's; undefined while that is open, or where there is no such rule. */
  readonly isPassed: boolean | undefined;
  /** What brings the learner back to where they were; only the course itself reads it. */
  readonly memory: Memory;
}

/** What a learner has just done. */
export interface LearningEvent {
  readonly kind: 'played' | 'paused' | 'seeked';
  /** Where the story was before a seek, seconds. */
  readonly fromSecs?: number;
}

/** An answer to a question. */
export interface Reply {
  readonly question: Question;
  readonly answered: Answered;
  /** When it was given, and how long after it was asked. */
  readonly atMs: number;
  readonly latencyMs: number;
}

/** What a system knew of the learner when the course began. */
export interface KnownLearner {
  /** That of the last report. */
  readonly memory: Memory;
  readonly isComplete: boolean;
  /** The share of the points that the system wants, 0 to 1, whatever the author wants. */
  readonly pass?: number | undefined;
  /** The learner wants no sound. */
  readonly isMuted?: boolean;
  /** Somebody only looks at what a learner did: nothing is told. */
  readonly isReview?: boolean;
  /** Where the learner goes who leaves the course. */
  readonly returnAddress?: string | undefined;
}

/** Where reports go: a learning management system, a record store, or the browser itself. All but `open` may be called before the session is open. */
export interface Record {
  /** What keeps it from being kept. */
  readonly troubles: StorageProblems;
  /** Begins a session: as soon as the system answers. Rejects with a `RecordError` where there is none to be had. */
  open(): Promise<KnownLearner>;
  /** Takes the last state; cheap, and as often as there is something new. */
  tell(report: Report): void;
  /** Takes what the learner has just done, after `tell`; for those who keep that. */
  note?(what: LearningEvent): void;
  /** Takes an answer, before the `tell` that counts it. */
  reply?(reply: Reply): void;
  /** Has what was told kept for good, as far as that can be said now. */
  keep(): void;
  /** What another page of the course in this browser keeps, by the browser's event of it (`storage`). */
  others?(key: string | null, text: string | null): Memory | undefined;
  /** Settles when nothing is on its way to the system, before `close` or after it. */
  settle?(): Promise<void>;
  /** Ends the session with what was told; the learner comes back to it. Safe to call in `pagehide`. */
  close(): void;
}

/** Why nobody keeps what a learner does. */
export type MissingRecord = 'no-store' | 'no-learner' | 'no-launch' | 'not-let-in' | 'no-system';

/** There is nobody who keeps what the learner does. */
export class RecordError extends Error {
  override readonly name = 'RecordError';
  readonly why: MissingRecord;

  constructor(why: MissingRecord, message: string) {
    super(message);
    this.why = why;
  }
}
