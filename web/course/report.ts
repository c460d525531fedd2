/** Report of a course about a learner, independent of the record. */

import type { Answered, Score } from '../element/base/answers.js';
import type { Span } from '../element/base/ranges.js';
import type { Question } from '../element/base/questions.js';
import type { Memory } from './memory.js';
import type { StorageProblems } from './storage-problems.js';

/** Position and progress of a learner. */
export interface Report {
  /** Story time, seconds. */
  readonly placeSecs: number;
  readonly durationSecs: number;
  /** Share of the story seen, 0 to 1. */
  readonly progress: number;
  /** Seen spans, sorted and disjoint. */
  readonly seen: readonly Span[];
  /** The author's rule of completion is met. It stays so. */
  readonly isComplete: boolean;
  /** Points in the story's questions, of the best attempt; undefined without questions. */
  readonly score: Score | undefined;
  /** True if no question is left to answer, in this attempt. */
  readonly isSettled: boolean;
  /** True if the points satisfy the rule of the system, else the author's; undefined while undecided, or without such a rule. */
  readonly isPassed: boolean | undefined;
  /** Data that restore the learner's state; only the course itself reads them. */
  readonly memory: Memory;
}

/** A recent action of the learner. */
export interface LearningEvent {
  readonly kind: 'played' | 'paused' | 'seeked';
  /** Position of the story before a seek, seconds. */
  readonly fromSecs?: number;
}

/** An answer to a question. */
export interface Reply {
  readonly question: Question;
  readonly answered: Answered;
  /** Time of the answer, and the delay since the question. */
  readonly atMs: number;
  readonly latencyMs: number;
}

/** Data of the learner in the system at the start of the course. */
export interface KnownLearner {
  /** Memory of the last report. */
  readonly memory: Memory;
  readonly isComplete: boolean;
  /** Share of the points that the system requires, 0 to 1, overriding the author's. */
  readonly pass?: number | undefined;
  /** The learner wants no sound. */
  readonly isMuted?: boolean;
  /** True if the course is only reviewed: nothing is reported. */
  readonly isReview?: boolean;
  /** Destination for a learner who leaves the course. */
  readonly returnAddress?: string | undefined;
}

/**
 * Destination of reports: a learning management system, a record store, or the browser itself. All methods except `open` may be called before the session is
 * open.
 */
export interface Record {
  /** Problems that prevent saving. */
  readonly troubles: StorageProblems;
  /** Begins a session as soon as the system answers. Rejects with a `RecordError` if there is no system. */
  open(): Promise<KnownLearner>;
  /** Takes the latest state; cheap, and called on every change. */
  save(report: Report): void;
  /** Takes a recent action of the learner, after `tell`; for records of actions. */
  note?(what: LearningEvent): void;
  /** Takes an answer, before the `tell` that counts it. */
  reply?(reply: Reply): void;
  /** Requests permanent storage of the reported state, as far as possible. */
  keep(): void;
  /** Returns the memory saved by another page of the course in this browser, from the browser's `storage` event. */
  others?(key: string | null, text: string | null): Memory | undefined;
  /** Settles when no request to the system is pending, before or after `close`. */
  settle?(): Promise<void>;
  /** Ends the session with the reported state; the learner returns to it. Safe to call in `pagehide`. */
  close(): void;
}

/** Reason for a missing record. */
export type MissingRecord = 'no-store' | 'no-learner' | 'no-launch' | 'not-let-in' | 'no-system';

/** Error for a missing record. */
export class RecordError extends Error {
  override readonly name = 'RecordError';
  readonly why: MissingRecord;

  constructor(why: MissingRecord, message: string) {
    super(message);
    this.why = why;
  }
}
