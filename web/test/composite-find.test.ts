/** Searches with plain words find their targets. The queries were written before the word table. */

import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { indexOf, nearest, search, tableOf, type FinderMatch } from '../composite/find.js';
import { BEARDS, HAIR, MARKS, WEAR } from '../composite/look.js';
import table from '../composite/words.tsv?raw';

/** Returns the attributes of the pack, as in the source of its labels. */
function attributes(): Parameters<typeof indexOf>[0] {
  const source = readFileSync(new URL('../../crate/sculpt/src/labels.rs', import.meta.url), 'utf8');
  const labels = source.matchAll(/label\((?:"([\w ]+)"|LIFE), "([\w ]+)", \["([\w ]+)", "([\w ]+)"\], (Both|Shape|Texture)/g);
  return [...labels].flatMap(([, group = 'life', name = '', less = '', more = '', affects]) =>
    (['shape', 'texture'] as const)
      .filter((part) => affects === 'Both' || affects?.toLowerCase() === part)
      .map((part) => ({ part, group, name, terms: [less, more] as const, derived: null })),
  );
}

const index = indexOf(attributes());
const first = (typed: string): string | undefined => search(index, typed)[0]?.thing;
const all = (typed: string): string[] => search(index, typed).map(({ thing }: FinderMatch) => thing);

/** Queries by someone who has never seen the editor, and the intended result. */
const MEANT: readonly (readonly [typed: string, thing: string])[] = [
  ['friendly', 'feature smiling'],
  ['moustache', 'beard moustache'],
  ['mustache', 'beard moustache'],
  ['grey moustache', 'beard moustache'],
  ['hair', 'style Hair'],
  ['hair colour', 'style Hair'],
  ['blond', 'style Hair'],
  ['glasses', 'worn round-glasses'],
  ['spectacles', 'worn round-glasses'],
  ['bald', 'hair bald'],
  ['no hair', 'hair none'],
  ['long hair', 'hair long'],
  ['bun', 'hair bun'],
  ['fat', 'feature weight'],
  ['skinny', 'feature weight'],
  ['bags under the eyes', 'feature ageing'],
  ['wrinkles', 'feature ageing'],
  ['eyes wider apart', 'feature distance of the eyes'],
  ['close-set eyes', 'feature distance of the eyes'],
  ['big eyes', 'feature opening of the eyes'],
  ['eye colour', 'feature colour of the iris'],
  ['blue eyes', 'feature colour of the iris'],
  ['slanted eyes', 'feature inclination of the eyes'],
  ['eyebrows', 'feature thickness of the brows'],
  ['bushy eyebrows', 'feature thickness of the brows'],
  ['wider nose', 'feature breadth of the alar wings'],
  ['hook nose', 'feature profile of the nose'],
  ['pug nose', 'feature profile of the nose'],
  ['nostrils', 'feature breadth of the alar wings'],
  ['bigger mouth', 'feature width of the mouth'],
  ['thick lips', 'feature lips'],
  ['lipstick', 'feature colour of the lips'],
  ['double chin', 'feature double chin'],
  ['weak chin', 'feature protrusion of the chin'],
  ['square jaw', 'feature angles of the face'],
  ['chubby cheeks', 'feature cheeks'],
  ['high cheekbones', 'feature cheekbones'],
  ['ears stick out', 'feature ears'],
  ['older', 'feature age'],
  ['man', 'feature sex'],
  ['more masculine', 'feature sex'],
  ['tan', 'feature lightness of the skin'],
  ['black skin', 'feature lightness of the skin'],
  ['chinese', 'feature Asian'],
  ['stubble', 'feature beard shadow'],
  ['pretty', 'feature attractiveness'],
  ['crazy', 'feature deranged'],
  ['scar', 'mark scar'],
  ['tattoo', 'mark tattoo'],
  ['mole', 'mark mole'],
  ['piercing', 'worn nose-stud'],
  ['beanie', 'worn knitted-cap'],
  ['hijab', 'worn headscarf'],
  ['earring', 'worn ear-rings'],
  ['pdf', 'tab pictures'],
  ['undo', 'tab history'],
  ['bigode', 'beard moustache'],
  ['óculos', 'worn round-glasses'],
  ['careca', 'hair bald'],
  ['gordo', 'feature weight'],
  ['olheiras', 'feature ageing'],
  ['nariz grande', 'feature breadth of the alar wings'],
  ['olhos mais afastados', 'feature distance of the eyes'],
  ['sardas', 'feature freckles'],
  ['simpático', 'feature smiling'],
  ['cicatriz', 'mark scar'],
  ['orelhas de abano', 'feature ears'],
  ['boca maior', 'feature width of the mouth'],
  ['barba', 'beard full'],
  ['chapéu', 'worn hat'],
  ['Schnurrbart', 'beard moustache'],
  ['Brille', 'worn round-glasses'],
  ['Glatze', 'hair bald'],
  ['dick', 'feature weight'],
  ['Tränensäcke', 'feature ageing'],
  ['Augen weiter auseinander', 'feature distance of the eyes'],
  ['Sommersprossen', 'feature freckles'],
  ['freundlich', 'feature smiling'],
  ['Narbe', 'mark scar'],
  ['größere Nase', 'feature breadth of the alar wings'],
  ['volle Lippen', 'feature lips'],
  ['Segelohren', 'feature ears'],
  ['Doppelkinn', 'feature double chin'],
  ['älter', 'feature age'],
];

test('what a layman types is found first', () => {
  const wrong = MEANT.flatMap(([typed, thing]) => (first(typed) === thing ? [] : [`${typed}: ${first(typed)}, not ${thing}`]));
  expect(wrong).toEqual([]);
});

test('a whole word is no beginning of another, accents and cases make no difference', () => {
  expect(all('scar')).toEqual(['mark scar']);
  expect(all('SCARED')).toContain('feature scared');
  // An incomplete word matches both.
  expect(all('sca')).toEqual(expect.arrayContaining(['mark scar', 'feature scared', 'worn headscarf']));
  expect(all('oculos')).toEqual(all('Óculos'));
  expect(all('grosse nase')).toEqual(all('große Nase'));
  expect(all('ear')).not.toContain('beard full');
  expect(all('freckl')[0]).toBe('feature freckles');
});

test('words of direction do not keep from finding, and a whole description finds each of its parts', () => {
  for (const typed of ['nose', 'wider nose', 'a much bigger nose', 'his nose is too long']) expect(all(typed), typed).toContain('feature length of the nose');
  expect(all('an old man with a broad nose and a grey moustache')).toEqual(
    expect.arrayContaining(['feature sex', 'feature age', 'feature breadth of the alar wings', 'beard moustache']),
  );
  expect(all('long mouth')).not.toContain('feature length of the nose');
});

test('where nothing is found, what is written most like it is proposed', () => {
  for (const [typed, meant] of [
    ['mustosh', 'mustache'],
    ['freqkles', 'freckles'],
    ['cheakbones', 'cheekbones'],
    ['wrinckle', 'wrinkled'],
    ['bigod', 'bigode'],
  ] as const) {
    const found = search(index, typed).length > 0 ? search(index, typed)[0]?.thing : nearest(index, typed);
    if (typeof found === 'string') expect(found, typed).toBe('beard moustache');
    else expect(found, typed).toContain(meant);
  }
  expect(all('xqzw')).toEqual([]);
  expect(nearest(index, 'xqzw')).toHaveLength(3);
  expect(all('   ')).toEqual([]);
});

test('every feature, style, thing worn, mark and panel has words in three languages, and no line is of something else', () => {
  const rows = tableOf(table);
  const there = [
    ...attributes().map(({ name }) => `feature ${name}`),
    ...Object.keys(HAIR).map((key) => `hair ${key}`),
    ...Object.keys(BEARDS).map((key) => `beard ${key}`),
    ...Object.keys(WEAR).map((key) => `worn ${key}`),
    ...Object.keys(MARKS).map((key) => `mark ${key}`),
  ];
  const known = rows.map(({ thing }) => thing as string);
  expect(new Set(known).size).toBe(known.length);
  // Hair styles have no terms of their own if their name is sufficient.
  for (const thing of there.filter((one) => !/^(hair|beard) /.test(one))) expect(known).toContain(thing);
  for (const thing of known.filter((one) => !/^(style|tab|light) /.test(one))) expect(there).toContain(thing);
  for (const line of table.split('\n').slice(1, -1)) expect(line.split('\t'), line).toHaveLength(5);
  expect(rows.flatMap(({ called }) => called).length).toBeGreaterThan(900);
});
