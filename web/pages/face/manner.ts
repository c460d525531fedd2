/** How much and how often one accompanies speech: the amounts of `r:performer` (F&H sections 4.2 and 4.3; `crate/actor/src/nonverbal/manner.rs`). */

/** One amount. */
export interface Amount {
  /** Its attribute in EML. */
  readonly name: string;
  readonly label: string;
  /** What it does, in a few words. */
  readonly note: string;
  readonly least: number;
  readonly most: number;
  readonly step: number;
  /** Where nothing is said. */
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
      share('head', 'Raises', 'how far the head is raised and tilted', 1),
      share('tilts', 'Tilts', 'in which share of the raises it tilts to a side', 0.75),
      share('headByLoudness', 'Follows loudness', 'how far the loudness rules its raises', 0.4),
    ],
  },
  {
    title: 'Brows',
    amounts: [
      { name: 'brows', label: 'Movement', note: 'how far the brows are raised and drawn together', least: 0, most: 2, step: 0.01, usual: 1 },
      share('browShare', 'At high pitches', 'at which share of the highest pitches they are raised', 0.71),
      share('browsByLoudness', 'Follow loudness', 'how far the loudness rules them', 0.25),
      {
        name: 'pitchThreshold',
        label: 'Threshold of pitch',
        note: 'semitones that a pitch stands out to be shown, by head and brows',
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
      { name: 'blinks', label: 'Blinks', note: 'against 22 a minute in speech', least: 0, most: 4, step: 0.01, usual: 1 },
      { name: 'gaze', label: 'Looks aside', note: 'how far the gaze goes', least: 0, most: 2, step: 0.01, usual: 1 },
      share('accentGlances', 'Glances at accents', 'on which share of accented syllables one looks at the listener', 0.7),
      share('pauseGlances', 'Glances in pauses', 'the same of pauses between phrases', 0.7),
    ],
  },
  {
    title: 'Thinking and lips',
    amounts: [
      { name: 'thinkingPause', label: 'Thinking from', note: 'seconds of a pause that is one for thinking', least: 0.15, most: 5, step: 0.05, usual: 0.7 },
      share('thinking', 'Thinking shows', 'in which share of such pauses', 1),
      share('frowns', 'Frowns', 'which share of them is a look down with a frown', 0.25),
      { name: 'lickInterval', label: 'Moistens lips every', note: 'seconds between two moistenings', least: 1, most: 120, step: 1, usual: 25 },
    ],
  },
];

/** All of them. */
export const ALL_AMOUNTS: readonly Amount[] = AMOUNTS.flatMap((group) => group.amounts);
