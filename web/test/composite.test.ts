/** History of the composite editor: actions are never lost, and input is validated. */

import { expect, test } from 'vitest';
import type { Act } from '../composite/acts.js';
import { Cache } from '../composite/cache.js';
import { isAct } from '../composite/checks.js';
import { hexOf, linearOf } from '../element/base/colour.js';
import { changeOf } from '../composite/hands.js';
import { History } from '../composite/history.js';
import { LIMITS } from '../composite/limits.js';
import { BEARDS, HAIR, toggled } from '../composite/look.js';
import { chosen, describe, figureOf, lookOf } from '../composite/people.js';
import { skinOf } from '../composite/skin.js';
import { lendersOf, paintOf, plainLook, toldLook } from '../element/face/face-look.js';
import type { FaceLook, FigureFace } from '../element/base/face-types.js';

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
      path.push(history.add(add(i % 20)));
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
    [undefined, /not a session/],
    ['text', /not a session/],
    [{ ...good, format: 'other' }, /not a session/],
    [{ ...good, version: 3 }, /newer/],
    [{ ...good, pack: { faces: 9, vertices: 5 } }, /another pack/],
    [{ ...good, steps: [] }, /no readable steps/],
    [{ ...good, steps: [...good.steps, { ...step, parent: 1 }] }, /Step 1:/],
    [{ ...good, steps: [...good.steps, { ...step, act: add(Number.NaN) }] }, /Step 1:/],
    [{ ...good, steps: [...good.steps, { parent: 0, act: { kind: 'eval' } }] }, /Step 1:/],
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

test('what nobody does by hand is refused by its name', () => {
  const good = new History().save(pack);
  const region = {};
  const deep = (depth: number): unknown => JSON.parse(`${'['.repeat(depth)}${']'.repeat(depth)}`);
  const hostile: [act: unknown, fault: string][] = [
    [{ kind: 'transform', scale: [1, 1e9, 1], turn: [0, 0, 0], way: [0, 0, 0], region }, 'Step 1: scale 1000000000 is more than 4.'],
    [{ kind: 'transform', scale: [1, -1, 1], turn: [0, 0, 0], way: [0, 0, 0], region }, 'Step 1: scale -1 is less than 0.25.'],
    [{ kind: 'transform', scale: [1, 1, 1], turn: [0, 0, 0], way: [0, 1e3, 0], region }, 'Step 1: way 1000 is more than 0.1.'],
    [add(1e308), 'Step 1: amount 1e+308 is more than 20.'],
    [add(Number.NEGATIVE_INFINITY), 'Step 1: amount -Infinity is less than -20.'],
    [{ kind: 'caricature', part: 'shape', level: 1e9, region }, 'Step 1: level 1000000000 is more than 4.'],
    [{ kind: 'hold', held: [{ part: 'shape', name: 'lips', value: 1e9 }] }, 'Step 1: value 1000000000 is more than 20.'],
    [{ kind: 'hold', held: Array.from({ length: 300 }, () => ({ part: 'shape', name: 'lips', value: 0 })) }, 'Step 1: the list of held values has 300 entries, more than 200.'],
    [{ kind: 'average', more: deep(100_000) }, 'Step 1: it is nested more than 8 deep.'],
    [{ kind: 'average', more: Array.from({ length: 1_000_000 }, () => 0) }, 'Step 1: it has more than 5000 values.'],
    [{ kind: 'detail', strength: '1' }, 'Step 1: detail is not a number.'],
    [{ kind: '__proto__' }, 'Step 1: it is not an edit of a face.'],
  ];
  for (const [act, fault] of hostile) expect(() => History.read({ ...good, steps: [...good.steps, { parent: 0, act }] }, pack)).toThrow(fault);
  const many = [...good.steps, ...Array.from({ length: 1_000_000 }, (_, i) => ({ parent: i, act: add(0) }))];
  expect(() => History.read({ ...good, steps: many }, pack)).toThrow('This session has 1000001 steps, more than 10000.');
  // Sessions made by hand are within the limits.
  const most = Array.from({ length: LIMITS.steps - 1 }, (_, i) => ({ parent: i, act: add(i % 2 === 0 ? 3 : -3) }));
  expect(History.read({ ...good, steps: [...good.steps, ...most] }, pack).steps).toHaveLength(LIMITS.steps);
});

test('the latest faces are kept, and some of the others', () => {
  const cache = new Cache();
  for (let i = 0; i < 5000; i += 1) cache.keep(i, new Uint8Array(1));
  expect(cache.get(4999)).toBeDefined();
  expect(cache.get(4990)).toBeDefined();
  expect(cache.get(32)).toBeDefined();
  expect(cache.get(33)).toBeUndefined();
});

test('faces by a description', () => {
  const people = [
    { sex: 1, ageYears: 60, ancestry: [0.9, 0.1, 0] },
    { sex: 0, ageYears: 12, ancestry: [0, 1, 0] },
    { sex: 0.9, ageYears: 30, ancestry: [0.4, 0.3, 0.3] },
  ] as const;
  expect(chosen(people, { sex: 'any', age: 'any', ancestry: 'any' })).toEqual([0, 1, 2]);
  expect(chosen(people, { sex: 'woman', age: 'late', ancestry: 'european' })).toEqual([0]);
  expect(chosen(people, { sex: 'any', age: 'any', ancestry: 'mixed' })).toEqual([2]);
  expect(people.map(describe)).toEqual(['Woman of 60, European', 'Boy of 12, Asian', 'Woman of 30, mixed']);
});

const NATURAL = ['black', 'dark brown', 'brown', 'auburn', 'red', 'light brown', 'dark blond', 'blond'].map((name) => ({
  name,
  colour: { eumelanin: 0.3, pheomelanin: 0.3, grey: 0 },
  rgb: [0.1, 0.1, 0.1] as const,
}));

test('who somebody is decides hair, beard, body and clothes', () => {
  const one = (sex: number, ageYears: number, ancestry: readonly [number, number, number]) => ({ sex, ageYears, ancestry });
  const [old, girl, boy, woman, african] = [one(0, 82, [1, 0, 0]), one(1, 8, [1, 0, 0]), one(0, 9, [0, 1, 0]), one(1, 30, [1, 0, 0]), one(1, 30, [0, 0, 1])];
  expect([old, girl, boy, woman, african, one(0, 30, [0, 1, 0])].map(figureOf)).toEqual(['papous', 'lia', 'nuno', 'sofia', 'amara', 'kenji']);
  const feminine = ['bob', 'page', 'pixie', 'long', 'straight', 'wavy', 'curly', 'ponytail', 'bun', 'braid'];
  for (let years = 60; years < 90; years += 0.37) {
    const { hair, beard, brows } = lookOf(one(0, years, [1, 0, 0]), NATURAL);
    expect(feminine).not.toContain(hair?.from);
    expect(Object.keys(HAIR)).toContain(hair?.from);
    expect(Object.keys(BEARDS)).toContain(beard?.from);
    expect(hair?.colour?.grey).toBeGreaterThan(0.4);
    expect(brows?.grey).toBeLessThan(hair?.colour?.grey ?? 0);
  }
  for (const person of [girl, boy, woman, african, one(0, 16, [1, 0, 0])]) expect(lookOf(person, NATURAL).beard?.from).toBe('none');
  expect(lookOf(african, NATURAL).hair?.from).toMatch(/afro|coily|bun|braid/);
  expect(lookOf(boy, NATURAL)).toEqual(lookOf(boy, NATURAL));
  const beards = new Set(Array.from({ length: 60 }, (_, i) => lookOf(one(0, 55 + i / 3, [1, 0, 0]), NATURAL).beard?.from));
  expect(beards.size).toBeGreaterThan(5);
});

test('looks of earlier versions have the hair that figures lent', () => {
  const face = (look: FaceLook) => ({ look }) as FigureFace;
  expect(plainLook({ hair: { from: 'sofia' }, beard: { from: 'papous' }, cut: 'moustache' })).toEqual({ hair: { from: 'bob' }, beard: { from: 'moustache' } });
  expect(lendersOf(face({ hair: { from: 'bald' }, beard: { from: 'stubble' } }))).toEqual([]);
  expect(lendersOf(face({ hair: { from: 'crop' }, beard: { from: 'goatee' } }))).toEqual(['crop', 'goatee']);
  expect(toldLook({ beard: { from: 'stubble' } })).toEqual({ beard: { from: 'none' } });
  expect(paintOf({ beard: { from: 'stubble' } }).stubble).toBe(1);
});

test('sliders of freckles, shadow and irises change what is painted', () => {
  const skin = (name: string, value: number) => skinOf(new Map([[name, value]]), 0);
  expect(paintOf(skin('freckles', 0))).toEqual({ freckles: 0, stubble: 0, grey: 0, ageSpots: 0, moles: 0, seed: 0 });
  expect(paintOf(skin('freckles', 1)).freckles).toBe(1);
  expect(paintOf(skin('beard shadow', 1)).stubble).toBe(1);
  expect(paintOf(skin('ageing', 2)).ageSpots).toBe(1);
  expect(skinOf(new Map(), 7).seed).toBe(7);
  const iris = (value: number) => skin('colour of the iris', value).iris ?? [0, 0, 0];
  const [brown, blue] = [iris(-1), iris(1)];
  expect(brown[0]).toBeGreaterThan(2 * brown[2]);
  expect(blue[2]).toBeGreaterThan(1.5 * blue[0]);
});

test('looks and marks of a file are those that there are', () => {
  const look = { hair: { from: 'kenji', colour: { eumelanin: 0.1, pheomelanin: 0.2, grey: 0.5 } }, cut: 'goatee', wear: [{ kind: 'hat', colour: [0, 0.5, 1] }] };
  const mark = { kind: 'tattoo', corners: [1, 2, 3], shares: [0.2, 0.3, 0.5], size: 0.02, turn: 0.1, shape: 'text', text: 'Mom' };
  expect(isAct({ kind: 'look', look, what: 'hat' })).toBe(true);
  expect(isAct({ kind: 'look', look: {}, what: '' })).toBe(true);
  expect(isAct({ kind: 'marks', marks: [mark], what: 'tattoo' })).toBe(true);
  const looks = [
    { hair: { from: 'https://example.com/' } },
    { hair: { from: 'goatee' } },
    { beard: { from: 'bob' } },
    { hair: { from: '../sofia' } },
    { hair: { from: '__proto__' } },
    { hair: { colour: { eumelanin: -1, pheomelanin: 0, grey: 0 } } },
    { cut: 'mohawk' },
    { wear: [{ kind: 'crown', colour: [0, 0, 0] }] },
    { wear: [{ kind: 'hat', colour: [0, 0, Number.NaN] }] },
    { wear: 'hat' },
    null,
  ];
  for (const broken of looks) expect(isAct({ kind: 'look', look: broken, what: '' }), JSON.stringify(broken)).toBe(false);
  const marks = [
    { kind: 'wart' },
    { size: 3 },
    { turn: Number.POSITIVE_INFINITY },
    { corners: [1, 2] },
    { corners: [1, 2, -1] },
    { shares: [5, 0, 0] },
    { shape: 'skull' },
    { text: 'x'.repeat(30) },
  ];
  for (const broken of marks) expect(isAct({ kind: 'marks', marks: [{ ...mark, ...broken }], what: '' }), JSON.stringify(broken)).toBe(false);
  expect(isAct({ kind: 'marks', marks: Array.from({ length: 101 }, () => mark), what: '' })).toBe(false);
});

test('a head wears one cover and one pair of glasses', () => {
  let look: FaceLook = {};
  for (const kind of ['hat', 'round-glasses', 'sunglasses', 'headscarf', 'ear-studs'] as const) look = toggled(look, kind);
  expect(look.wear?.map((w) => w.kind)).toEqual(['sunglasses', 'headscarf', 'ear-studs']);
  expect(toggled(look, 'headscarf').wear?.map((w) => w.kind)).toEqual(['sunglasses', 'ear-studs']);
});

test('what a step has is that of the way to it', () => {
  const history = new History();
  const look = { hair: { from: 'none' } } as const;
  const shaved = history.add({ kind: 'look', look, what: 'hair: shaved' });
  const later = history.add(add(1));
  history.undo();
  history.undo();
  const free = history.add(add(2));
  expect([shaved, later].map((step) => history.lookAt(step))).toEqual([look, look]);
  expect([history.lookAt(free), history.marksAt(free)]).toEqual([undefined, []]);
});

test('colours come back from the inputs of a browser', () => {
  for (const hex of ['#000000', '#ffffff', '#204060', '#d7a35c']) expect(hexOf(linearOf(hex))).toBe(hex);
  expect(linearOf('red')).toEqual([0, 0, 0]);
});

test('a drag moves in the plane of the picture, and turns and scales within bounds', () => {
  const close = (a: readonly number[], b: readonly number[]): void => a.forEach((x, i) => expect(x).toBeCloseTo(b[i] ?? 0, 9));
  close(changeOf('move', 10, 5, 0, 1e-4).way, [1e-3, 5e-4, 0]);
  // From the left profile the front of the face is at the left.
  close(changeOf('move', 10, 0, Math.PI / 2, 1e-4).way, [0, 0, -1e-3]);
  close(changeOf('move', 1e6, -1e6, 0, 1e-4).way, [0.02, -0.02, 0]);
  close(changeOf('scale', 0, 1e6, 0, 1).scale, [1, 1.6, 1]);
  close(changeOf('turn', 100, 0, 0, 1).turn, [0, 0, -0.6]);
});

test('who goes to a step and back to the beginning comes to it again by redo', () => {
  const history = new History();
  const [, second] = [history.add(add(1)), history.add(add(2))];
  history.go(0);
  const other = history.add(add(3));
  for (const step of [second, other]) {
    history.go(step);
    history.go(0);
    while (history.canRedo) history.redo();
    expect(history.here).toBe(step);
  }
});
