/** Persons of the database, and those that match a description (F&H 5.1.1). It selects faces, and never changes one. */

import type { FacePack } from '../element/face/faces.js';
import type { FaceLook, NaturalHair } from '../element/base/face-types.js';

type Personal = FacePack['people'][number];

export const SEXES = { any: 'Anybody', woman: 'A woman', man: 'A man' } as const;
export const AGES = { any: 'Any age', child: 'Under 18', young: '18 to 35', middle: '36 to 55', late: '56 to 65', old: '66 and older' } as const;
export const ANCESTRIES = { any: 'Any ancestry', european: 'European', asian: 'Asian', african: 'African', mixed: 'Mixed' } as const;

/** The description. */
export interface Person {
  sex: keyof typeof SEXES;
  age: keyof typeof AGES;
  ancestry: keyof typeof ANCESTRIES;
}

const YEARS: Readonly<Record<keyof typeof AGES, readonly [from: number, below: number]>> = {
  any: [0, 200],
  child: [0, 18],
  young: [18, 36],
  middle: [36, 56],
  late: [56, 66],
  old: [66, 200],
};
/** Minimum share of an ancestry; below it for all of them, a person counts as mixed. */
const MAINLY = 0.6;

function isLike({ sex, ageYears, ancestry }: Personal, wanted: Person): boolean {
  const [from, below] = YEARS[wanted.age];
  if (wanted.sex !== 'any' && sex >= 0.5 !== (wanted.sex === 'woman')) return false;
  if (ageYears < from || ageYears >= below) return false;
  if (wanted.ancestry === 'any') return true;
  const [european, asian, african] = ancestry;
  const shares = { european, asian, african };
  return wanted.ancestry === 'mixed' ? Math.max(...ancestry) < MAINLY : shares[wanted.ancestry] >= MAINLY;
}

/** Returns the numbers of the faces that match a description. */
export function chosen(people: FacePack['people'], wanted: Person): number[] {
  return people.flatMap((person, i) => (isLike(person, wanted) ? [i] : []));
}

/** Describes a face of the database in a few words. */
export function describe({ sex, ageYears, ancestry }: Personal): string {
  const who = ageYears < 18 ? (sex >= 0.5 ? 'Girl' : 'Boy') : sex >= 0.5 ? 'Woman' : 'Man';
  const names = ['European', 'Asian', 'African'];
  const most = ancestry.indexOf(Math.max(...ancestry));
  const from = (ancestry[most] ?? 0) < MAINLY ? 'mixed' : (names[most] ?? '');
  return `${who} of ${Math.round(ageYears)}, ${from}`;
}

/** Age at which hair begins to turn grey, and its rate: about half of it is grey at 62. */
const GREY_FROM_YEARS = 42;
const GREY_IN_YEARS = 40;
/** Age limits of body figures: younger people have the body of a child; men older than the second limit that of an old man. */
const GROWN_YEARS = 13;
const OLD_YEARS = 57;
const BEARD_FROM_YEARS = 20;

/** Groups of people who wear the same hair. */
type Group = 'girl' | 'woman' | 'lady' | 'boy' | 'youth' | 'man' | 'elder';

/** Common hair styles of a group; a name listed twice is twice as common. */
const WORN: Readonly<Record<Group, readonly string[]>> = {
  girl: ['long', 'straight', 'ponytail', 'braid', 'page', 'bob'],
  woman: ['bob', 'wavy', 'long', 'straight', 'curly', 'ponytail', 'bun', 'pixie'],
  lady: ['bob', 'page', 'pixie', 'pixie', 'curly', 'bun'],
  boy: ['tousled', 'crop', 'tousled', 'page'],
  youth: ['crop', 'side', 'swept', 'tousled', 'buzz'],
  man: ['crop', 'side', 'swept', 'receding', 'thinning', 'buzz'],
  elder: ['receding', 'balding', 'thinning', 'swept', 'balding', 'bald'],
};
/** Hairstyles of each group for tightly coiled hair. */
const COILED: Readonly<Record<Group, readonly string[]>> = {
  girl: ['bun', 'afro', 'braid'],
  woman: ['afro', 'coily', 'bun', 'braid'],
  lady: ['coily', 'bun'],
  boy: ['coily', 'buzz'],
  youth: ['coily', 'buzz', 'afro'],
  man: ['buzz', 'coily', 'bald'],
  elder: ['buzz', 'balding', 'bald'],
};
const SHAVED = ['none', 'none', 'none', 'stubble', 'stubble', 'boxed', 'goatee', 'circle'];
const GROWN = ['none', 'none', 'moustache', 'full', 'boxed', 'circle', 'handlebar', 'curtain'];
const FAIR = ['dark brown', 'dark brown', 'brown', 'brown', 'light brown', 'dark blond', 'blond', 'auburn', 'red'];

function groupOf({ sex, ageYears }: Personal): Group {
  if (ageYears < GROWN_YEARS) return sex >= 0.5 ? 'girl' : 'boy';
  if (sex >= 0.5) return ageYears < 50 ? 'woman' : 'lady';
  return ageYears < 32 ? 'youth' : ageYears < OLD_YEARS ? 'man' : 'elder';
}

/** Selects one item, always the same for the same person: the choice is pseudo-random. */
function one<T>(of: readonly T[], { ageYears, sex, ancestry }: Personal, salt: number): T {
  const noise = Math.sin(ageYears * 127.1 + sex * 311.7 + ancestry[0] * 74.7 + ancestry[1] * 269.5 + salt * 53.3) * 43_758.545;
  return of[Math.floor((noise - Math.floor(noise)) * of.length)] as T;
}

/** Returns the default hair and beard of a database person: common for their sex, age and ancestry, grey with age. */
export function lookOf(person: Personal, natural: readonly NaturalHair[]): FaceLook {
  const { ageYears, ancestry, sex } = person;
  const grey = Math.min(1, Math.max(0, (ageYears - GREY_FROM_YEARS) / GREY_IN_YEARS));
  const wanted = ancestry[0] < 0.5 ? 'black' : one(FAIR, person, 1);
  const own = natural.find(({ name }) => name === wanted);
  const colour = own === undefined ? undefined : { ...own.colour, grey };
  const from = one((ancestry[2] >= 0.5 ? COILED : WORN)[groupOf(person)], person, 2);
  const beard = sex >= 0.5 || ageYears < BEARD_FROM_YEARS ? 'none' : one(ageYears < 50 ? SHAVED : GROWN, person, 3);
  return { hair: { from, colour }, beard: { from: beard, colour }, brows: colour && { ...colour, grey: 0.7 * grey } };
}

/** Figures of the library; the empty name is the default figure. */
export const FIGURES: ReadonlySet<string> = new Set(['', 'sofia', 'papous', 'nuno', 'amara', 'kenji', 'lia']);

/** Returns the library figure whose body and clothes suit a database person. */
export function figureOf({ sex, ageYears, ancestry }: Personal): string {
  if (ageYears < GROWN_YEARS) return sex >= 0.5 ? 'lia' : 'nuno';
  if (sex >= 0.5) return ancestry[2] >= 0.5 ? 'amara' : 'sofia';
  return ageYears < OLD_YEARS ? 'kenji' : 'papous';
}
