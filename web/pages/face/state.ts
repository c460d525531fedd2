/** State of the face controls: everything expressed in the EML. */

import { NEUTRAL, type EmotionPoint } from './disc.js';

/** The drawing mode of the head. */
export interface Layers {
  skin: boolean;
  springs: boolean;
  muscles: boolean;
  skull: boolean;
}

/** A sentence of a story as its script has it. */
export interface Line {
  /** Words of the sentence, for display. */
  readonly label: string;
  /** `voice-text` or `voice-say` of the sentence, without a time. */
  readonly markup: string;
  /** Other parts of the script that affect its voice: language, voice, emotion. */
  readonly before: readonly string[];
  /** Parts of the script's head that affect it. */
  readonly head: string;
}

/** Speech: none, a custom text, or a sentence of a story in its voice. */
export type Speech = { kind: 'none' } | { kind: 'text'; text: string } | { kind: 'story'; line: Line };

/** Source of the expressions that accompany speech, as in EML. */
export type PlanBasis = 'sound' | 'text';

export interface State {
  emotion: EmotionPoint;
  /** Word chosen for the emotion; empty if only a position was chosen. */
  word: string;
  /** Control parameters that are not 0, by their names in EML; of two sides each for itself. */
  values: Record<string, number>;
  /** True if left and right move together. */
  linked: boolean;
  speech: Speech;
  /** Address of the story whose voice is loaded; empty for none. */
  story: string;
  way: PlanBasis;
  /** Non-default amounts of accompanying expressions, by EML name. */
  manner: Record<string, number>;
  layers: Layers;
}

/** Returns the initial state of the page. */
export const beginning = (): State => ({
  emotion: { ...NEUTRAL },
  word: '',
  values: {},
  linked: true,
  speech: { kind: 'none' },
  story: '',
  way: 'sound',
  manner: {},
  layers: { skin: true, springs: false, muscles: false, skull: false },
});
