import { expect, test } from 'vitest';
import { MOST_CHARACTERS, told } from '../speech/told.js';

test('sentences follow each other, and a greeting is waved', () => {
  const script = told('Hello there! Shall I tell you a secret?') ?? '';
  expect(script.match(/<voice-text/g)).toHaveLength(2);
  expect(script).toMatch(/time="e0\+0\.35s" timeId="v1"/);
  // The greeting's hand is the right one, beats are of both.
  expect(script).toMatch(/<tm name="g0w0"\/>Hello/);
  expect(script).toContain('handedness="right"');
  expect(script).toMatch(/<null time="e1\+1\.2s"\/>/);
});

test('smileys are felt and not said, each for its sentence', () => {
  const script = told('You came! :) I waited all day. :( Well…') ?? '';
  expect(script).not.toMatch(/[:;]-?[()]/);
  expect([...script.matchAll(/type="(\w+)"( potential="4")?\/>/g)].map(([, type]) => type)).toEqual(['joy', 'distress', 'neutral']);
});

test('large letters are stressed and said as words', () => {
  expect(told('It was SO dark and A cat came')).toMatch(/<emph>so<\/emph>/);
  expect(told('A NASA-free day')).not.toContain('<emph>a</emph>');
});

test('what is no text tells nothing', () => {
  for (const text of ['', '   ', '!!!', ':)', '…\n\n']) expect(told(text), text).toBeUndefined();
});

test('markup, long and strange texts stay text', () => {
  const script = told(`<voice-say content="x"/> & "quotes" ]]> &amp; \u202eabc 🙂🙂 ﷽ ${'word '.repeat(5000)}`) ?? '';
  expect(script).not.toContain('<voice-say');
  expect(script.length).toBeLessThan(40 * MOST_CHARACTERS);
  expect(script).not.toContain('🙂');
});

test('a text between the tags is longer than one that somebody types, and whole', () => {
  const text = Array.from({ length: 400 }, (_, i) => `Number ${i} came.`).join(' ');
  expect(told(text, { most: 100_000 })?.match(/<voice-text/g)).toHaveLength(400);
  expect(told(text)?.match(/<voice-text/g)?.length).toBeLessThan(60);
});
