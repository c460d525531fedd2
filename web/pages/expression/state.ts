/** Settings of the page: two, the second once they are compared. */

import type { EmotionName } from './types.js';

/** Channels by which the environment expresses emotions; the face is always active. */
export interface Channels {
  camera: boolean;
  light: boolean;
  music: boolean;
}

export type StageSet = 'curtain' | 'fireside' | 'garden' | 'night' | 'school';

export interface Setting extends Channels {
  emotion: EmotionName;
  /** Potential of the eliciting events, 0 to 10. */
  potential: number;
  /** Set of the story. */
  set: StageSet;
  /** True for the light exactly as in GEVH, in full colour, instead of a gel. */
  thesis: boolean;
}

export type Side = 'a' | 'b';

export interface State {
  a: Setting;
  /** Second setting; null until compared. */
  b: Setting | null;
  /** True if both are on stage. */
  compares: boolean;
  /** Side that the controls edit. */
  edits: Side;
}

/** Returns the initial state of the page. */
export const beginning = (): State => ({
  a: { emotion: 'joy', potential: 3, camera: true, light: true, music: true, set: 'curtain', thesis: false },
  b: null,
  compares: false,
  edits: 'a',
});

/** Returns the setting of a side; one that was never compared equals the first, with the face only. */
export function settingOf({ a, b }: State, side: Side): Setting {
  return side === 'a' ? a : (b ?? { ...a, camera: false, light: false, music: false });
}
