/** Points of partly correct answers, and the feedback on answers. */

import { describe, expect, it } from 'vitest';
import { pointsOf } from '../element/lesson/credit.js';
import { feedbackOf, rightAnswer } from '../element/lesson/feedback.js';
import { judge } from '../element/lesson/judge.js';
import { Lesson, LIVE } from '../element/lesson/lesson.js';
import { wordsOf } from '../element/lesson/question-words.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';
import { KINDS, random, randomGiven, randomQuestion } from './course-questions.js';
import { sized } from './tier.js';

const option = (name: string, more: Partial<QuestionOption> = {}): QuestionOption => ({ name, text: name.toUpperCase(), isRight: false, ...more });
const question = (kind: QuestionKind, options: readonly QuestionOption[], more: Partial<Question> = {}): Question => ({
  order: 1,
  atSecs: 1,
  endSecs: 2,
  name: 'q',
  kind,
  prompt: '?',
  points: 4,
  tries: 1,
  isPartial: true,
  options,
  answers: [],
  ...more,
});
const reached = (asked: Question, ...given: string[]): number | undefined => {
  const judged = judge(asked, given);
  return judged && pointsOf(asked, judged);
};

describe('An answer that is right in part', () => {
  it('counts what is right of several less what is wrong', () => {
    const asked = question('several', [option('a', { isRight: true }), option('b', { isRight: true }), option('c'), option('d')]);
    expect([['a', 'b'], ['a'], ['a', 'c'], ['a', 'b', 'c'], ['a', 'b', 'c', 'd'], ['c', 'd']].map((given) => reached(asked, ...given))).toEqual([4, 2, 0, 2, 0, 0]);
    expect(reached({ ...asked, isPartial: false }, 'a')).toBe(0);
  });

  it('counts the pairs, gaps and neighbours that are right', () => {
    const match = question('match', [option('a', { partner: 'X' }), option('b', { partner: 'Y' }), option('c', { partner: 'X' })]);
    expect([reached(match, 'c', 'b', 'a'), reached(match, 'c', 'a', ''), reached(match, 'b', 'a', 'b')]).toEqual([4, 1.33, 0]);
    const gap = question('gap', [option('a', { accepts: ['frog'] }), option('b', { accepts: ['leaf', 'pond'] })], { prompt: '[a] [b]' });
    expect([reached(gap, 'Frog', ''), reached(gap, '', 'pond'), reached(gap, 'frog', 'leaf')]).toEqual([2, 2, 4]);
    const order = question('order', [option('a'), option('b'), option('c'), option('d'), option('e')]);
    expect([reached(order, 'b', 'c', 'd', 'e', 'a'), reached(order, 'e', 'd', 'c', 'b', 'a')]).toEqual([3, 0]);
  });

  it('is kept, counted, and counted anew as it is restored', () => {
    const asked = question('several', [option('a', { isRight: true }), option('b', { isRight: true }), option('c')], { tries: 2 });
    const lesson = new Lesson();
    lesson.setStory([asked], []);
    lesson.pass(1);
    expect(lesson.answer(['a'])?.answered).toMatchObject({ isRight: false, points: 2, isFinal: false });
    expect(lesson.answer(['b'])?.answered).toMatchObject({ isRight: false, points: 2, isFinal: true });
    const again = new Lesson();
    again.setStory([asked], []);
    again.restore(JSON.parse(JSON.stringify({ ...lesson.state(), answered: lesson.answered.map((it) => ({ ...it, points: 1000 })) })));
    expect(again.score).toEqual({ points: 2, most: 4 });
  });

  it(`counts from nothing to all, and all where it is right alone (${sized(4000, 100_000)} answers)`, () => {
    const next = random(7);
    let parts = 0;
    for (let i = 0; i < sized(4000, 100_000); i++) {
      const made = randomQuestion(next, 'q', KINDS[i % KINDS.length]);
      const asked: Question = { ...made, isPartial: next() < 0.8 };
      const right = made.kind === 'gap' ? made.options.map(({ accepts }) => accepts?.[0] ?? '') : made.options.map(({ name }) => name);
      // Many answers by chance are wrong altogether: these are right but for some of it.
      const given = next() < 0.5 ? randomGiven(next, made) : right.map((it, at) => (made.kind !== 'order' && next() < 0.3 ? (right[at - 1] ?? it) : it));
      const judged = judge(asked, given);
      if (judged === undefined) continue;
      const points = pointsOf(asked, judged);
      expect(points >= 0 && points <= asked.points, `${i}: ${points} of ${asked.points}`).toBe(true);
      if (asked.points > 0) expect(points === asked.points, `${i}: ${points} of ${asked.points}`).toBe(judged.isRight === true);
      if (asked.isPartial !== true && judged.isRight !== true) expect(points).toBe(0);
      if (points > 0 && points < asked.points) parts += 1;
    }
    expect(parts).toBeGreaterThan(100);
  });
});

const EN = wordsOf('en');
const choice = question('choice', [option('a', { isRight: true }), option('b')], { isPartial: false });

function read(asked: Question, given: readonly string[] | undefined, language = 'en'): string {
  const lesson = new Lesson();
  lesson.setStory([asked], []);
  lesson.pass(1);
  const taken = given === undefined ? lesson.expire() : lesson.answer(given);
  return taken === undefined ? '' : feedbackOf(taken, wordsOf(language));
}

describe('What is read of an answer', () => {
  it('is whether it was right, and what is right, in the language of the story', () => {
    expect([read(choice, ['a']), read(choice, ['b']), read(choice, undefined)]).toEqual([
      'That is right.',
      'That is not right. Correct answer: A',
      'Time is up. Correct answer: A',
    ]);
    for (const [language, tag] of [
      ['de', 'de-AT'],
      ['pt', 'pt'],
    ] as const) {
      const { wrong, rightIs } = wordsOf(language);
      expect(read(choice, ['b'], tag)).toBe(`${wrong} ${rightIs('A')}`);
      expect(wrong).not.toBe(EN.wrong);
    }
    const several = question('several', [option('a', { isRight: true }), option('b', { isRight: true }), option('c')]);
    expect(read(several, ['a'])).toBe('That is partly right: 2 of 4 points. Correct answer: A; B');
    expect(read({ ...choice, isUngraded: true, points: 0 }, ['b'])).toBe('Thank you.');
    expect(read({ ...choice, tries: 2 }, ['b'])).toBe('');
  });

  it('is what the author wrote', () => {
    const feedback = { any: 'Frogs sing.', right: 'Well heard!' };
    expect([read({ ...choice, feedback }, ['a']), read({ ...choice, feedback }, ['b'])]).toEqual(['Well heard!', 'Frogs sing.']);
    const answers = [{ order: 2, to: 'right', startSecs: 1, endSecs: 2 }];
    expect(read({ ...choice, answers, feedback }, ['a'])).toBe('Well heard!');
  });

  it('is nothing where the story or whoever asks says something', () => {
    const answers = [{ order: 2, to: 'right', startSecs: 1, endSecs: 2 }];
    expect([read({ ...choice, answers }, ['a']), read({ ...choice, answers }, ['b'])]).toEqual(['', 'That is not right. Correct answer: A']);
    expect(read({ ...choice, order: LIVE }, ['b'])).toBe('');
  });

  it('says what is right of each kind', () => {
    const right = { isRight: true };
    const all: readonly (readonly [Question, string])[] = [
      [question('point', [option('a', right), option('b')]), 'A'],
      [question('order', [option('a'), option('b')]), '1. A 2. B'],
      [question('match', [option('a', { partner: 'X' }), option('b', { partner: 'Y' })]), 'A – X; B – Y'],
      [question('gap', [option('who', { accepts: ['frog', 'toad'] })], { prompt: 'The [who] sang.' }), 'The frog sang.'],
      [
        question('number', [
          option('a', { ...right, least: 2, most: 2 }),
          option('b', { ...right, least: 5 }),
          option('c', { ...right, most: -1 }),
          option('d', { ...right, least: 3, most: 4 }),
        ]),
        '2; at least 5; at most -1; 3 to 4',
      ],
      [question('text', [option('a', { ...right, accepts: ['cold', 'winter'] }), option('b', { accepts: ['x'] })]), 'cold'],
      [question('text', [option('a', { ...right, rejects: ['x'] })]), ''],
    ];
    for (const [asked, text] of all) expect(rightAnswer(asked, EN), asked.kind).toBe(text);
  });
});
