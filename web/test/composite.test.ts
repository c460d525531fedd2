/** The composite editor's history: what was done is never lost, and what is read is checked. */

import { expect, test } from 'vitest';
import { isAct, type Act } from '../composite/acts.js';
import { Cache } from '../composite/cache.js';
import { History } from '../composite/history.js';
import { chosen, describe } from '../composite/people.js';

const pack = { faces: 10, vertices: 5 };
const add = (amount: number): Act => ({ kind: 'add', part: 'shape', name: 'weight', amount, region: {} });

test('undo, redo and branches of random walks', () => {
  let seed = 7;
  const draw = (below: number): number => (seed = (seed * 48271) % 2147483647) % below;
  const history = new History();
  const path: number[] = [0];
  const undone: number[] = [];
  for (let i = 0; i < 10_000; i += 1) {
    const what = draw(5);
    if (what < 3) {
      path.push(history.add(add(i)));
      undone.length = 0;
    } else if (what === 3 && path.length > 1) {
      undone.push(path.pop() ?? 0);
      history.undo();
    } else if (what === 4 && undone.length > 0) {
      path.push(undone.pop() ?? 0);
      history.redo();
    }
    expect(history.here).toBe(path.at(-1));
    expect(history.canUndo).toBe(path.length > 1);
  }
  expect(history.path()).toEqual(path);
  const again = History.read(JSON.parse(JSON.stringify(history.save(pack))), pack);
  expect(again.steps).toEqual(history.steps);
  expect(again.path()).toEqual(path);
});

test('what is held is that of the way to a step', () => {
  const history = new History();
  const held = [{ part: 'shape', name: 'lips', value: 0.3 }] as const;
  history.add({ kind: 'hold', held });
  const holding = history.add(add(1));
  history.undo();
  history.undo();
  const free = history.add(add(2));
  expect(history.heldAt(holding)).toEqual(held);
  expect(history.heldAt(free)).toEqual([]);
});

test('sessions that cannot be used are refused by their fault', () => {
  const good = new History().save(pack);
  const step = { parent: 0, act: add(1) };
  const faults: [unknown, RegExp][] = [
    [undefined, /no session/],
    ['text', /no session/],
    [{ ...good, format: 'other' }, /no session/],
    [{ ...good, version: 2 }, /newer/],
    [{ ...good, pack: { faces: 9, vertices: 5 } }, /another pack/],
    [{ ...good, steps: [] }, /no steps/],
    [{ ...good, steps: [...good.steps, { ...step, parent: 1 }] }, /Step 2/],
    [{ ...good, steps: [...good.steps, { ...step, act: add(Number.NaN) }] }, /Step 2/],
    [{ ...good, steps: [...good.steps, { parent: 0, act: { kind: 'eval' } }] }, /Step 2/],
    [{ ...good, here: 5 }, /which face/],
  ];
  for (const [saved, fault] of faults) expect(() => History.read(saved, pack)).toThrow(fault);
});

test('acts of every kind are told from others', () => {
  const region = { segments: ['nose'], half: 'left' };
  const acts: unknown[] = [
    { kind: 'average' },
    { kind: 'random', seed: 3 },
    { kind: 'example', index: 1 },
    { kind: 'age', amount: 0.2, region },
    { kind: 'caricature', part: 'texture', level: 1.2, region },
    { kind: 'import', index: 2, part: 'shape', region },
    { kind: 'transform', scale: [1, 1, 1], turn: [0, 0, 0], way: [0, 0, 0.001], region },
    { kind: 'detail', strength: 0.7 },
    { kind: 'hold', held: [{ part: 'shape', name: 'lips', value: 0 }] },
  ];
  for (const act of acts) {
    expect(isAct(act)).toBe(true);
    expect(isAct({ ...(act as object), kind: 'other' })).toBe(false);
  }
  expect(isAct({ kind: 'age', amount: 1, region: { half: 'upper' } })).toBe(false);
  expect(isAct({ kind: 'random', seed: 2 ** 33 })).toBe(false);
});

test('the latest faces are kept, and some of the others', () => {
  const cache = new Cache();
  for (let i = 0; i < 5000; i += 1) cache.keep(i, new Uint8Array(1));
  expect(cache.of(4999)).toBeDefined();
  expect(cache.of(4990)).toBeDefined();
  expect(cache.of(32)).toBeDefined();
  expect(cache.of(33)).toBeUndefined();
});

test('faces by a description', () => {
  const people = [
    { sex: 1, ageYears: 60, ancestry: [0.9, 0.1, 0] },
    { sex: 0, ageYears: 12, ancestry: [0, 1, 0] },
    { sex: 0.9, ageYears: 30, ancestry: [0.4, 0.3, 0.3] },
  ] as const;
  expect(chosen(people, { sex: 'any', age: 'any', ancestry: 'any' })).toEqual([0, 1, 2]);
  expect(chosen(people, { sex: 'woman', age: 'old', ancestry: 'european' })).toEqual([0]);
  expect(chosen(people, { sex: 'any', age: 'any', ancestry: 'mixed' })).toEqual([2]);
  expect(people.map(describe)).toEqual(['Woman of 60, European', 'Boy of 12, Asian', 'Woman of 30, mixed']);
});
