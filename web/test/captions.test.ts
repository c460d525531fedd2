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
  expect(
    lines(
      'Once upon a time, at the very edge of a green garden, there lived a rabbit as white as milk. One morning he went out to fetch cabbages.',
    ),
  ).toEqual([
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
