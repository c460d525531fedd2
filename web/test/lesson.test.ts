import { describe, expect, it } from 'vitest';
import { Lesson, type FlowTurn } from '../element/lesson/lesson.js';
import type { Question, FlowEntry } from '../element/base/questions.js';

const option = (name: string, isRight = false) => ({ name, text: name.toUpperCase(), isRight });
/** Returns a question followed by its answers. */
const question = (atSecs: number, more: Partial<Question> = {}): Question => ({
  order: atSecs * 10,
  atSecs,
  endSecs: atSecs + 7,
  name: `q${atSecs}`,
  kind: 'choice',
  prompt: '?',
  points: 2,
  tries: 1,
  options: [option('a', true), option('b'), option('c')],
  answers: [
    { order: atSecs * 10 + 1, to: 'c', startSecs: atSecs + 1, endSecs: atSecs + 2 },
    { order: atSecs * 10 + 3, to: 'right', startSecs: atSecs + 3, endSecs: atSecs + 4 },
    { order: atSecs * 10 + 5, to: 'wrong', startSecs: atSecs + 5, endSecs: atSecs + 7 },
  ],
  ...more,
});

/** Returns a branch from a given time. */
const way = (atSecs: number, endSecs: number, what: object, within?: number): FlowEntry =>
  ({ order: atSecs * 10, atSecs, endSecs, ...(within === undefined ? {} : { within }), ...what }) as FlowEntry;
const set = (atSecs: number, name: string, what: object, within?: number) => way(atSecs, atSecs, { kind: 'set', name, ...what }, within);
const when = (atSecs: number, endSecs: number, name: string, what: object, within?: number) => way(atSecs, endSecs, { kind: 'if', name, ...what }, within);
const goto = (atSecs: number, to: string, within?: number) => way(atSecs, atSecs, { kind: 'goto', to }, within);
const part = (atSecs: number, endSecs: number, name: string) => way(atSecs, endSecs, { kind: 'part', name, title: name });

function lesson(questions: readonly Question[], ways: readonly FlowEntry[] = []): Lesson {
  const made = new Lesson();
  made.setStory(questions, ways);
  return made;
}

/** Plays in steps until a question or an end; returns the shown times. */
function play(l: Lesson, fromSecs: number, endSecs: number): { shown: number[]; secs: number; turn: FlowTurn } {
  const shown: number[] = [];
  let secs = fromSecs;
  for (let i = 0; i < 10_000 && secs <= endSecs; i += 1) {
    const turn = l.pass(secs);
    if (turn.kind === 'rest') return { shown, secs: turn.atSecs, turn };
    if (turn.kind === 'leap') {
      secs = turn.toSecs;
      continue;
    }
    shown.push(secs);
    secs = Math.round((secs + 0.25) * 1000) / 1000;
  }
  return { shown, secs, turn: { kind: 'go' } };
}

/** Answers, and follows the continuation. */
function answer(l: Lesson, ...given: string[]): number {
  const turn = l.answer(given)?.turn;
  return turn?.kind === 'leap' ? turn.toSecs : Number.NaN;
}

const within = (shown: readonly number[], from: number, to: number) => shown.filter((secs) => secs >= from && secs < to);

describe('A lesson', () => {
  it('rests at a question, performs the answer that fits, and goes on', () => {
    const l = lesson([question(10)]);
    expect(l.pass(9.9)).toEqual({ kind: 'go' });
    expect([l.pass(10.02), l.asked?.name]).toEqual([{ kind: 'rest', atSecs: 10 }, 'q10']);
    expect(l.answer(['a'])).toMatchObject({
      answered: { name: 'q10', given: ['a'], fits: ['a'], isRight: true, points: 2, tries: 1, isFinal: true },
      turn: { kind: 'leap', fromSecs: 10, toSecs: 13 },
    });
    expect([l.pass(13), l.pass(13.9), l.pass(14.01), l.pass(17), l.pass(18)]).toEqual([
      { kind: 'go' },
      { kind: 'go' },
      { kind: 'leap', fromSecs: 14, toSecs: 17 },
      { kind: 'go' },
      { kind: 'go' },
    ]);
    expect(l.score).toEqual({ points: 2, most: 2 });
  });

  it('has the first answer that fits, and goes on at once where none does', () => {
    const to = (given: string, answers = question(10).answers) => {
      const l = lesson([question(10, { answers })]);
      l.pass(10);
      return answer(l, given);
    };
    expect([to('b'), to('c'), to('a', [])]).toEqual([15, 11, 17]);
  });

  it('asks again while there are tries, and counts all options that are right', () => {
    const l = lesson([question(10, { tries: 2, kind: 'several', options: [option('a', true), option('b', true), option('c')] })]);
    l.pass(10);
    expect(l.answer(['a'])?.answered).toMatchObject({ isRight: false, isFinal: false, tries: 1 });
    expect(l.asked?.name).toBe('q10');
    expect(l.answer(['b', 'a'])?.answered).toMatchObject({ isRight: true, isFinal: true, tries: 2, points: 2 });
    expect(l.asked).toBe(undefined);
  });

  it('refuses what is no answer', () => {
    const l = lesson([question(10)]);
    expect(l.answer(['a'])).toBe(undefined);
    l.pass(10);
    for (const given of [[], ['x'], ['a', 'b']]) expect(l.answer(given)).toBe(undefined);
    expect(l.asked?.name).toBe('q10');
  });

  it('takes no answer once the time is over', () => {
    const l = lesson([question(10, { tries: 3 })]);
    expect(l.expire()).toBe(undefined);
    l.pass(10);
    expect(l.expire()).toMatchObject({ answered: { given: [], isRight: false, isFinal: true, tries: 1 }, turn: { toSecs: 15 } });
    const again = lesson([question(10, { tries: 3 })]);
    again.restore(JSON.parse(JSON.stringify(l.state())));
    expect(again.answered).toEqual(l.answered);
  });

  it('cannot be sought past a question that is not answered, and passes over answers that were given', () => {
    const l = lesson([question(10), question(30)]);
    l.seek(50);
    expect(l.pass(50)).toEqual({ kind: 'rest', atSecs: 10 });
    answer(l, 'b');
    l.seek(50);
    expect(l.pass(50)).toEqual({ kind: 'rest', atSecs: 30 });
    l.seek(5);
    expect([l.asked, l.pass(5)]).toEqual([undefined, { kind: 'go' }]);
    l.seek(12);
    expect(l.pass(12)).toMatchObject({ kind: 'leap', toSecs: 17 });
  });

  it('takes any answer to what is not graded, for good, without points', () => {
    const survey = question(10, {
      isUngraded: true,
      points: 0,
      options: [option('a'), option('b'), option('c')],
      answers: [...question(10).answers.slice(1), { order: 107, to: 'answered', startSecs: 16, endSecs: 17 }],
    });
    const l = lesson([survey, question(30)], [when(20, 22, 'q10', { is: 'wrong' }), when(24, 26, 'q10', { is: 'answered' })]);
    l.pass(10);
    expect(l.answer(['b'])).toMatchObject({
      answered: { name: 'q10', given: ['b'], fits: ['b'], points: 0, tries: 1, isFinal: true },
      turn: { kind: 'leap', fromSecs: 10, toSecs: 16 },
    });
    expect(l.score).toEqual({ points: 0, most: 2 });
    const { shown } = play(l, 17, 29);
    expect([within(shown, 20, 22).length, within(shown, 24, 26).length]).toEqual([0, 8]);
    const again = lesson([survey]);
    again.restore(JSON.parse(JSON.stringify(l.state())));
    expect(again.answered).toEqual(l.answered);
    // Letting the time run out is not wrong either.
    const late = lesson([survey]);
    late.pass(10);
    expect(late.expire()?.answered).toEqual({ name: 'q10', given: [], fits: [], points: 0, tries: 1, isFinal: true });
  });

  it('goes on with an answer while the story gets other times', () => {
    const l = lesson([question(10)]);
    l.pass(10);
    expect([answer(l, 'c'), l.pass(11.5)]).toEqual([11, { kind: 'go' }]);
    // The voice of the following answer arrived: this answer is longer, and everything after it is
    // later.
    const longer = question(10, {
      endSecs: 20,
      answers: question(10).answers.map(({ startSecs, endSecs, ...more }, i) => ({ ...more, startSecs: startSecs + (i === 0 ? 0 : 3), endSecs: endSecs + 3 })),
    });
    l.retime([longer], [], 11.5);
    expect([l.pass(11.6), l.pass(14.9)].map(({ kind }) => kind)).toEqual(['go', 'go']);
    expect(l.pass(15.01)).toMatchObject({ kind: 'leap', fromSecs: 15, toSecs: 20 });
    // A question that is open stays so.
    const open = lesson([question(10)]);
    open.pass(10);
    open.retime([longer], [], 10);
    expect([open.pass(10).kind, open.asked?.name]).toEqual(['rest', 'q10']);
  });

  it('keeps nothing of a story that goes', () => {
    const l = lesson([question(10)], [set(2, 'x', { value: '1' })]);
    l.pass(10);
    answer(l, 'a');
    l.clear();
    l.setStory([question(10)], []);
    expect([l.score.points, l.state()]).toEqual([0, { answered: [], values: {}, done: [], seed: expect.any(Number), furthestSecs: 0, skipped: [] }]);
  });

  it('is restored from its state, and believes no more than that', () => {
    const l = lesson([question(10), question(30)], [set(2, 'x', { by: 1 }), set(3, 'who', { value: 'Ida' })]);
    play(l, 0, 60);
    answer(l, 'a');
    const state = JSON.parse(JSON.stringify(l.state())) as { answered: object[] };
    const again = lesson([question(10), question(30)], [set(2, 'x', { by: 1 }), set(3, 'who', { value: 'Ida' })]);
    again.restore(state);
    expect([again.score, again.answered, again.state()]).toEqual([l.score, l.answered, l.state()]);
    play(again, 0, 9);
    expect(again.state().values).toEqual({ x: 1, who: 'Ida' });
    again.restore({ answered: [{ ...state.answered[0], given: ['b'], points: 1000, isRight: true }] });
    expect(again.score.points).toBe(0);
    for (const wrong of [undefined, null, 7, 'x', {}, [null], { answered: [{ name: 'q10' }] }, { answered: { 0: 1 }, values: [Number.NaN], done: 'x', furthestSecs: -1 }]) {
      again.restore(wrong);
      expect(again.state()).toEqual({ answered: [], values: {}, done: [], seed: expect.any(Number), furthestSecs: 0, skipped: [] });
    }
  });
});

describe('Ways through a story', () => {
  it('are chosen by variables', () => {
    const ways = [set(1, 'pace', { value: 'slow' }), when(2, 4, 'pace', { is: 'slow' }), when(5, 8, 'pace', { not: 'slow' }), when(9, 10, 'steps', { above: 1, below: 4 })];
    const plain = play(lesson([], ways), 0, 12).shown;
    expect([within(plain, 2, 4).length, within(plain, 5, 8).length, within(plain, 9, 10).length]).toEqual([8, 0, 0]);
    const more = play(lesson([], [...ways, set(3, 'steps', { by: 2 }, 20), set(6, 'steps', { by: 50 }, 50)]), 0, 12).shown;
    expect(within(more, 9, 10).length).toBe(4);
  });

  it('depend on answers and points', () => {
    const ways = [
      when(20, 22, 'q10', { is: 'right' }),
      when(22, 24, 'q10', { is: 'wrong' }),
      when(24, 26, 'q10', { is: 'c' }),
      when(26, 28, 'score', { above: 1 }),
      when(28, 30, 'nobody', { is: '' }),
    ];
    const after = (given: string) => {
      const l = lesson([question(10)], ways);
      play(l, 0, 40);
      const { shown } = play(l, answer(l, given), 40);
      return [20, 22, 24, 26, 28].map((from) => within(shown, from, from + 2).length > 0);
    };
    expect(after('a')).toEqual([true, false, false, true, true]);
    expect(after('c')).toEqual([false, true, true, false, true]);
  });

  it('lead to parts and back, where all is asked and set anew', () => {
    const retry = question(10, { answers: [{ order: 101, to: 'wrong', startSecs: 11, endSecs: 12 }], endSecs: 12 });
    const ways = [part(5, 12, 'again'), set(6, 'rounds', { by: 1 }), goto(11.5, 'again', 101), goto(15, 'end'), part(30, 35, 'end')];
    const l = lesson([retry], ways);
    play(l, 0, 40);
    const round = play(l, answer(l, 'b'), 40);
    expect(round).toMatchObject({ turn: { kind: 'rest', atSecs: 10 } });
    expect(round.shown.slice(0, 4)).toEqual([11, 11.25, 5, 5.25]);
    expect(l.answered).toEqual([]);
    const { shown } = play(l, answer(l, 'a'), 40);
    expect(l.state().values).toEqual({ rounds: 2 });
    expect([within(shown, 15.1, 30).length, within(shown, 30, 35).length]).toEqual([0, 20]);
  });

  it('pass over what is in what is passed over', () => {
    const ways = [when(2, 10, 'x', { is: '1' }), when(3, 8, 'y', { not: '1' }, 20), set(4, 'z', { value: '1' }, 30), goto(5, 'nowhere', 30), part(12, 14, 'nowhere')];
    const l = lesson([question(6, { within: 30 })], ways);
    const { shown, turn } = play(l, 0, 20);
    expect([within(shown, 2, 10).length, turn.kind, l.state().values]).toEqual([0, 'go', {}]);
  });

  it('are walked by whoever seeks further than they have come', () => {
    const ways = [set(1, 'x', { value: '1' }), goto(3, 'far'), part(4, 9, 'left out'), part(20, 30, 'far'), when(22, 25, 'x', { is: '2' })];
    const sought = (to: number) => {
      const l = lesson([], ways);
      l.seek(to);
      return l.pass(to);
    };
    expect(sought(5)).toMatchObject({ kind: 'leap', toSecs: 20 });
    expect(sought(21)).toEqual({ kind: 'go' });
    expect(sought(23)).toMatchObject({ kind: 'leap', toSecs: 25 });
    const l = lesson([], ways);
    l.seek(21);
    l.pass(21);
    l.seek(4.5);
    expect(l.pass(4.5)).toEqual({ kind: 'go' });
  });
});

describe('What is asked while a story plays', () => {
  it('is asked at its time, leaves what follows to others, and is asked anew under its name', () => {
    const l = lesson([question(10)]);
    l.pass(2);
    l.add([question(5, { name: 'live', points: 1 })]);
    expect(play(l, 2, 40)).toMatchObject({ turn: { kind: 'rest', atSecs: 5 } });
    expect(answer(l, 'b')).toBe(5);
    expect(play(l, 5, 40)).toMatchObject({ turn: { kind: 'rest', atSecs: 10 } });
    // While the story rests at a question of its own, another question is asked after it.
    l.add([question(10, { name: 'live', points: 1 })]);
    expect([l.asked?.name, l.score.most, l.answered]).toEqual(['q10', 3, []]);
    expect(play(l, answer(l, 'a'), 40)).toMatchObject({ turn: { kind: 'rest', atSecs: 10 } });
  });

  it('is not asked any more once that is interrupted', () => {
    const l = lesson([]);
    l.add([question(1, { name: 'one' }), question(2, { name: 'two' })]);
    play(l, 0, 9);
    answer(l, 'a');
    expect(l.pass(2)).toMatchObject({ kind: 'rest' });
    l.interrupt();
    expect([l.asked, l.pass(2), l.answered.map(({ name }) => name)]).toEqual([undefined, { kind: 'go' }, ['one']]);
  });
});

/** Returns a generator of random numbers (mulberry32). */
function dice(seed: number): (sides: number) => number {
  let state = seed;
  return (sides) => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) % sides;
  };
}

/** Returns a random story: every ten seconds a question, an assignment, a conditional part, or a goto. */
function story(roll: (sides: number) => number): { questions: Question[]; ways: FlowEntry[]; endSecs: number } {
  const [questions, ways]: [Question[], FlowEntry[]] = [[], []];
  const count = 4 + roll(10);
  for (let i = 0; i < count; i += 1) {
    const at = i * 10;
    ways.push(part(at, at + 9, `p${i}`));
    const kind = roll(4);
    if (kind === 0) questions.push(question(at + 1));
    if (kind === 1) ways.push(set(at + 1, `v${roll(3)}`, roll(2) === 0 ? { by: 1 } : { value: 'x' }));
    if (kind === 2) ways.push(when(at + 1, at + 6, `v${roll(3)}`, roll(2) === 0 ? { is: 'x' } : { above: 0 }), set(at + 2, 'inside', { by: 1 }, (at + 1) * 10));
    if (kind === 3 && i + 1 < count) ways.push(goto(at + 5, `p${i + 1 + roll(count - i - 1)}`));
  }
  return { questions, ways, endSecs: count * 10 };
}

describe('A thousand learners in stories by chance', () => {
  it('see the way that there is, whether they play, seek or come back', () => {
    for (let seed = 0; seed < 1000; seed += 1) {
      const roll = dice(seed);
      const { questions, ways, endSecs } = story(roll);
      const answers = new Map(questions.map(({ name }) => [name, 'abc'[roll(3)] ?? 'a']));
      let l = lesson(questions, ways);
      let [secs, visits] = [0, 0];
      const seen: number[] = [];
      while (secs < endSecs && visits < 500) {
        visits += 1;
        const played = play(l, secs, roll(3) === 0 ? Math.min(endSecs, secs + 1 + roll(20)) : endSecs);
        seen.push(...played.shown);
        secs = played.secs;
        if (played.turn.kind === 'rest') {
          expect(l.asked?.name, `seed ${seed}`).toBeDefined();
          secs = answer(l, answers.get(l.asked?.name ?? '') ?? 'a');
        } else if (secs < endSecs && roll(4) === 0) {
          // A page that is closed and opened again.
          const kept = JSON.parse(JSON.stringify(l.state())) as object;
          l = lesson(questions, ways);
          l.restore(kept);
          l.seek(secs);
        } else if (secs < endSecs && roll(6) === 0) {
          // A seek ahead, as far as the target allows.
          l.seek(endSecs);
          const turn = l.pass(endSecs);
          if (turn.kind === 'rest') secs = turn.atSecs;
          if (turn.kind === 'leap') secs = turn.toSecs;
          if (turn.kind === 'go') secs = endSecs;
        }
      }
      expect(secs, `seed ${seed}`).toBeGreaterThanOrEqual(endSecs);
      // All questions on the way are answered, and no answer counts twice.
      const straight = lesson(questions, ways);
      let at = 0;
      while (at < endSecs) {
        const played = play(straight, at, endSecs);
        at = played.turn.kind === 'rest' ? answer(straight, answers.get(straight.asked?.name ?? '') ?? 'a') : played.secs;
      }
      expect([l.answered, l.state().values], `seed ${seed}`).toEqual([straight.answered, straight.state().values]);
      // Parts that are not performed are not seen, except those that were reached before this was
      // known.
      for (const { name, atSecs, answers: all } of questions) {
        const given = answers.get(name) ?? '';
        const chosen = all.find(({ to }) => to === given || to === (given === 'a' ? 'right' : 'wrong'));
        for (const { startSecs, endSecs: over } of all) {
          if (startSecs !== chosen?.startSecs) expect(within(seen, startSecs, over), `seed ${seed} ${name} ${atSecs}`).toEqual([]);
        }
      }
    }
  });
});
