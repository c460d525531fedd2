/** Messages sent to a mind. */

import type { Answered } from './answers.js';
import type { Answer, Cue } from './performance.js';
import type { Question } from './questions.js';

/** Messages to a mind other than cues. */
export type Note =
  | { readonly kind: 'hello'; readonly version: 1; readonly timeSecs: number; readonly endSecs: number; readonly figure: string }
  | { readonly kind: 'transport'; readonly event: string; readonly timeSecs: number }
  | ({ readonly kind: 'question' } & Omit<Question, 'kind'> & { readonly type: Question['kind'] })
  | ({ readonly kind: 'answered' } & Answered)
  | { readonly kind: 'lost'; readonly count: number };

/** Any message to a mind. */
export type MindEvent = Cue | Answer | Note;
