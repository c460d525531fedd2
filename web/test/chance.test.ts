/** Randomness per learner: the order of options, and the items drawn from pools. */

import { describe, expect, it } from 'vitest';
import { shuffled } from '../element/lesson/chance.js';
import { Lesson } from '../element/lesson/lesson.js';
import { shownOf } from '../element/lesson/question-fields.js';
import { addressOf } from '../element/lesson/question-picture.js';
import type { Question, QuestionKind, FlowEntry } from '../element/base/questions.js';

const NAMES = ['a', 'b', 'c'];
const question = (name: string, order: number, more: Partial<Question> = {}): Question => ({
  order,
  atSecs: order,
  endSecs: order + 2,
  name,
  kind: 'choice',
  prompt: '?',
  points: 1,
  tries: 1,
  options: NAMES.map((it) => ({ name: it, text: it, isRight: it === 'a' })),
  answers: [],
  ...more,
});

describe('An order by chance', () => {
  it('is each of all as often as any other, and the same for the same seed', () => {
    const counts = new Map<string, number>();
    for (let seed = 0; seed < 6000; seed += 1) {
      const order = shuffled(NAMES, 'q', seed).join('');
      expect(shuffled(NAMES, 'q', seed).join('')).toBe(order);
      counts.set(order, (counts.get(order) ?? 0) + 1);
    }
    expect(counts.size).toBe(6);
    for (const count of counts.values()) expect(Math.abs(count - 1000)).toBeLessThan(150);
  });

  it('is asked for by the author, but for what is put together', () => {
    const orders = (kind: QuestionKind, isShuffled: boolean) => new Set(Array.from({ length: 200 }, (_, seed) => shownOf(question('q', 1, { kind, isShuffled }), seed).join('')));
    expect([...orders('choice', false)]).toEqual(['abc']);
    expect([orders('choice', true).size, orders('several', true).size, orders('point', true).size]).toEqual([6, 6, 6]);
    expect(orders('order', false).size).toBe(1);
    for (const kind of ['order', 'match'] as const) {
      expect(orders(kind, true).size).toBe(5);
      expect([...orders(kind, true), ...orders(kind, false)]).not.toContain('abc');
    }
  });
});

/** Returns a pool of five questions of three seconds each, from second 10 on, and a question after it. */
function pooled(count: number): { questions: Question[]; ways: FlowEntry[] } {
  const ways: FlowEntry[] = [{ kind: 'pool', count, order: 9, atSecs: 10, endSecs: 25 }];
  const questions: Question[] = [];
  for (let i = 0; i < 5; i += 1) {
    const [order, atSecs] = [10 + 3 * i, 10 + 3 * i];
    ways.push({ kind: 'item', pool: 9, order, atSecs, endSecs: atSecs + 3 });
    // Some questions are asked on a nested path.
    if (i % 2 === 0) questions.push(question(`q${i}`, order, { within: order, atSecs: atSecs + 1, endSecs: atSecs + 2, points: 2 }));
    else {
      ways.push({ kind: 'if', name: 'score', above: -1, order: order + 1, within: order, atSecs, endSecs: atSecs + 3 });
      questions.push(question(`q${i}`, order + 2, { within: order + 1, atSecs: atSecs + 1, endSecs: atSecs + 2, points: 2 }));
    }
  }
  questions.push(question('last', 40, { atSecs: 30, endSecs: 31 }));
  return { questions, ways };
}

function lesson(count: number, seed?: number): Lesson {
  const made = new Lesson();
  const { questions, ways } = pooled(count);
  made.setStory(questions, ways);
  if (seed !== undefined) made.restore({ seed });
  return made;
}

/** Returns the questions on the way to the end, and the shown times. */
function play(l: Lesson): { asked: string[]; shown: number[] } {
  const [asked, shown]: [string[], number[]] = [[], []];
  let secs = 0;
  for (let i = 0; i < 1000 && secs < 40; i += 1) {
    const turn = l.pass(secs);
    if (turn.kind === 'rest') {
      asked.push(l.asked?.name ?? '');
      const next = l.answer(['a'])?.turn;
      secs = next?.kind === 'leap' ? next.toSecs : turn.atSecs;
    } else if (turn.kind === 'leap') secs = turn.toSecs;
    else {
      shown.push(secs);
      secs = Math.round((secs + 0.25) * 100) / 100;
    }
  }
  return { asked, shown };
}

describe('A pool', () => {
  it('asks so many of its questions, in their order, and each of them as often as any other', () => {
    const times = new Map<string, number>();
    for (let seed = 0; seed < 1000; seed += 1) {
      const l = lesson(2, seed);
      expect(l.score).toEqual({ points: 0, most: 5 });
      const { asked, shown } = play(l);
      expect([asked.length, asked.at(-1)]).toEqual([3, 'last']);
      expect([...asked].sort()).toEqual([...asked.slice(0, 2), 'last'].sort());
      expect(asked.slice(0, 2)).toEqual([...asked.slice(0, 2)].sort());
      expect(l.score).toEqual({ points: 5, most: 5 });
      for (const name of asked) times.set(name, (times.get(name) ?? 0) + 1);
      // The other items are not shown, and nobody is required to see them.
      for (let i = 0; i < 5; i += 1) {
        const isSeen = shown.some((secs) => secs > 10 + 3 * i && secs < 13 + 3 * i);
        const isOptional = l.optional.some(([from, to]) => from <= 10 + 3 * i && to >= 13 + 3 * i);
        const isAsked = asked.includes(`q${i}`);
        // An item with a condition is optional in any case.
        expect([isSeen, isOptional]).toEqual([isAsked, !isAsked || i % 2 === 1]);
      }
    }
    for (let i = 0; i < 5; i += 1) expect(Math.abs((times.get(`q${i}`) ?? 0) - 400)).toBeLessThan(80);
  });

  it('is the same for whoever comes back, and another for a new attempt', () => {
    const first = lesson(2);
    const again = lesson(2);
    again.restore(JSON.parse(JSON.stringify(first.state())));
    expect(play(again).asked).toEqual(play(first).asked);
    const seeds = new Set(Array.from({ length: 20 }, () => lesson(2).seed));
    expect(seeds.size).toBe(20);
    first.clear();
    expect(seeds.has(first.seed)).toBe(false);
    // An invalid seed has no effect.
    const { seed } = again;
    for (const wrong of [-1, 0.5, 2 ** 32, '7', null]) again.restore({ seed: wrong });
    expect(again.seed).toBe(seed);
  });

  it('tells nothing of what is left out, however long the steps of the story are', () => {
    for (let seed = 0; seed < 50; seed += 1) {
      const l = lesson(0, seed);
      l.pass(9);
      // A frame that takes three seconds.
      let turn = l.pass(13.4);
      expect(turn).toMatchObject({ kind: 'leap', toSecs: 13 });
      turn = l.pass(16.6);
      expect(turn).toMatchObject({ kind: 'leap', toSecs: 16 });
      // A seek by the user does not jump back.
      const sought = lesson(0, seed);
      sought.seek(25.5);
      expect(sought.pass(25.5)).toEqual({ kind: 'go' });
    }
  });

  it('that is small asks all', () => {
    expect(play(lesson(9)).asked).toEqual(['q0', 'q1', 'q2', 'q3', 'q4', 'last']);
  });
});

it('A picture is a file of the story folder, whatever its name', () => {
  const story = new URL('https://a.example/stories/frog/story.eml?x=1');
  const addresses = ['a b#c?.png', 'animals/frog.png', '%2e%2e/x.png', '../../x.png', '/x.png', '//evil.example/x.png', 'javascript:x'].map((file) => addressOf(file, story));
  for (const address of addresses) expect(address.startsWith('https://a.example/stories/frog/'), address).toBe(true);
  expect(addresses.slice(0, 2)).toEqual(['https://a.example/stories/frog/a%20b%23c%3F.png', 'https://a.example/stories/frog/animals/frog.png']);
});
