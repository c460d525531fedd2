import { expect, test } from 'vitest';
import { captionAt, captionsOf } from '../element/captions.js';
import type { Utterance } from '../element/types.js';

/** An utterance of half a second a word, with a pause of a tenth between words. */
function say(text: string, startSecs = 0): Utterance {
  const words = text.split(' ').map((word, i) => ({
    text: word,
    startSecs: startSecs + i * 0.5,
    endSecs: startSecs + i * 0.5 + 0.4,
    emphasized: false,
  }));
  return { startSecs, durationSecs: words.length * 0.5, audio: [], words, estimated: false };
}

const lines = (text: string) => captionsOf([say(text)]).map((c) => c.words.map((w) => w.text).join(' '));

test('a short text is one caption', () => {
  expect(lines('Hello world! How are you?')).toEqual(['Hello world! How are you?']);
});

test('captions end at sentences and commas where they can', () => {
  expect(lines('Once upon a time, at the very edge of a green garden, there lived a rabbit as white as milk. One morning he went out to fetch cabbages.')).toEqual([
    'Once upon a time, at the very edge of a green garden,',
    'there lived a rabbit as white as milk.',
    'One morning he went out to fetch cabbages.',
  ]);
});

test('no caption is longer than two lines, even without punctuation', () => {
  const all = lines(Array.from({ length: 60 }, (_, i) => `word${i}`).join(' '));
  expect(all.join(' ').split(' ')).toHaveLength(60);
  for (const line of all) expect(line.length).toBeLessThanOrEqual(84);
});

/** What the captions of earlier versions were, one word after another: slow, and right. */
function slowly(words: readonly { text: string }[]): string[] {
  const ends = (text: string) => /[.!?…]["'”’)]*$/.test(text);
  const lines: string[] = [];
  let line: string[] = [];
  words.forEach(({ text }, i) => {
    const together = (more: string) => [...line, more].join(' ').length;
    if (line.length > 0 && together(text) > 84) line = lines.push(line.join(' ')) > 0 ? [] : line;
    line.push(text);
    const rest = words.slice(i + 1);
    const sentence = rest.slice(0, rest.findIndex((w) => ends(w.text)) + 1 || rest.length).map((w) => w.text);
    const length = line.join(' ').length;
    const alone = length >= 32 || length + 1 + sentence.join(' ').length > 84;
    if ((ends(text) && alone) || (/[,;:–—]["'”’)]*$/.test(text) && length >= 42)) line = lines.push(line.join(' ')) > 0 ? [] : line;
  });
  return line.length > 0 ? [...lines, line.join(' ')] : lines;
}

test('lines are the same as when each is looked for by itself, in 500 random texts', () => {
  let state = 7;
  const random = (most: number) => Math.floor(((state = (state * 1_103_515_245 + 12_345) % 2 ** 31) / 2 ** 31) * most);
  for (let i = 0; i < 500; i++) {
    const text = Array.from({ length: 1 + random(80) }, () => 'x'.repeat(1 + random(random(9) === 0 ? 100 : 9)) + (['.', '?”', ',', ';', '…'][random(14)] ?? '')).join(' ');
    expect(lines(text)).toEqual(slowly(text.split(' ').map((word) => ({ text: word }))));
  }
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
    captionsOf([{ startSecs: 0, durationSecs: count, audio: [], words, estimated: false }]);
    return reads / count;
  });
  for (const each of looks) expect(each).toBeLessThan(10);
});

test('the word at a time is the one being spoken, and none in a pause', () => {
  const captions = captionsOf([say('Hello big world!', 1)]);
  expect(captionAt(captions, 0.9)).toBeUndefined();
  expect([1, 1.39, 1.45, 1.5, 2.2].map((t) => captionAt(captions, t)?.word)).toEqual([0, 0, -1, 1, 2]);
});

test('a caption lingers through a breath and makes room for the next', () => {
  const captions = captionsOf([say('One.', 0), say('Two.', 1)]);
  expect(captionAt(captions, 0.9)?.caption.words[0]?.text).toBe('One.');
  expect(captionAt(captions, 1)?.caption.words[0]?.text).toBe('Two.');
  expect(captionAt(captions, 9)).toBeUndefined();
});
