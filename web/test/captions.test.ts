import { expect, test } from 'vitest';
import { captionAt, captionsOf } from '../element/captions/captions.js';
import type { Utterance } from '../element/base/types.js';

/** Returns an utterance of half a second per word, including a pause of a tenth of a second between words. */
function say(text: string, startSecs = 0): Utterance {
  const words = text.split(' ').map((word, i) => ({
    text: word,
    startSecs: startSecs + i * 0.5,
    endSecs: startSecs + i * 0.5 + 0.4,
    emphasized: false,
  }));
  return { startSecs, durationSecs: words.length * 0.5, audio: [], words, estimated: false };
}

/** Returns captions with their lines, separated by a bar. */
const shown = (utterance: Utterance, language = 'en') =>
  captionsOf([utterance], language).map(({ words, second }) =>
    [words.slice(0, second), words.slice(second)].map((line) => line.map((w) => w.text).join(' ')).filter((line) => line !== ''),
  );
const lines = (text: string, language?: string) => shown(say(text), language);

test('a short text is one caption of one line', () => {
  expect(lines('Hello world! How are you?')).toEqual([['Hello world!', 'How are you?']]);
  expect(lines('Come with me')).toEqual([['Come with me']]);
});

test('lines end at sentences, clauses and phrases', () => {
  expect(lines('Once upon a time, at the very edge of a green garden, there lived a rabbit as white as milk. One morning he went out to fetch cabbages.')).toEqual([
    ['Once upon a time,', 'at the very edge of a green garden,'],
    ['there lived a rabbit as white as milk.', 'One morning he went out to fetch cabbages.'],
  ]);
  expect(lines('He dug, and he dug, and he pulled up a fine, round cabbage, to make a pot of hot soup.')).toEqual([
    ['He dug, and he dug,'],
    ['and he pulled up a fine, round cabbage,', 'to make a pot of hot soup.'],
  ]);
  expect(lines('Doch als sie zehn Lichtjahre gewandert neben sich hin, da wards dem einsamen Paare nicht irdisch mehr zu Sinn.', 'de-DE')).toEqual([
    ['Doch als sie zehn Lichtjahre', 'gewandert neben sich hin,'],
    ['da wards dem einsamen Paare', 'nicht irdisch mehr zu Sinn.'],
  ]);
});

test('verse keeps its lines: where the voice stops, and where a line begins with a capital', () => {
  const verse = [
    'As armas e os barões assinalados',
    'que da ocidental praia lusitana',
    'por mares nunca de antes navegados',
    'passaram ainda além da Taprobana,',
    'em perigos e guerras esforçados',
    'mais do que prometia a força humana,',
  ];
  let at = 0;
  const words = verse.flatMap((line) => {
    at += 0.4;
    return line.split(' ').map((text) => ({ text, startSecs: at, endSecs: (at += 0.3), emphasized: false }));
  });
  const utterance = { startSecs: 0, durationSecs: at, audio: [], words, estimated: false, language: 'pt-PT' };
  expect(shown(utterance)).toEqual([verse.slice(0, 2), verse.slice(2, 4), verse.slice(4)]);
  expect(lines('He took his vorpal sword in hand; Long time the manxome foe he sought. So rested he by the Tumtum tree, And stood awhile in thought.')).toEqual([
    ['He took his vorpal sword in hand;', 'Long time the manxome foe he sought.'],
    ['So rested he by the Tumtum tree,', 'And stood awhile in thought.'],
  ]);
});

test('every word is in one caption, in order, and no line is longer than 42 characters unless a word is, in 500 random texts', () => {
  let state = 7;
  const random = (most: number) => Math.floor(((state = (state * 1_103_515_245 + 12_345) % 2 ** 31) / 2 ** 31) * most);
  const small = ['the', 'of', 'and', 'a', 'to'];
  for (let i = 0; i < 500; i++) {
    const word = () => (random(3) === 0 ? (small[random(5)] ?? '') : 'x'.repeat(1 + random(random(9) === 0 ? 100 : 9)));
    const text = Array.from({ length: 1 + random(80) }, () => word() + (['.', '?”', ',', ';', '…'][random(14)] ?? '')).join(' ');
    const all = lines(text);
    expect(all.flat().join(' ')).toBe(text);
    for (const caption of all) expect(caption.length).toBeLessThanOrEqual(2);
    for (const line of all.flat()) expect(line.length <= 42 || !line.includes(' ')).toBe(true);
  }
});

test('no line ends with a word that leans on the next, where another place is near', () => {
  const text = 'She walked along the river to the mill and she looked for the miller in the yard of the old house by the bridge';
  for (const line of lines(text).flat().slice(0, -1)) expect(line).not.toMatch(/ (the|a|of|to|in|for|by|and)$/);
});

test('each word is looked at a bounded number of times, however long the clause', () => {
  const looks = [20_000, 200_000].map((count) => {
    let reads = 0;
    const words = Array.from({ length: count }, (_, i) => ({
      get text() {
        reads += 1;
        return 'word';
      },
      startSecs: i,
      endSecs: i + 0.5,
      emphasized: false,
    }));
    captionsOf([{ startSecs: 0, durationSecs: count, audio: [], words, estimated: false }], 'en');
    return reads / count;
  });
  for (const each of looks) expect(each).toBeLessThan(10);
});

test('the word at a time is the one being spoken, and none in a pause', () => {
  const captions = captionsOf([say('Hello big world!', 1)], 'en');
  expect(captionAt(captions, 0.9)).toBeUndefined();
  expect([1, 1.39, 1.45, 1.5, 2.2].map((t) => captionAt(captions, t)?.word)).toEqual([0, 0, -1, 1, 2]);
});

test('a caption lingers through a breath and makes room for the next', () => {
  const captions = captionsOf([say('One.', 0), say('Two.', 1)], 'en');
  expect(captionAt(captions, 0.9)?.caption.words[0]?.text).toBe('One.');
  expect(captionAt(captions, 1)?.caption.words[0]?.text).toBe('Two.');
  expect(captionAt(captions, 9)).toBeUndefined();
});
