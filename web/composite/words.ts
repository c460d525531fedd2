/** Common words for features, and the features independent of each. */

import type { FacePack } from '../element/face/faces.js';
import { TABLE } from './find.js';

type Attribute = FacePack['attributes'][number];

const SHOWN: ReadonlyMap<string, string> = new Map(TABLE.map(({ thing, shown }) => [thing, shown]));

/** Returns alternative names of an attribute, shown below its name; empty if the name suffices. */
export const alsoCalled = ({ name }: Attribute): string => SHOWN.get(`feature ${name}`) ?? '';

/** Impressions of a whole person, which must not change together with, for example, a nose. */
const OVERALL: readonly string[] = ['sex', 'weight', 'age'];
/** Groups in which each feature is an independent measure. */
const MEASURES: readonly string[] = ['face shape', 'eyes', 'nose', 'mouth', 'ears'];
/** Names of the same property, which change together. */
const YEARS: readonly string[] = ['age', 'ageing', 'growth'];

/** Returns the attributes that keep their value while an attribute is changed in isolation: sex, weight and age, and the other features of its group. */
export function keptWith(attribute: Attribute, all: readonly Attribute[]): Attribute[] {
  const isYears = YEARS.includes(attribute.name);
  return all.filter((other) => {
    if (other.part !== attribute.part || other.name === attribute.name || (isYears && YEARS.includes(other.name))) return false;
    return OVERALL.includes(other.name) || (other.group === attribute.group && MEASURES.includes(other.group));
  });
}

/** Returns the age distribution of the database: the ends of an attribute are two standard deviations from the mean. */
export function yearsOf(people: FacePack['people']): (value: number) => number {
  const ages = people.map((p) => p.ageYears);
  const count = Math.max(1, ages.length);
  const mean = ages.reduce((sum, age) => sum + age, 0) / count;
  const deviation = Math.sqrt(ages.reduce((sum, age) => sum + (age - mean) ** 2, 0) / count);
  return (value) => Math.max(1, Math.round(mean + 2 * deviation * value));
}
