/** Hair, accessories and skin marks: available choices, and validation of a file's choices. */

import { FORMER_HAIR } from '../element/face/face-look.js';
import type { FaceLook, FaceMark, HairColour, TattooShape, Accessory, AccessoryKind } from '../element/base/face-types.js';

/** Hair styles: other than the figure's own they are files of the library, `hair/NAME.glb`. */
export const HAIR: Readonly<Record<string, string>> = {
  own: 'As it is',
  none: 'Shaved',
  bald: 'Bald',
  buzz: 'Cropped to the skin',
  crop: 'Short, combed forward',
  side: 'Short, full on top',
  swept: 'Short, combed back',
  tousled: 'Short, ruffled',
  pixie: 'Short, with a fringe',
  receding: 'Receding',
  thinning: 'Thinning',
  balding: 'Bald on top',
  coily: 'Tight coils, short',
  afro: 'Tight coils, long',
  page: 'To the ears',
  bob: 'Bob',
  curly: 'Curls',
  wavy: 'Waves',
  long: 'Long',
  straight: 'Long, parted in the middle',
  ponytail: 'Ponytail',
  bun: 'Tied back in a bun',
  braid: 'Braid',
};
/** Beards; stubble is painted, the others are files like hair. */
export const BEARDS: Readonly<Record<string, string>> = {
  own: 'As it is',
  none: 'None',
  stubble: 'Stubble',
  moustache: 'Moustache',
  handlebar: 'Handlebar moustache',
  goatee: 'Goatee',
  circle: 'Moustache and goatee',
  curtain: 'Chin curtain',
  boxed: 'Full, short',
  full: 'Full, long',
};

export const WEAR: Readonly<Record<AccessoryKind, { readonly name: string; readonly rgb: Accessory['colour'] }>> = {
  'round-glasses': { name: 'Round glasses', rgb: [0.03, 0.03, 0.035] },
  'square-glasses': { name: 'Square glasses', rgb: [0.09, 0.035, 0.02] },
  sunglasses: { name: 'Sunglasses', rgb: [0.02, 0.02, 0.02] },
  'knitted-cap': { name: 'Knitted cap', rgb: [0.06, 0.1, 0.22] },
  hat: { name: 'Hat', rgb: [0.12, 0.085, 0.06] },
  headscarf: { name: 'Headscarf', rgb: [0.25, 0.05, 0.1] },
  'ear-studs': { name: 'Ear studs', rgb: [0.8, 0.8, 0.82] },
  'ear-rings': { name: 'Earrings', rgb: [0.75, 0.55, 0.2] },
  'nose-stud': { name: 'Nose stud', rgb: [0.8, 0.8, 0.82] },
};
/** Groups of accessories; a head wears one of each group at a time. */
export const GROUPS: readonly (readonly AccessoryKind[])[] = [
  ['round-glasses', 'square-glasses', 'sunglasses'],
  ['knitted-cap', 'hat', 'headscarf'],
  ['ear-studs', 'ear-rings'],
];

/** A kind of mark, and how one is at first: its length (metres), turn (radians) and strength. */
interface FirstMark {
  readonly name: string;
  readonly size: number;
  readonly turn: number;
  readonly strength: number;
}

export const MARKS: Readonly<Record<FaceMark['kind'], FirstMark>> = {
  scar: { name: 'Scar', size: 0.035, turn: 1, strength: 0.7 },
  mole: { name: 'Mole', size: 0.006, turn: 0, strength: 1 },
  birthmark: { name: 'Birthmark', size: 0.03, turn: 0, strength: 0.8 },
  tattoo: { name: 'Tattoo', size: 0.025, turn: 0, strength: 1 },
};
export const SHAPES: Readonly<Record<TattooShape, string>> = { star: 'Star', heart: 'Heart', cross: 'Cross', anchor: 'Anchor', dots: 'Three dots', text: 'Letters' };
/** A face has no more marks. */
export const MAX_MARKS = 100;
/** A mark is not longer, metres. */
export const MAX_MARK_LENGTH = 0.12;
/** Letters in a tattoo, at most. */
export const MAX_LETTERS = 24;

/** Returns the look with an accessory toggled; a new one replaces those that it excludes. */
export function toggled(look: FaceLook, kind: AccessoryKind): FaceLook {
  const { wear = [] } = look;
  const isWorn = wear.some((w) => w.kind === kind);
  const group = GROUPS.find((g) => g.includes(kind)) ?? [kind];
  const others = wear.filter((w) => !group.includes(w.kind));
  return { ...look, wear: isWorn ? others : [...others, { kind, colour: WEAR[kind].rgb }] };
}

/** Returns a colour between two, with the given grey. */
export function mixed(a: HairColour, b: HairColour, share: number, grey: number): HairColour {
  const between = (x: number, y: number): number => x + (y - x) * share;
  return { eumelanin: between(a.eumelanin, b.eumelanin), pheomelanin: between(a.pheomelanin, b.pheomelanin), grey };
}

const isRecord = (x: unknown): x is Record<string, unknown> => typeof x === 'object' && x !== null;
const isWithin = (x: unknown, from: number, to: number): boolean => typeof x === 'number' && x >= from && x <= to;
const isColour = (x: unknown): boolean => Array.isArray(x) && x.length === 3 && x.every((part) => isWithin(part, 0, 1));
const isPigment = (x: unknown): boolean => x === undefined || (isRecord(x) && isWithin(x['eumelanin'], 0, 3) && isWithin(x['pheomelanin'], 0, 3) && isWithin(x['grey'], 0, 1));
const isHair = (x: unknown, names: Readonly<Record<string, string>>): boolean =>
  x === undefined || (isRecord(x) && (x['from'] === undefined || [names, FORMER_HAIR].some((known) => Object.hasOwn(known, String(x['from'])))) && isPigment(x['colour']));
const isWear = (x: unknown): boolean => isRecord(x) && Object.hasOwn(WEAR, String(x['kind'])) && isColour(x['colour']);

/** Returns true if a file's value is a look. */
export function isLook(x: unknown): x is FaceLook {
  if (!isRecord(x) || !isHair(x['hair'], HAIR) || !isHair(x['beard'], BEARDS) || !isPigment(x['brows'])) return false;
  const { wear = [], cut = 'full' } = x;
  return ['full', 'moustache', 'goatee'].includes(cut as string) && Array.isArray(wear) && wear.length <= Object.keys(WEAR).length && wear.every(isWear);
}

/** Returns true if a file's value is a mark. */
export function isMark(x: unknown): x is FaceMark {
  if (!isRecord(x) || !Object.hasOwn(MARKS, String(x['kind'])) || !isWithin(x['size'], 0.0005, MAX_MARK_LENGTH) || !isWithin(x['turn'], -7, 7)) return false;
  const { corners, shares, shape = 'star', text = '', strength = 1 } = x;
  const isThree = (list: unknown, is: (one: unknown) => boolean): boolean => Array.isArray(list) && list.length === 3 && list.every(is);
  return (
    isThree(corners, (n) => Number.isSafeInteger(n) && isWithin(n, 0, 2 ** 32 - 1)) &&
    isThree(shares, (n) => isWithin(n, -0.01, 1.01)) &&
    isWithin(strength, 0, 1) &&
    Object.hasOwn(SHAPES, String(shape)) &&
    typeof text === 'string' &&
    text.length <= MAX_LETTERS
  );
}
