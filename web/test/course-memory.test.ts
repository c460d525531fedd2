/** Text that restores learners' progress: its contents for every storage limit of a system. */

import { describe, expect, it } from 'vitest';
import { joined, NOTHING, readMemory, writeMemory, type Memory, type Remembered } from '../course/memory.js';
import { MAX_MEMORY } from '../course/scorm.js';
import { shareOf } from '../course/seen.js';
import { lengthOf, united, type Span } from '../element/base/ranges.js';
import { random, randomText, type Next } from './course-questions.js';
import { sized } from './tier.js';

const pointsOf = ({ answered }: Memory): number => answered.reduce((sum, { points = 0 }) => sum + points, 0);

function randomAnswer(next: Next, name: string): Remembered {
  const isRight = next() < 0.5;
  const given = Array.from({ length: 1 + Math.floor(4 * next()) }, () =>
    randomText(next)
      .slice(0, 10_000)
      .replaceAll(/\p{Surrogate}/gu, '\uFFFD'),
  );
  return { name, given, tries: 1 + Math.floor(3 * next()), isRight, points: isRight ? 1 + Math.floor(5 * next()) : 0, isFinal: isRight || next() < 0.5, fits: [] };
}

const randomSpans = (next: Next, most: number): Span[] =>
  united(Array.from({ length: Math.floor(most * next()) }, () => 10_000 * next()).map((from): Span => [from, from + 5 * next()]));

const randomMemory = (next: Next, most: number): Memory => ({
  placeSecs: 10_000 * next(),
  seen: randomSpans(next, 400),
  answered: Array.from({ length: Math.floor(most * next()) }, (_, i) => randomAnswer(next, `question ${i}`)),
  more: { furthestSecs: 5, values: { x: 1 }, done: [1, 2], skipped: [] },
  attempt: 1 + Math.floor(3 * next()),
  session: Math.floor(9 * next()),
  best: next() < 0.3 ? { points: 1, most: 4 } : undefined,
});

describe('A memory', () => {
  it('is read as it was written', () => {
    const next = random(7);
    for (let i = 0; i < 300; i++) {
      const memory = randomMemory(next, 12);
      const text = writeMemory(memory);
      const read = readMemory(text);
      expect(writeMemory(read)).toBe(text);
      expect(read.answered.map(({ name, given, tries }) => [name, given, tries])).toEqual(memory.answered.map(({ name, given, tries }) => [name, given, tries]));
      expect([pointsOf(read), read.more, read.attempt, read.session, read.best]).toEqual([pointsOf(memory), memory.more, memory.attempt, memory.session, memory.best]);
      expect(shareOf(read.seen, 10_000)).toBeLessThanOrEqual(shareOf(memory.seen, 10_000));
    }
  });

  it(`of up to 120 questions has room in every system, and no point of ${sized(150, 1000)} random learners is lost`, () => {
    const next = random(3);
    for (let i = 0; i < sized(150, 1000); i++) {
      const memory = randomMemory(next, 120);
      const text = writeMemory(memory, MAX_MEMORY);
      expect(text.length).toBeLessThanOrEqual(MAX_MEMORY);
      expect(text).toMatch(/^[\u0020-\uFFFF]*$/);
      const read = readMemory(text);
      expect(pointsOf(read)).toBe(pointsOf(memory));
      expect(read.answered.map(({ name, tries, isRight = false, isFinal = false }) => [name, tries, isRight, isFinal])).toEqual(
        memory.answered.map(({ name, tries, isRight, isFinal, given = [] }) => [name, tries, isRight, isFinal && (isRight || given.length >= 0)]),
      );
      expect(lengthOf(read.seen)).toBeLessThanOrEqual(lengthOf(memory.seen));
    }
  });

  it('is none where there is no room at all', () => {
    const memory = randomMemory(random(1), 50);
    expect(readMemory(writeMemory(memory, 10))).toEqual(NOTHING);
    for (const most of [60, 100, 300, 1000]) expect(writeMemory(memory, most).length).toBeLessThanOrEqual(most);
  });

  it('of another kind is none', () => {
    const broken = ['', 'x', '[]', '{}', 'null', 'z:', 'z:!', 'z:AAAA', '{"v":3,"at":1,"seen":[]}', '{"v":1,"at":1,"seen":[1]}', '{"v":1,"at":1,"seen":[1,"2"]}'];
    for (const text of [...broken, '{"v":1,"at":1,"seen":[-1,2]}', `{"v":1,"seen":[${'0,1,'.repeat(300)}0,1]}`]) expect(readMemory(text)).toEqual(NOTHING);
    // One of an earlier version is read.
    expect(readMemory('{"v":1,"at":-5,"seen":[3,1,2,4],"answered":[{"name":"a","given":["x"],"tries":1},7,{}]}')).toEqual({
      ...NOTHING,
      seen: [[2, 4]],
      answered: [{ name: 'a', given: ['x'], tries: 1 }],
    });
  });

  it('of two keeps all that was seen and the better answers, of the later attempt', () => {
    const answer = (name: string, points: number, given = 'x'): Remembered => ({ name, given: [given], tries: 1, points, isRight: points > 0, isFinal: true, fits: [] });
    const ours: Memory = { ...NOTHING, session: 2, placeSecs: 9, seen: [[0, 9]], answered: [answer('a', 1), answer('b', 0, 'ours')] };
    const theirs: Memory = { ...NOTHING, session: 5, placeSecs: 4, seen: [[20, 30]], answered: [answer('b', 0, 'theirs'), answer('c', 2)], best: { points: 1, most: 9 } };
    const both = joined(ours, theirs);
    expect([both.placeSecs, both.session, both.seen, both.best]).toEqual([
      4,
      5,
      [
        [0, 9],
        [20, 30],
      ],
      { points: 1, most: 9 },
    ]);
    expect(both.answered.map(({ name, points, given }) => [name, points, given?.[0]])).toEqual(
      [
        ['b', 0, 'theirs'],
        ['c', 2, 'x'],
        ['a', 1, 'x'],
      ].sort(),
    );
    expect(joined({ ...ours, attempt: 2 }, theirs)).toMatchObject({ attempt: 2, session: 5, placeSecs: 9, answered: [{ name: 'a' }, { name: 'b' }] });
  });
});
