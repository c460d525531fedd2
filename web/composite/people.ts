/** Who the faces of the database are, and which of them are like a description (F&H 5.1.1). It chooses faces, and never changes one. */

import type { FacePack } from '../element/faces.js';
import type { FaceLook, NaturalHair } from '../element/types.js';

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
/** Who has less of every ancestry is mixed. */
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

/** The numbers of the faces that are like a description. */
export function chosen(people: FacePack['people'], wanted: Person): number[] {
  return people.flatMap((person, i) => (isLike(person, wanted) ? [i] : []));
}

/** A face of the database in a few words. */
export function describe({ sex, ageYears, ancestry }: Personal): string {
  const who = ageYears < 18 ? (sex >= 0.5 ? 'Girl' : 'Boy') : sex >= 0.5 ? 'Woman' : 'Man';
  const names = ['European', 'Asian', 'African'];
  const most = ancestry.indexOf(Math.max(...ancestry));
  const from = (ancestry[most] ?? 0) < MAINLY ? 'mixed' : (names[most] ?? '');
  return `${who} of ${Math.round(ageYears)}, ${from}`;
}

/** Hair begins to be grey at this age, and is so many years later, roughly: about half of it is grey at 62. */
const GREY_FROM_YEARS = 42;
const GREY_IN_YEARS = 40;

/** The hair that somebody of the database is shown with until its author chooses another: black or as the figure has it, and grey with the years. */
export function lookOf({ ageYears, ancestry }: Personal, natural: readonly NaturalHair[]): FaceLook {
  const grey = Math.min(1, Math.max(0, (ageYears - GREY_FROM_YEARS) / GREY_IN_YEARS));
  const isDark = ancestry[0] < 0.5;
  const own = natural.find(({ name }) => name === (isDark ? 'black' : 'dark brown'));
  if (own === undefined || (grey === 0 && !isDark)) return {};
  const colour = { ...own.colour, grey };
  return { hair: { colour }, brows: { ...colour, grey: 0.7 * grey } };
}
