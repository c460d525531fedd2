import { describe, expect, it } from 'vitest';
import { Lesson } from '../element/lesson.js';
import type { Question } from '../element/types.js';

const option = (name: string, isRight = false) => ({ name, text: name.toUpperCase(), isRight });
const question = (atSecs: number, more: Partial<Question> = {}): Question => ({
  atSecs,
  endSecs: atSecs + 7,
  name: `q${atSecs}`,
  kind: 'choice',
  prompt: '?',
  points: 2,
  tries: 1,
  options: [option('a', true), option('b'), option('c')],
  answers: [
    { to: 'c', startSecs: atSecs + 1, endSecs: atSecs + 2 },
    { to: 'right', startSecs: atSecs + 3, endSecs: atSecs + 4 },
    { to: 'wrong', startSecs: atSecs + 5, endSecs: atSecs + 7 },
  ],
  ...more,
});

const lesson = (...questions: Question[]): Lesson => {
  const made = new Lesson();
  made.setQuestions(questions);
  return made;
};

describe('A lesson', () => {
  it('rests at a question, performs the answer that fits, and goes on', () => {
    const l = lesson(question(10));
    expect(l.pass(9.9)).toEqual({ kind: 'go' });
    expect([l.pass(10.02), l.asked?.name]).toEqual([{ kind: 'rest', atSecs: 10 }, 'q10']);
    expect(l.answer(['a'])).toEqual({ answered: { name: 'q10', given: ['a'], isRight: true, points: 2, tries: 1, isFinal: true }, turn: { kind: 'leap', toSecs: 13 } });
    expect([l.pass(13), l.pass(13.9), l.pass(14.01), l.pass(17), l.pass(18)]).toEqual([
      { kind: 'go' },
      { kind: 'go' },
      { kind: 'leap', toSecs: 17 },
      { kind: 'go' },
      { kind: 'go' },
    ]);
    expect(l.score).toEqual({ points: 2, most: 2 });
  });

  it('has the first answer that fits, and goes on at once where none does', () => {
    const turnOf = (given: string, answers = question(10).answers) => {
      const l = lesson(question(10, { answers }));
      l.pass(10);
      return l.answer([given])?.turn;
    };
    expect([turnOf('b'), turnOf('c'), turnOf('a', [])]).toEqual([
      { kind: 'leap', toSecs: 15 },
      { kind: 'leap', toSecs: 11 },
      { kind: 'leap', toSecs: 17 },
    ]);
  });

  it('asks again while there are tries, and counts all options that are right', () => {
    const l = lesson(question(10, { tries: 2, kind: 'several', options: [option('a', true), option('b', true), option('c')] }));
    l.pass(10);
    expect(l.answer(['a'])?.answered).toMatchObject({ isRight: false, isFinal: false, tries: 1 });
    expect(l.asked?.name).toBe('q10');
    expect(l.answer(['b', 'a'])?.answered).toMatchObject({ isRight: true, isFinal: true, tries: 2, points: 2 });
    expect(l.asked).toBe(undefined);
  });

  it('refuses what is no answer', () => {
    const l = lesson(question(10));
    expect(l.answer(['a'])).toBe(undefined);
    l.pass(10);
    for (const given of [[], ['x'], ['a', 'b']]) expect(l.answer(given)).toBe(undefined);
    expect(l.asked?.name).toBe('q10');
  });

  it('cannot be sought past a question that is not answered, and passes over answers that were given', () => {
    const l = lesson(question(10), question(30));
    expect(l.pass(50)).toEqual({ kind: 'rest', atSecs: 10 });
    l.answer(['b']);
    l.leave();
    expect(l.pass(50)).toEqual({ kind: 'rest', atSecs: 30 });
    expect(l.pass(5)).toEqual({ kind: 'go' });
    expect(l.asked).toBe(undefined);
    expect(l.pass(12)).toEqual({ kind: 'leap', toSecs: 17 });
  });

  it('is restored from its state, and believes no more than that', () => {
    const l = lesson(question(10), question(30));
    l.pass(10);
    l.answer(['a']);
    const state = JSON.parse(JSON.stringify(l.state())) as object[];
    const again = lesson(question(10), question(30));
    again.restore(state);
    expect([again.score, again.answered]).toEqual([l.score, l.answered]);
    again.restore([{ ...state[0], given: ['b'], points: 1000, isRight: true }]);
    expect(again.score.points).toBe(0);
    for (const wrong of [undefined, null, 7, 'x', {}, [null], [{ name: 'q10' }], [{ name: 'nobody', given: [], tries: 1 }]]) {
      again.restore(wrong);
      expect(again.state()).toEqual([]);
    }
  });
});
