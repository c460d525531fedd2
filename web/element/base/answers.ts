/** A learner's answers, as passed to pages and minds. */

/** Answer to a question. */
export interface Answered {
  /** The question's name. */
  readonly name: string;
  /** Last given answer; its form depends on `QuestionKind`. Empty if the time expired. */
  readonly given: readonly string[];
  /** True if it is right; absent if the question is ungraded. */
  readonly isRight?: boolean;
  /** The names of the options that it fits. */
  readonly fits: readonly string[];
  readonly points: number;
  /** Number of tries. */
  readonly tries: number;
  /** True if the question is finally answered: right, not graded, or no tries left. */
  readonly isFinal: boolean;
}

/** Points up to now, and the maximum. */
export interface Score {
  readonly points: number;
  readonly most: number;
}
