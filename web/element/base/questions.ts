/** Questions of a story, and its paths. All times are seconds. */

/** Position among all entries of a story, and that of the enclosing answer, condition or pool item. */
export interface Ordered {
  readonly order: number;
  readonly within?: number;
}

/** A question of a story, with the position of its reactions. */
export interface Question extends Ordered {
  /** Time at which the story pauses for the answer. */
  readonly atSecs: number;
  /** Time at which it continues after the reaction. */
  readonly endSecs: number;
  /** Name, the key of its results. */
  readonly name: string;
  readonly kind: QuestionKind;
  readonly prompt: string;
  readonly picture?: QuestionPicture;
  /** True if no answer is right or wrong: every answer is accepted, and earns no points. */
  readonly isUngraded?: boolean;
  readonly points: number;
  /** Enables points for partly right answers (`several`, `order`, `match`, `gap`). */
  readonly isPartial?: boolean;
  /** Enables random order of the options. */
  readonly isShuffled?: boolean;
  readonly tries: number;
  /** Read after a wrong answer, while there are tries left. */
  readonly hint?: string;
  /** Texts shown after the final answer, if the author provides them: after any answer, and instead after a right or a wrong one. */
  readonly feedback?: { readonly any?: string; readonly right?: string; readonly wrong?: string };
  /** Time limit, seconds; the learner may request more. */
  readonly limitSecs?: number;
  readonly options: readonly QuestionOption[];
  /** `to`: `right`, `wrong`, `answered`, or the name of an option. */
  readonly answers: readonly { readonly order: number; readonly to: string; readonly startSecs: number; readonly endSecs: number }[];
}

/** An image of a question or an option: a file in the story's folder, with its text alternative. */
export interface QuestionPicture {
  readonly file: string;
  readonly alt: string;
}

/** An entry on a path through a story. An item is a clause of the pool at a position, listed before the clause itself. */
export type FlowEntry = Ordered & { readonly atSecs: number; readonly endSecs: number } & (
    | { readonly kind: 'part'; readonly name: string; readonly title: string }
    | { readonly kind: 'if'; readonly name: string; readonly is?: string; readonly not?: string; readonly above?: number; readonly below?: number }
    | { readonly kind: 'set'; readonly name: string; readonly value?: string; readonly by?: number }
    | { readonly kind: 'pool'; readonly count: number }
    | { readonly kind: 'item'; readonly pool: number }
    | { readonly kind: 'goto'; readonly to: string }
  );

/**
 * Answer type of a question, and form of `given` in an answer: the name of one option (`choice`), those of all selected ones (`several`), those of all in
 * order (`order`), for each option the name of the one whose partner it was given (`match`), the text of each gap (`gap`), a number as entered (`number`), the
 * name of the selected point (`point`), or a text (`text`).
 */
export type QuestionKind = 'choice' | 'several' | 'order' | 'match' | 'gap' | 'number' | 'point' | 'text';

/** A possible answer, or a rule for accepted answers; members that a kind does not use are absent. */
export interface QuestionOption {
  readonly name: string;
  /** Read; of `gap`, `number` and `text` it may be empty. */
  readonly text: string;
  readonly picture?: QuestionPicture;
  readonly isRight: boolean;
  /** Right partner of an option of a `match` question. */
  readonly partner?: string;
  /** Accepted texts, for `gap` and `text`. */
  readonly accepts?: readonly string[];
  /** Texts that must not occur, for `text`. */
  readonly rejects?: readonly string[];
  /** Smallest and largest accepted number, for `number`. */
  readonly least?: number;
  readonly most?: number;
  /** Part of the figure for an option of a `point` question. */
  readonly at?: string;
}

/** @deprecated Use `FlowEntry`. */
export type Way = FlowEntry;
