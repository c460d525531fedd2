/** Animations of the library, by category. */

import clips from 'virtual:clips';

export interface Clip {
  /** The name in EML, and of its file. */
  readonly name: string;
  /** Description, one sentence. */
  readonly about: string;
}

/** Categories of clips; the first match applies. */
const SHELVES: readonly (readonly [string, RegExp])[] = [
  ['Steps', /^(step|walk)/],
  ['Exercise', /^(arms|stretch)-/],
  ['Stances', /^(stand|sit$|hands-)/],
  ['Talking', /./],
];

/** Shelf by shelf, in the order of use. */
export const SHELVED: readonly { readonly shelf: string; readonly clips: readonly Clip[] }[] = ['Stances', 'Talking', 'Steps', 'Exercise'].map((shelf) => ({
  shelf,
  clips: clips.filter(({ name }) => SHELVES.find(([, names]) => names.test(name))?.[0] === shelf),
}));

/** Returns the description of an animation. */
export const aboutClip = (name: string): string => clips.find((clip) => clip.name === name)?.about ?? '';

/** Returns the display title of a clip, for example of `step-march`. */
export const clipTitle = (name: string): string =>
  name
    .replace(/^step-/, '')
    .replaceAll('-', ' ')
    .replace(/^./, (c) => c.toUpperCase());
