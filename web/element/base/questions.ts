/** What a story asks, and its ways. All times are seconds. */

/** The place of something among all that a story comes to, and that of the answer, condition or item of a pool around it. */
export interface Ordered {
  readonly order: number;
  readonly within?: number;
}

/** A question of a story, and where in it what follows from its answers lies. */
export interface Question extends Ordered {
  /** Where the story rests until it is answered. */
  readonly atSecs: number;
  /** Where it goes on after what follows. */
  readonly endSecs: number;
  /** Results are kept by it. */
  readonly name: string;
  readonly kind: QuestionKind;
  readonly prompt: string;
  readonly picture?: QuestionPicture;
  /** True where no answer is right or wrong: whatever is answered is taken, and counts no points. */
  readonly isUngraded?: boolean;
  readonly points: number;
  /** What is right of an answer counts by itself (`several`, `order`, `match`, `gap`). */
  readonly isPartial?: boolean;
  /** Options are shown in an order by chance. */
  readonly isShuffled?: boolean;
  readonly tries: number;
  /** Read after a wrong answer, while there are tries left. */
  readonly hint?: string;
  /** Read once it is answered for good, where the author says what: after any answer, and in its place after a right or a wrong one. */
  readonly feedback?: { readonly any?: string; readonly right?: string; readonly wrong?: string };
  /** How long one may think about it, seconds; the learner may ask for more. */
  readonly limitSecs?: number;
  readonly options: readonly QuestionOption[];
  /** `to`: `right`, `wrong`, `answered`, or the name of an option. */
  readonly answers: readonly { readonly order: number; readonly to: string; readonly startSecs: number; readonly endSecs: number }[];
}

/** A picture of a question or an option: a file of the story's folder, and what it shows. */
export interface QuestionPicture {
  readonly file: string;
  readonly alt: string;
}

/** Something on the way through a story. An item is a clause of the pool at a place, before what it is itself. */
export type FlowEntry = Ordered & { readonly atSecs: number; readonly endSecs: number } & (
    | { readonly kind: 'part'; readonly name: string; readonly title: string }
    | { readonly kind: 'if'; readonly name: string; readonly is?: string; readonly not?: string; readonly above?: number; readonly below?: number }
    | { readonly kind: 'set'; readonly name: string; readonly value?: string; readonly by?: number }
    | { readonly kind: 'pool'; readonly count: number }
    | { readonly kind: 'item'; readonly pool: number }
    | { readonly kind: 'goto'; readonly to: string }
  );

/**
 * How a question is answered, and what `given` of an answer holds: the name of one option (`choice`), those of all that are right
 * (`several`), those of all in order (`order`), for each option the name of the one whose partner it was given (`match`), for each
 * gap what was written (`gap`), a number as it was written (`number`), the name of what was pointed at (`point`), or a text (`text`).
 */
export type QuestionKind = 'choice' | 'several' | 'order' | 'match' | 'gap' | 'number' | 'point' | 'text';

/** What may be answered, or a rule for what may be: those that a kind does not know are left out. */
export interface QuestionOption {
  readonly name: string;
  /** Read; of `gap`, `number` and `text` it may be empty. */
  readonly text: string;
  readonly picture?: QuestionPicture;
  readonly isRight: boolean;
  /** Of `match`: its right partner. */
  readonly partner?: string;
  /** Of `gap` and `text`: what is taken. */
  readonly accepts?: readonly string[];
  /** Of `text`: what must not be there. */
  readonly rejects?: readonly string[];
  /** Of `number`: the least and the greatest number that are taken. */
  readonly least?: number;
  readonly most?: number;
  /** Of `point`: the part of the figure. */
  readonly at?: string;
}

/** @deprecated Use `FlowEntry`. */
export type Way = FlowEntry;
