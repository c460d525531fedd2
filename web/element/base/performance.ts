/** What happens as a story is performed, and what becomes of live fragments. All times are seconds. */

import type { Question } from './questions.js';
import type { Utterance } from './types.js';

/** Something that happens at a moment of the story. */
export type Cue = {
  readonly timeSecs: number;
  /** The live fragment that it belongs to; absent for the story's own. */
  readonly fragment?: number;
} & (
  | { readonly kind: 'word'; readonly utterance: number; readonly word: number; readonly text: string; readonly endSecs: number }
  /** A phone begins; `symbol` is of the phone set that `phoneSet` names. Only what was baked has phones. */
  | { readonly kind: 'phone'; readonly utterance: number; readonly symbol: string; readonly phoneSet: string; readonly endSecs: number }
  | { readonly kind: 'utterance'; readonly phase: 'start' | 'end'; readonly utterance: number; readonly text: string; readonly startSecs: number; readonly endSecs: number }
  /** A moment that the story names by `timeId` or `tm`. */
  | { readonly kind: 'mark'; readonly name: string }
  | ({ readonly kind: 'clause'; readonly phase: 'start' | 'end' } & ClauseRef)
  | { readonly kind: 'storyevent'; readonly type?: string; readonly payload: string }
  | Failure
);

/** Which clause of a story or fragment. */
interface ClauseRef {
  /** Its place, from 0. */
  readonly clause: number;
  /** The EML element, for example `gesture-key`. */
  readonly element: string;
  /** Its `timeId`. */
  readonly id?: string;
}

/** Something of a fragment is not performed, or not as meant. */
interface Failure {
  readonly kind: 'failed' | 'warning';
  readonly timeSecs: number;
  readonly fragment?: number;
  readonly code: string;
  readonly message: string;
  readonly hints?: readonly string[];
  /** Where in the fragment, from 1, in characters. */
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

/** What became of a fragment. */
export interface Performance {
  readonly events: readonly Answer[];
  readonly utterances: readonly Utterance[];
  /** The index of the first of them. */
  readonly firstUtterance: number;
  /** What it asks. */
  readonly questions: readonly Question[];
  /** When all that is known is over. */
  readonly endSecs: number;
  /** What it ended, where it was no fragment but `<interrupt/>`. */
  readonly cut?: InterruptionOutcome;
}

/** What fragments say and do has ended. */
export interface InterruptionOutcome {
  /** When. */
  readonly atSecs: number;
  /** When all that is known now is over. */
  readonly endSecs: number;
}
