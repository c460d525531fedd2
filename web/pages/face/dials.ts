/** The controls of a face that have names: the control parameters of `crate/actor/src/parameters`, as the page groups them. */

import table from '../../../crate/tissue/src/muscles.tsv?raw';

/** Slider: a muscle or a direct parameter, alone or left and right. */
export interface FaceControl {
  /** Name in EML, without the side for a paired control. */
  readonly name: string;
  /** Label on the page. */
  readonly label: string;
  /** Short description of its effect. */
  readonly note: string;
  /** True if there is one on each side of the face. */
  readonly paired: boolean;
  /** True for a range of -1 to 1 instead of from 0. */
  readonly signed: boolean;
}

export interface Region {
  readonly title: string;
  readonly dials: readonly FaceControl[];
}

const one = (name: string, label: string, note: string, signed = false): FaceControl => ({ name, label, note, paired: false, signed });
const two = (name: string, label: string, note: string, signed = false): FaceControl => ({ name, label, note, paired: true, signed });

interface Row {
  readonly title: string;
  readonly dial: FaceControl;
}

/** Returns the rows of a muscle table, such as `crate/tissue/src/muscles.tsv`, with the parts shown on this page. */
const rowsOf = (text: string): readonly Row[] =>
  text
    .trimEnd()
    .split('\n')
    .slice(1)
    .map((line) => {
      const [name = '', sides = '', , , , , , , , title = '', label = '', note = ''] = line.split('\t');
      return { title, dial: sides === 'pair' ? two(name, label, note) : one(name, label, note) };
    });

/** Returns the muscles of a table by region, in order of first appearance. */
export function musclesOf(text: string): readonly Region[] {
  const rows = rowsOf(text);
  return [...new Set(rows.map((row) => row.title))].map((title) => ({
    title,
    dials: rows.filter((row) => row.title === title).map((row) => row.dial),
  }));
}

/** Muscles in the order of the table, pairs once: the order of the player's numbers. */
export const MUSCLE_ORDER: readonly FaceControl[] = rowsOf(table).map((row) => row.dial);

/** The muscles by region (F&H table 3.1). */
export const MUSCLES: readonly Region[] = musclesOf(table);

/** Controls without a muscle. */
export const DIRECT: readonly Region[] = [
  {
    title: 'Jaw',
    dials: [
      one('Jaw', 'Open', 'turns the jaw down'),
      one('JawDown', 'Down', 'slides the jaw down'),
      one('JawYaw', 'Sideways', 'turns the jaw to a side', true),
      one('JawForward', 'Forward', 'slides the jaw to the front or back', true),
    ],
  },
  {
    title: 'Lips',
    dials: [
      one('LipProtrusionUpper', 'Upper lip forward', 'protrudes or retracts it', true),
      one('LipProtrusionLower', 'Lower lip forward', 'protrudes or retracts it', true),
      one('LipSeal', 'Seal', 'lips together, as for m'),
      one('LipBite', 'Bite', 'lower lip at the teeth, as for f'),
    ],
  },
  {
    title: 'Eyes',
    dials: [
      two('UpperLid', 'Upper lid', 'closes, or opens wide', true),
      two('LowerLid', 'Lower lid', 'raises it'),
      one('GazeX', 'Gaze sideways', 'to the figure’s left', true),
      one('GazeY', 'Gaze up', 'up or down', true),
    ],
  },
  {
    title: 'Tongue and skin',
    dials: [
      one('TongueTip', 'Tongue’s tip', 'to the ridge behind the teeth'),
      one('TongueBack', 'Tongue’s back', 'to the velum'),
      one('TongueOut', 'Tongue out', 'between the teeth'),
      one('Blush', 'Blush', 'or pallor', true),
    ],
  },
];

/** The mouths of the 15 visemes; their names have `Viseme` before them in EML. */
export const VISEMES: readonly Region[] = [
  {
    title: 'Visemes',
    dials: (
      [
        ['sil', 'silence'],
        ['PP', 'p, b, m'],
        ['FF', 'f, v'],
        ['TH', 'th'],
        ['DD', 't, d'],
        ['kk', 'k, g'],
        ['CH', 'tch, j, sh'],
        ['SS', 's, z'],
        ['nn', 'n, l'],
        ['RR', 'r'],
        ['aa', 'ah'],
        ['E', 'eh'],
        ['ih', 'ee'],
        ['oh', 'oh'],
        ['ou', 'oo'],
      ] as const
    ).map(([name, note]) => one(`Viseme${name}`, name, note)),
  },
];

export const ALL: readonly FaceControl[] = [...MUSCLES, ...DIRECT, ...VISEMES].flatMap((region) => region.dials);

/** Returns the EML names of a dial: both sides, or one. */
export const namesOf = ({ name, paired }: FaceControl): readonly string[] => (paired ? [`${name}Left`, `${name}Right`] : [name]);
