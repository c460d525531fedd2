/** What a learner has answered, as pages and minds are told. */

/** What somebody has answered to a question. */
export interface Answered {
  /** The question's name. */
  readonly name: string;
  /** What was answered last; `QuestionKind` tells what it holds. Empty where the time was over. */
  readonly given: readonly string[];
  /** Left out where the question is not graded: nothing is right or wrong there. */
  readonly isRight?: boolean;
  /** The names of the options that it fits. */
  readonly fits: readonly string[];
  readonly points: number;
  /** How often it was answered. */
  readonly tries: number;
  /** It is answered for good: right, not graded, or there are no tries left. */
  readonly isFinal: boolean;
}

/** Points so far, and the most that there are. */
export interface Score {
  readonly points: number;
  readonly most: number;
}
