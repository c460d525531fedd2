import { describe, expect, it } from 'vitest';
import { gapsOf, judge, MAX_CHARACTERS, numberOf, plain } from '../element/lesson/judge.js';
import { shownOf } from '../element/lesson/question-fields.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';

const option = (name: string, more: Partial<QuestionOption> = {}): QuestionOption => ({ name, text: name, isRight: false, ...more });
const question = (kind: QuestionKind, options: readonly QuestionOption[], prompt = '?'): Question => ({
  order: 0,
  atSecs: 0,
  endSecs: 1,
  name: 'q',
  kind,
  prompt,
  points: 1,
  tries: 1,
  options,
  answers: [],
});
const isRight = (asked: Question, ...given: string[]) => judge(asked, given)?.isRight;

describe('An answer', () => {
  it('is the same whatever its accents, capitals, signs and spaces', () => {
    const all = ['Café au lait', ' cafe  AU lait! ', 'CAFÉ-AU-LAIT', '«Cafe\u0301, au lait?»'].map(plain);
    expect(new Set(all)).toEqual(new Set(['cafe au lait']));
    // Vowels that are written as marks are no accents.
    expect(plain('कि')).not.toBe(plain('क'));
    expect(['', ' ', '?!', '🙂'].map(plain)).toEqual(['', '', '', '']);
  });

  it('may be a number as people write it', () => {
    expect(['3', ' 3,5 ', '3.5', '-2', '1 000', "1'000", '1e3', '', 'three', '1,2,3', 'Infinity'].map(numberOf)).toEqual([
      3,
      3.5,
      3.5,
      -2,
      1000,
      1000,
      1000,
      undefined,
      undefined,
      undefined,
      undefined,
    ]);
  });

  it('is an order of all, and only one is right', () => {
    const asked = question(
      'order',
      ['a', 'b', 'c'].map((name) => option(name)),
    );
    expect([isRight(asked, 'a', 'b', 'c'), isRight(asked, 'b', 'a', 'c'), judge(asked, ['a', 'b']), judge(asked, ['a', 'a', 'b'])]).toEqual([true, false, undefined, undefined]);
    expect([...shownOf(asked, 0)].sort()).toEqual(['a', 'b', 'c']);
    expect(shownOf(asked, 0)).not.toEqual(['a', 'b', 'c']);
    expect(shownOf(asked, 0)).toEqual(shownOf(asked, 0));
  });

  it('gives partners, those that are alike one as well as the other', () => {
    const asked = question('match', [option('a', { partner: 'X' }), option('b', { partner: 'Y' }), option('c', { partner: 'X' })]);
    expect([isRight(asked, 'a', 'b', 'c'), isRight(asked, 'c', 'b', 'a'), isRight(asked, 'b', 'b', 'a'), isRight(asked, 'a', '', 'c')]).toEqual([true, true, false, false]);
    expect([judge(asked, []), judge(asked, ['', '', '']), judge(asked, ['x', 'y', 'z'])]).toEqual([undefined, undefined, undefined]);
  });

  it('fills gaps, whatever their order in the prompt', () => {
    const asked = question('gap', [option('where', { accepts: ['inn', 'café'] }), option('who', { accepts: ['frog'] })], 'The [who] sat in a [where] [today].');
    expect([isRight(asked, 'INN', 'frog'), isRight(asked, 'cafe', 'Frog.'), isRight(asked, 'frog', 'inn'), judge(asked, [' ', ''])]).toEqual([true, true, false, undefined]);
    expect(gapsOf(asked).map((part) => (typeof part === 'string' ? part : part.name))).toEqual(['The ', 'who', ' sat in a ', 'where', ' ', '[today]', '.']);
  });

  it('goes by the first rule that fits', () => {
    const number = question('number', [option('low', { most: 2 }), option('right', { least: 2, most: 4, isRight: true })]);
    expect(['2', '3', '9'].map((text) => judge(number, [text])?.fits)).toEqual([['low'], ['right'], []]);
    const text = question('text', [option('summer', { accepts: ['summer'] }), option('cold', { accepts: ['cold', 'in winter'], rejects: ['not'], isRight: true })]);
    expect(['It is COLD.', 'in  winter, always', 'not cold', 'summer is cold', 'colder', ''].map((given) => judge(text, [given])?.isRight)).toEqual([
      true,
      true,
      false,
      false,
      false,
      undefined,
    ]);
  });

  it('to what is not graded is neither right nor wrong, whatever its kind', () => {
    const kinds: readonly [QuestionKind, string[]][] = [
      ['choice', ['a']],
      ['several', ['a', 'b']],
      ['point', ['b']],
      ['order', ['b', 'a']],
      ['match', ['a', 'a']],
      ['gap', ['x', '']],
      ['number', ['7']],
      ['text', ['I will.']],
    ];
    for (const [kind, given] of kinds) {
      const asked = { ...question(kind, kind === 'number' || kind === 'text' ? [] : [option('a', { partner: 'A' }), option('b', { partner: 'B' })]), isUngraded: true };
      expect([judge(asked, given)?.given, Object.keys(judge(asked, given) ?? {})], kind).toEqual([given, ['given', 'fits']]);
      expect(judge(asked, []), kind).toBe(undefined);
    }
  });

  it('of any size and kind is bounded, and is never more than was given', () => {
    const kinds: readonly QuestionKind[] = ['choice', 'several', 'order', 'match', 'gap', 'number', 'point', 'text'];
    const texts = ['x'.repeat(1 << 20), '<script>alert(1)</script>', '\ud800', '__proto__', 'a', '[a]', '\0', '🙂'.repeat(9000), '-'.repeat(1 << 20), 'ä'.repeat(1 << 20)];
    for (const kind of kinds) {
      const asked = question(kind, [option('a', { isRight: true, partner: 'a', accepts: ['a'], least: 1 }), option('b', { partner: 'b', accepts: ['b'] })], '[a] [b]');
      for (const text of texts) {
        const judged = judge(asked, [text, ...texts]);
        for (const given of judged?.given ?? []) expect(given.length).toBeLessThanOrEqual(MAX_CHARACTERS);
        expect(judged?.given.length ?? 0).toBeLessThanOrEqual(Math.max(1, asked.options.length));
      }
    }
  });
});
