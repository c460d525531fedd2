/** Events of a story's performance, and results of live fragments. All times are seconds. */

import type { Question } from './questions.js';
import type { Utterance } from './types.js';

/** An event at a time of the story. */
export type Cue = {
  readonly timeSecs: number;
  /** The live fragment that it belongs to; absent for the story's own. */
  readonly fragment?: number;
} & (
  | { readonly kind: 'word'; readonly utterance: number; readonly word: number; readonly text: string; readonly endSecs: number }
  /** A phone begins; `symbol` belongs to the phone set named by `phoneSet`. Only baked speech has phones. */
  | { readonly kind: 'phone'; readonly utterance: number; readonly symbol: string; readonly phoneSet: string; readonly endSecs: number }
  | { readonly kind: 'utterance'; readonly phase: 'start' | 'end'; readonly utterance: number; readonly text: string; readonly startSecs: number; readonly endSecs: number }
  /** A marker named in the story by `timeId` or `tm`. */
  | { readonly kind: 'mark'; readonly name: string }
  | ({ readonly kind: 'clause'; readonly phase: 'start' | 'end' } & ClauseRef)
  | { readonly kind: 'storyevent'; readonly type?: string; readonly payload: string }
  | Failure
);

/** Reference to a clause of a story or fragment. */
interface ClauseRef {
  /** Index of the clause, from 0. */
  readonly clause: number;
  /** The EML element, for example `gesture-key`. */
  readonly element: string;
  /** `timeId` of the clause. */
  readonly id?: string;
}

/** Part of a fragment that is not performed, or not as intended. */
interface Failure {
  readonly kind: 'failed' | 'warning';
  readonly timeSecs: number;
  readonly fragment?: number;
  readonly code: string;
  readonly message: string;
  readonly hints?: readonly string[];
  /** Location in the fragment, from 1, in characters. */
  readonly line?: number;
  readonly column?: number;
}

/** The immediate answer to the sender of a fragment. */
export type Answer =
  | Failure
  | {
      readonly kind: 'accepted';
      readonly timeSecs: number;
      readonly fragment: number;
      /** The `name` of the fragment's `eml` element. */
      readonly name?: string;
      readonly clauses: readonly (ClauseRef & { readonly startSecs: number; readonly endSecs: number })[];
    };

/** Result of a fragment. */
export interface Performance {
  readonly events: readonly Answer[];
  readonly utterances: readonly Utterance[];
  /** The index of the first of them. */
  readonly firstUtterance: number;
  /** Its questions. */
  readonly questions: readonly Question[];
  /** End of everything known. */
  readonly endSecs: number;
  /** Result of `<interrupt/>`, if the text was that instead of a fragment. */
  readonly cut?: InterruptionOutcome;
}

/** Result of an interruption of fragments. */
export interface InterruptionOutcome {
  /** Time of the interruption. */
  readonly atSecs: number;
  /** End of everything now known. */
  readonly endSecs: number;
}
