/** What the controls of the face are set to: everything that its EML says. */

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
  /** Its words, for people. */
  readonly label: string;
  /** Its `voice-text` or `voice-say`, without a time. */
  readonly markup: string;
  /** What else of the script its voice depends on: language, voice, emotion. */
  readonly before: readonly string[];
  /** What of the script's head it depends on. */
  readonly head: string;
}

/** The speech: nothing, a text of one's own, or a sentence of a story in its voice. */
export type Speech = { kind: 'none' } | { kind: 'text'; text: string } | { kind: 'story'; line: Line };

/** What expressions beside speech are made from, as EML has it. */
export type PlanBasis = 'sound' | 'text';

export interface State {
  emotion: EmotionPoint;
  /** The word that was chosen for it; empty where only its place was. */
  word: string;
  /** Control parameters that are not 0, by their names in EML; of two sides each for itself. */
  values: Record<string, number>;
  /** Left and right move together. */
  linked: boolean;
  speech: Speech;
  /** Address of the story whose voice is at hand; empty for none. */
  story: string;
  way: PlanBasis;
  /** Amounts of what accompanies speech that are not the usual ones, by their names in EML. */
  manner: Record<string, number>;
  layers: Layers;
}

/** What a new page shows. */
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
