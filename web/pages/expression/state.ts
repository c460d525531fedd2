/** What the controls of the page are set to: two settings, the second once they are compared. */

import type { EmotionName } from './types.js';

/** The channels by which the environment expresses what is felt; the face always does. */
export interface Channels {
  camera: boolean;
  light: boolean;
  music: boolean;
}

export type StageSet = 'curtain' | 'fireside' | 'garden' | 'night' | 'school';

export interface Setting extends Channels {
  emotion: EmotionName;
  /** How strong the events are that elicit it, 0 to 10. */
  potential: number;
  /** Where the story is told. */
  set: StageSet;
  /** Whether the light is that of GEVH to the letter, in full colour, and not a gel. */
  thesis: boolean;
}

export type Side = 'a' | 'b';

export interface State {
  a: Setting;
  /** None until it is compared with the first. */
  b: Setting | null;
  /** Whether both are on stage. */
  compares: boolean;
  /** Which one the controls change. */
  edits: Side;
}

/** What a new page shows. */
export const beginning = (): State => ({
  a: { emotion: 'joy', potential: 3, camera: true, light: true, music: true, set: 'curtain', thesis: false },
  b: null,
  compares: false,
  edits: 'a',
});

/** The setting of a side; what was never compared is as the first, by its face alone. */
export function settingOf({ a, b }: State, side: Side): Setting {
  return side === 'a' ? a : (b ?? { ...a, camera: false, light: false, music: false });
}
