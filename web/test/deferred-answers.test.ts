import { expect, test } from 'vitest';
import { DeferredAnswers } from '../speech/deferred-answers.js';

test('an answer is there when it is asked for again, and is made once', async () => {
  const later = new DeferredAnswers<string>();
  let made = 0;
  const ask = (question: string) =>
    later.ask(question, () => {
      made += 1;
      return Promise.resolve(question.toUpperCase());
    });
  expect(ask('a')).toBeUndefined();
  // Another question waits its turn.
  expect(ask('b')).toBeUndefined();
  await later.pending();
  expect([ask('a'), made, later.pending()]).toEqual(['A', 1, undefined]);
  expect(ask('b')).toBeUndefined();
  await later.pending();
  expect([ask('b'), ask('a'), made]).toEqual(['B', 'A', 2]);
});

test('what fails is thrown once, and may be asked for anew', async () => {
  const later = new DeferredAnswers<number>();
  later.ask('x', () => Promise.reject(new Error('away')));
  await later.pending();
  expect(() => later.ask('x', () => Promise.resolve(1))).toThrow('away');
  expect(later.ask('x', () => Promise.resolve(1))).toBeUndefined();
  await later.pending();
  expect(later.ask('x', () => Promise.resolve(2))).toBe(1);
});

test('old answers are let go', async () => {
  const later = new DeferredAnswers<number>();
  let made = 0;
  for (let i = 0; i < 100; i++) {
    later.ask(String(i), () => Promise.resolve(made++));
    await later.pending();
  }
  expect(later.ask('99', () => Promise.resolve(-1))).toBe(99);
  expect(later.ask('0', () => Promise.resolve(-1))).toBeUndefined();
});

test('what is not wanted any more is ended, and keeps nobody waiting', async () => {
  const later = new DeferredAnswers<string>();
  let ended = false;
  later.ask('slow', (signal) => {
    signal.addEventListener('abort', () => (ended = true));
    return new Promise((_, reject) => signal.addEventListener('abort', () => reject(signal.reason as Error)));
  });
  later.forget();
  expect([ended, later.pending()]).toEqual([true, undefined]);
  expect(later.ask('next', () => Promise.resolve('said'))).toBeUndefined();
  await later.pending();
  // The failure of another request does not affect this one.
  expect(later.ask('next', () => Promise.resolve(''))).toBe('said');
});
