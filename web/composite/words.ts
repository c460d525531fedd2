/** The words that people have for features, and what a feature is apart from. */

import type { FacePack } from '../element/faces.js';

type Attribute = FacePack['attributes'][number];

/** What else an attribute may be called; it is shown below its name. */
const ALSO: Readonly<Record<string, string>> = {
  ageing: 'wrinkles, lines, old skin',
  growth: 'child, grown-up',
  'lightness of the skin': 'pale, tan, dark',
  'beard shadow': 'stubble, shaved',
  attractiveness: 'beautiful, handsome',
  'angles of the face': 'square, oval',
  'breadth of the face': 'wide, thin',
  'taper of the face': 'jaw, forehead',
  cheeks: 'hollow, full, chubby',
  'breadth of the chin': 'square, pointed jaw',
  'protrusion of the chin': 'weak, strong jaw',
  'nasolabial fold': 'line from nose to mouth',
  'opening of the eyes': 'narrow, big eyes',
  'inclination of the eyes': 'slanted, sad eyes',
  'distance of the eyes': 'close-set, wide-set',
  'lightness of the iris': 'eye colour',
  'colour of the iris': 'eye colour',
  'lightness of the brows': 'eyebrow colour',
  'thickness of the brows': 'eyebrows',
  'curve of the left brow': 'eyebrow, arched',
  'curve of the right brow': 'eyebrow, arched',
  'distance of the brows': 'eyebrows',
  'distance between brows and eyes': 'eyebrows',
  'breadth of the nose bridge': 'broad, narrow nose between the eyes',
  'breadth of the alar wings': 'broad, narrow nose, nostrils',
  'roundness of the alar wings': 'nostrils, bulbous',
  'profile of the nose': 'hooked, turned up, bump',
  'distance between nose and mouth': 'upper lip',
  'width of the mouth': 'broad, small mouth',
  lips: 'thick, full',
  'line of the lips': 'corners of the mouth',
  ears: 'sticking out',
};

/** What an attribute may be called, too; undefined where its name says it. */
export const alsoCalled = ({ name }: Attribute): string | undefined => ALSO[name];

/** Whether each of the words that were typed is in what an attribute is called. */
export function isCalled(attribute: Attribute, typed: string): boolean {
  const { name, group, terms } = attribute;
  const text = [name, group, ...terms, ALSO[name] ?? ''].join(' ').toLowerCase();
  return typed
    .toLowerCase()
    .split(/\s+/)
    .every((word) => text.includes(word));
}

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
