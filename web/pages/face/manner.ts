/**
 * Amount and frequency of expressions that accompany speech: the amounts of `r:performer` (F&H sections 4.2 and 4.3; `crate/actor/src/nonverbal/manner.rs`).
 */

/** Adjustable amount with its EML attribute. */
export interface Amount {
  /** Name of the EML attribute. */
  readonly name: string;
  readonly label: string;
  /** Short description of its effect. */
  readonly note: string;
  readonly least: number;
  readonly most: number;
  readonly step: number;
  /** Default value. */
  readonly usual: number;
}

export interface AmountGroup {
  readonly title: string;
  readonly amounts: readonly Amount[];
}

const share = (name: string, label: string, note: string, usual: number): Amount => ({ name, label, note, least: 0, most: 1, step: 0.01, usual });

export const AMOUNTS: readonly AmountGroup[] = [
  {
    title: 'Head',
    amounts: [
      share('head', 'Raises', 'amount of head raises and tilts', 1),
      share('tilts', 'Tilts', 'share of raises with a tilt to a side', 0.75),
      share('headByLoudness', 'Follows loudness', 'influence of loudness on its raises', 0.4),
    ],
  },
  {
    title: 'Brows',
    amounts: [
      { name: 'brows', label: 'Movement', note: 'amount of brow raises and frowns', least: 0, most: 2, step: 0.01, usual: 1 },
      share('browShare', 'At high pitches', 'share of pitch maxima with a brow raise', 0.71),
      share('browsByLoudness', 'Follow loudness', 'influence of loudness on them', 0.25),
      {
        name: 'pitchThreshold',
        label: 'Pitch threshold',
        note: 'semitones by which a pitch maximum must stand out, for head and brows',
        least: 0.1,
        most: 24,
        step: 0.1,
        usual: 2.5,
      },
    ],
  },
  {
    title: 'Eyes',
    amounts: [
      { name: 'blinks', label: 'Blinks', note: 'relative to 22 per minute in speech', least: 0, most: 4, step: 0.01, usual: 1 },
      { name: 'gaze', label: 'Looks aside', note: 'amount of gaze aversion', least: 0, most: 2, step: 0.01, usual: 1 },
      share('accentGlances', 'Glances at accents', 'share of accented syllables with a look at the listener', 0.7),
      share('pauseGlances', 'Glances in pauses', 'the same share for pauses between phrases', 0.7),
    ],
  },
  {
    title: 'Thinking and lips',
    amounts: [
      { name: 'thinkingPause', label: 'Thinking from', note: 'minimum length of a thinking pause, in seconds', least: 0.15, most: 5, step: 0.05, usual: 0.7 },
      share('thinking', 'Thinking shows', 'share of such pauses that show thinking', 1),
      share('frowns', 'Frowns', 'share of these with a frown at the floor', 0.25),
      { name: 'lickInterval', label: 'Moistens lips every', note: 'seconds between two moistenings', least: 1, most: 120, step: 1, usual: 25 },
    ],
  },
];

/** All amounts of all groups. */
export const ALL_AMOUNTS: readonly Amount[] = AMOUNTS.flatMap((group) => group.amounts);
