/** The words that people have for features, and what a feature is apart from. */

import type { FacePack } from '../element/face/faces.js';
import { TABLE } from './find.js';

type Attribute = FacePack['attributes'][number];

const SHOWN: ReadonlyMap<string, string> = new Map(TABLE.map(({ thing, shown }) => [thing, shown]));

/** What an attribute may be called, too, to be shown below its name; empty where its name says it. */
export const alsoCalled = ({ name }: Attribute): string => SHOWN.get(`feature ${name}`) ?? '';

/** Impressions of a whole person, which nobody wants to change with a nose. */
const OVERALL: readonly string[] = ['sex', 'weight', 'age'];
/** Groups of which each feature is a measure of its own. */
const MEASURES: readonly string[] = ['face shape', 'eyes', 'nose', 'mouth', 'ears'];
/** Names of one thing: they go together. */
const YEARS: readonly string[] = ['age', 'ageing', 'growth'];

/** What keeps its value while an attribute is changed alone: sex, weight and age, and the other features of its group. */
export function keptWith(attribute: Attribute, all: readonly Attribute[]): Attribute[] {
  const isYears = YEARS.includes(attribute.name);
  return all.filter((other) => {
    if (other.part !== attribute.part || other.name === attribute.name || (isYears && YEARS.includes(other.name))) return false;
    return OVERALL.includes(other.name) || (other.group === attribute.group && MEASURES.includes(other.group));
  });
}

/** How the age of people is spread: the ends of an attribute are two standard deviations from the mean. */
export function yearsOf(people: FacePack['people']): (value: number) => number {
  const ages = people.map((p) => p.ageYears);
  const count = Math.max(1, ages.length);
  const mean = ages.reduce((sum, age) => sum + age, 0) / count;
  const deviation = Math.sqrt(ages.reduce((sum, age) => sum + (age - mean) ** 2, 0) / count);
  return (value) => Math.max(1, Math.round(mean + 2 * deviation * value));
}
