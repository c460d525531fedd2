/** What of a face can be asked for by name: the control parameters of `crate/actor/src/parameters`, as the page groups them. */

/** One slider: a muscle or a direct parameter, alone or left and right. */
export interface Dial {
  /** Its name in EML, without the side where there are two. */
  readonly name: string;
  /** What the page calls it. */
  readonly label: string;
  /** What it does, in a few words. */
  readonly note: string;
  /** One on each side of the face. */
  readonly paired: boolean;
  /** It goes from -1 to 1 instead of from 0. */
  readonly signed: boolean;
}

export interface Region {
  readonly title: string;
  readonly dials: readonly Dial[];
}

const one = (name: string, label: string, note: string, signed = false): Dial => ({ name, label, note, paired: false, signed });
const two = (name: string, label: string, note: string, signed = false): Dial => ({ name, label, note, paired: true, signed });

/** The 38 muscles by region (F&H table 3.1). */
export const MUSCLES: readonly Region[] = [
  {
    title: 'Brows and forehead',
    dials: [
      two('FrontalisMedial', 'Frontalis, inner', 'raises the inner brow'),
      two('FrontalisLateral', 'Frontalis, outer', 'raises the outer brow'),
      two('CorrugatorSupercilii', 'Corrugator supercilii', 'draws the brows together'),
      two('DepressorSupercilii', 'Depressor supercilii', 'lowers the inner brow'),
      one('Procerus', 'Procerus', 'pulls the brows down'),
    ],
  },
  {
    title: 'Eyes and nose',
    dials: [
      two('OrbicularisOculi', 'Orbicularis oculi', 'squeezes the eye'),
      two('Nasalis', 'Nasalis', 'widens the nostril'),
      one('DepressorSeptiNasi', 'Depressor septi nasi', 'pulls the tip of the nose down'),
      two('LevatorLabiiSuperiorisAlaequeNasi', 'Levator labii alaeque nasi', 'wrinkles the nose'),
    ],
  },
  {
    title: 'Cheeks and upper lip',
    dials: [
      two('LevatorLabiiSuperioris', 'Levator labii superioris', 'raises the upper lip'),
      two('ZygomaticusMinor', 'Zygomaticus minor', 'raises the upper lip outwards'),
      two('ZygomaticusMajor', 'Zygomaticus major', 'smiles'),
      two('LevatorAnguliOris', 'Levator anguli oris', 'raises the corner of the mouth'),
      two('Risorius', 'Risorius', 'widens the mouth'),
      two('Buccinator', 'Buccinator', 'presses the cheek in'),
    ],
  },
  {
    title: 'Lower lip, chin and neck',
    dials: [
      one('OrbicularisOrisUpper', 'Orbicularis oris, upper', 'tightens the upper lip'),
      one('OrbicularisOrisLower', 'Orbicularis oris, lower', 'tightens the lower lip'),
      two('DepressorAnguliOris', 'Depressor anguli oris', 'pulls the corner of the mouth down'),
      two('DepressorLabiiInferioris', 'Depressor labii inferioris', 'pulls the lower lip down'),
      two('Mentalis', 'Mentalis', 'pushes the chin up'),
      two('Platysma', 'Platysma', 'stretches neck and chin'),
    ],
  },
];

/** What no muscle moves here. */
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

export const ALL: readonly Dial[] = [...MUSCLES, ...DIRECT, ...VISEMES].flatMap((region) => region.dials);

/** The names that a dial has in EML by itself: both sides, or one. */
export const namesOf = ({ name, paired }: Dial): readonly string[] => (paired ? [`${name}Left`, `${name}Right`] : [name]);
