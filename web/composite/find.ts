/**
 * Search of the editor by plain words, in English, Portuguese and German: features, hair, beards, accessories, marks and panels, by whole words and prefixes,
 * ignoring accents.
 */

import type { FacePack } from '../element/face/faces.js';
import table from './words.tsv?raw';

type Attribute = FacePack['attributes'][number];

/** A kind of item and its name: `feature lips`, `beard full`, `style Hair`, `tab history`. */
export type FinderTarget = `${'feature' | 'style' | 'hair' | 'beard' | 'worn' | 'mark' | 'tab' | 'light'} ${string}`;

/** A line of the table. */
export interface Row {
  readonly thing: FinderTarget;
  /** Text shown below a feature's name; usually empty. */
  readonly shown: string;
  /** Common names, in all languages. */
  readonly called: readonly string[];
}

/** A search result; results are sorted by relevance. */
export interface FinderMatch {
  readonly thing: FinderTarget;
  /** Relevance, up to 1. */
  readonly score: number;
}

interface Phrase {
  readonly words: readonly string[];
  /** Weight; the name of a group counts less for each of its features. */
  readonly worth: number;
}

/** Search index: the phrases of each item, and all of their words. */
export interface Index {
  readonly things: ReadonlyMap<FinderTarget, readonly Phrase[]>;
  readonly words: ReadonlySet<string>;
}

/** Line of the words that belong to no item. */
const LIGHT_LINE = 'light words';
const LIGHT_WEIGHT = 0.3;
/** Endings that distinguish forms of a word (`scared` is not a form of `scar`), and those of plurals. */
const PLURALS = new Set(['', 's', 'es', 'n', 'en']);
const ENDINGS = new Set(['', 's', 'es', 'e', 'n', 'en', 'er', 'em', 'o', 'a', 'os', 'as']);
/** Minimum number of letters that forms of a word share. */
const STEM = 3;
/** Worth of a form of a word, and of a beginning of one. */
const OF_FORM = 0.9;
const OF_BEGINNING = 0.6;
const OF_GROUP = 0.5;

/** Returns the rows of the table. */
export function tableOf(text: string): Row[] {
  const lines = text.split('\n').filter((line) => line !== '' && !line.startsWith('#'));
  return lines.map((line) => {
    const [thing = '', shown = '', ...called] = line.split('\t');
    return {
      thing: thing as FinderTarget,
      shown,
      called: called
        .join(',')
        .split(',')
        .flatMap((phrase) => phrase.trim() || []),
    };
  });
}

const LINES = tableOf(table);
/** Words of direction, degree, or no meaning: they affect the ranking of results, but exclude none. */
const LIGHT: ReadonlySet<string> = new Set(LINES.find(({ thing }) => thing === LIGHT_LINE)?.called.flatMap(wordsOf));
/** Searchable items. */
export const TABLE: readonly Row[] = LINES.filter(({ thing }) => thing !== LIGHT_LINE);

/** Returns the words of a text, in lower case without accents. */
export function wordsOf(text: string): string[] {
  const plain = text.normalize('NFKD').replace(/\p{M}/gu, '').toLowerCase().replace(/ß/g, 'ss').replace(/['’]/g, '');
  return plain.match(/[\p{L}\p{N}]+/gu) ?? [];
}

const weightOf = (word: string): number => (LIGHT.has(word) ? LIGHT_WEIGHT : 1);

/** Builds the search index of a pack and the editor. */
export function indexOf(attributes: readonly Attribute[], rows: readonly Row[] = TABLE): Index {
  const things = new Map<FinderTarget, Phrase[]>();
  const add = (thing: FinderTarget, texts: readonly string[], worth = 1): void => {
    const phrases = texts.map((text) => ({ words: wordsOf(text), worth }));
    things.set(thing, [...(things.get(thing) ?? []), ...phrases]);
  };
  // A feature of the pack that is not in the table is still found by its name.
  for (const { name, group, terms } of attributes) {
    add(`feature ${name}`, [name, ...terms.map((term) => `${term} ${name}`)]);
    add(`feature ${name}`, [group, ...terms], OF_GROUP);
  }
  for (const { thing, shown, called } of rows) if (!thing.startsWith('feature ') || things.has(thing)) add(thing, [...called, ...shown.split(', ')]);
  const words = new Set([...things.values()].flat().flatMap((phrase) => phrase.words));
  return { things, words };
}

const isForm = (a: string, b: string, endings: ReadonlySet<string>): boolean => {
  let same = 0;
  while (same < a.length && a[same] === b[same]) same += 1;
  return same >= STEM && endings.has(a.slice(same)) && endings.has(b.slice(same));
};

/**
 * Returns the words of the index that a typed word may mean, with their weights: itself and its plural if present, else its forms, else words with it as
 * prefix.
 */
function meant(typed: string, words: ReadonlySet<string>): ReadonlyMap<string, number> {
  const isKnown = words.has(typed);
  const forms = [...words].filter((word) => isForm(typed, word, isKnown ? PLURALS : ENDINGS));
  if (isKnown) return new Map([...forms.map((word) => [word, OF_FORM] as const), [typed, 1]]);
  if (forms.length > 0) return new Map(forms.map((word) => [word, OF_FORM]));
  const begun = typed.length < 2 ? [] : [...words].filter((word) => word.startsWith(typed));
  return new Map(begun.map((word) => [word, OF_BEGINNING + ((OF_FORM - OF_BEGINNING) * typed.length) / word.length]));
}

/** Returns the match of a phrase with the typed words: the shares of each found in the other, as one number up to 1. */
function fit({ words, worth }: Phrase, typed: readonly ReadonlyMap<string, number>[], weights: readonly number[]): { score: number; isContained: boolean } {
  const used = new Set<string>();
  let [ofTyped, all] = [0, 0];
  typed.forEach((may, i) => {
    const weight = weights[i] ?? 0;
    all += weight;
    const best = words.filter((word) => may.has(word)).sort((a, b) => (may.get(b) ?? 0) - (may.get(a) ?? 0))[0];
    if (best === undefined) return;
    used.add(best);
    ofTyped += weight * (may.get(best) ?? 0);
  });
  const total = words.reduce((sum, word) => sum + weightOf(word), 0);
  const ofPhrase = words.reduce((sum, word) => sum + (used.has(word) ? weightOf(word) : 0), 0);
  const [a, b] = [ofTyped / Math.max(all, 1e-9), ofPhrase / Math.max(total, 1e-9)];
  const heavy = words.filter((word) => weightOf(word) === 1);
  const needed = heavy.length > 0 ? heavy : words;
  return { score: a + b === 0 ? 0 : (worth * 2 * a * b) / (a + b), isContained: needed.length > 0 && needed.every((word) => used.has(word)) };
}

/** Searches by words. Returns all items that match all words; if none does, all that match some of them. */
export function search({ things, words }: Index, typed: string): FinderMatch[] {
  const all = wordsOf(typed);
  if (all.length === 0) return [];
  const may = all.map((word) => meant(word, words));
  const weights = all.map(weightOf);
  const needed = weights.includes(1) ? may.filter((_, i) => weights[i] === 1) : may;
  const found = [...things].map(([thing, phrases]) => {
    const fits = phrases.map((phrase) => fit(phrase, may, weights));
    const own = new Set(phrases.flatMap((phrase) => phrase.words));
    return {
      thing,
      score: Math.max(...fits.map(({ score }) => score)),
      hasAll: needed.every((one) => [...one.keys()].some((word) => own.has(word))),
      isNamed: fits.some(({ score, isContained }) => isContained && score > 0),
    };
  });
  const whole = found.filter(({ hasAll }) => hasAll);
  const best = (whole.length > 0 ? whole : found.filter(({ isNamed }) => isNamed)).sort((a, b) => b.score - a.score);
  return best.map(({ thing, score }) => ({ thing, score }));
}

/** Returns the number of letters to change, omit, insert or swap between two words. */
function distance(a: string, b: string): number {
  const rows: number[][] = [Array.from({ length: b.length + 1 }, (_, j) => j)];
  for (let i = 1; i <= a.length; i += 1) {
    const [before, above] = [rows[i - 2], rows[i - 1] ?? []];
    const row = [i];
    for (let j = 1; j <= b.length; j += 1) {
      const isSame = a[i - 1] === b[j - 1];
      row[j] = Math.min((above[j] ?? 0) + 1, (row[j - 1] ?? 0) + 1, (above[j - 1] ?? 0) + (isSame ? 0 : 1));
      if (before !== undefined && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j] ?? 0, (before[j - 2] ?? 0) + 1);
    }
    rows.push(row);
  }
  return rows[a.length]?.[b.length] ?? a.length;
}

/** Returns suggestions for the search text, nearest first: unknown words are replaced by those with the most similar spelling. */
export function nearest(index: Index, typed: string, most = 3): string[] {
  const all = wordsOf(typed);
  const unknown = all.find((word) => !LIGHT.has(word) && meant(word, index.words).size === 0) ?? all.find((word) => !LIGHT.has(word));
  if (unknown === undefined) return [];
  const known = [...index.words].filter((word) => word.length >= STEM && !LIGHT.has(word) && word !== unknown);
  const near = known.map((word) => ({ word, far: distance(unknown, word) / Math.max(unknown.length, word.length) })).sort((a, b) => a.far - b.far);
  return near.slice(0, most).map(({ word }) => word);
}
