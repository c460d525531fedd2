/** Data exported from a face: the contents of the report, the rotations of the film, the stored thumbnails, the size of a print. */

import { inflateSync } from 'node:zlib';
import { expect, test } from 'vitest';
import type { Act } from '../composite/acts.js';
import { turnsOf } from '../composite/film.js';
import { History } from '../composite/history.js';
import { branch } from '../composite/history-panel.js';
import { termOf } from '../composite/panels.js';
import { fileName } from '../composite/pictures-panel.js';
import { figureOf } from '../composite/plain.js';
import { PRINT_SIZE, withDensity } from '../composite/print.js';
import { reportOf } from '../composite/report.js';
import { MAX_THUMBNAILS, Thumbnails } from '../composite/thumbnails.js';

const add = (name: string, segments: readonly string[] = []): Act => ({ kind: 'add', part: 'shape', name, amount: 0.6, region: { segments } });

const hair = (name: string, eumelanin: number, pheomelanin: number) => ({ name, colour: { eumelanin, pheomelanin, grey: 0 }, rgb: [0, 0, 0] as const });

const pack = {
  vertices: 5,
  faces: 10,
  attributes: [
    { part: 'shape', group: 'nose', name: 'breadth', terms: ['narrow', 'broad'], derived: null },
    { part: 'shape', group: 'nose', name: 'length', terms: ['short', 'long'], derived: null },
    { part: 'texture', group: 'skin', name: 'freckles', terms: ['few', 'many'], derived: null },
  ],
  segments: [],
  people: [],
  figures: [],
} as const;

test('a report has what differs from the average, what is held, and the way to the face alone', () => {
  const history = new History();
  history.add(add('breadth', ['nose']));
  history.undo();
  history.add(add('length', ['chin']));
  history.name('<img src=x>');
  const report = reportOf(
    {
      history,
      faces: { pack },
      held: [{ part: 'shape', name: 'length', value: 0.6, segments: ['nose'], half: 'left' }],
      person: { sex: 'woman', age: 'young', ancestry: 'any' },
      look: {
        hair: { from: 'lia', colour: { eumelanin: 0.1, pheomelanin: 0.8, grey: 0.6 } },
        cut: 'moustache',
        beard: { from: 'papous' },
        wear: [{ kind: 'hat', colour: [0, 0, 0] }],
      },
      marks: [
        { kind: 'scar', corners: [0, 1, 2], shares: [1, 0, 0], size: 0.035, turn: 0 },
        { kind: 'tattoo', corners: [0, 1, 2], shares: [1, 0, 0], size: 0.02, turn: 0, shape: 'anchor' },
      ],
      light: { name: 'evening', turn: -Math.PI / 6 },
      player: { naturalHair: () => [hair('black', 1, 0), hair('red', 0.1, 0.7)] },
      values: {
        shape: new Map([
          ['breadth', 0.004],
          ['length', 0.6],
        ]),
        texture: new Map([['freckles', -0.25]]),
      },
    },
    new Date(0),
  );
  expect(report.name).toBe('<img src=x>');
  expect(report.groups).toEqual([
    { title: 'Shape, nose', rows: [{ name: 'length', term: '60 percent long', value: '+0.60' }] },
    { title: 'Colour, skin', rows: [{ name: 'freckles', term: '25 percent few', value: '−0.25' }] },
  ]);
  expect(report.held).toEqual(['length, shape: +0.60, nose, left']);
  expect(report.steps).toEqual([
    { step: 0, text: 'Average face' },
    { step: 2, text: 'length +0.60, chin (named “<img src=x>”)' },
  ]);
  const facts = new Map(report.facts);
  expect(facts.get('Step')).toBe('2 of 2');
  expect(facts.get('Changed')).toBe('chin');
  expect(facts.get('Hair')).toBe('Long, red, 60 percent grey');
  expect(facts.get('Beard')).toBe('Moustache');
  expect(facts.get('Accessories')).toBe('hat');
  expect(facts.get('Marks')).toBe('scar, 35 mm; tattoo anchor, 20 mm');
  expect(facts.get('Light')).toBe('Lamp, turned by 30° to the right');
  expect(facts.get('Faces were chosen by')).toBe('A woman, 18 to 35, any ancestry');
  expect(facts.get('Face model')).toBe('10 faces with 5 points each');
});

test('between the average and none there is less, not a share of none', () => {
  expect(termOf(-0.54, ['none', 'many'])).toBe('54 percent less than average');
  expect(termOf(-1.2, ['none', 'many'])).toBe('none');
  expect(termOf(0.54, ['none', 'many'])).toBe('54 percent many');
  expect(termOf(-0.54, ['short', 'long'])).toBe('54 percent short');
});

test('a film turns once around, in equal steps, and does not end where it began', () => {
  const turns = turnsOf(96);
  expect(turns).toHaveLength(96);
  expect(turns[0]).toBe(0);
  expect(turns[24]).toBeCloseTo(Math.PI / 2);
  expect(turns[95]).toBeCloseTo((2 * Math.PI * 95) / 96);
});

test('the latest small pictures are kept, and those of another history are not shown', () => {
  const app = { history: new History(), resting: true, player: {} as never, view: { zoom: 7 } };
  const thumbnails = new Thumbnails(app, () => undefined);
  for (let step = 0; step < MAX_THUMBNAILS + 5; step += 1) thumbnails.keep(step, `data:${step}`);
  expect(thumbnails.thumbnailOf(4)).toBeUndefined();
  expect(thumbnails.thumbnailOf(5)).toBe('data:5');
  expect(thumbnails.thumbnailOf(MAX_THUMBNAILS + 4)).toBe(`data:${MAX_THUMBNAILS + 4}`);
  app.history = new History();
  expect(thumbnails.thumbnailOf(5)).toBeUndefined();
  thumbnails.keep(0, 'data:new');
  expect(thumbnails.thumbnailOf(0)).toBe('data:new');
  expect(thumbnails.thumbnailOf(5)).toBeUndefined();
});

test('a step says where it branches off', () => {
  expect(branch({ parent: -1, act: { kind: 'average' } }, 0)).toBeUndefined();
  expect(branch({ parent: 4, act: add('length') }, 5)).toBeUndefined();
  expect(branch({ parent: 2, act: add('length') }, 5)).toBe('from step 2');
  expect(branch({ parent: 0, act: add('length') }, 5)).toBe('from the beginning');
});

test('a picture for paper says how large it is', () => {
  // One grey pixel.
  const png = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==', 'base64');
  const dense = Buffer.from(withDensity(png));
  expect(dense.subarray(33, 54).toString('hex')).toBe('00000009' + '70485973' + '00002e23' + '00002e23' + '01' + '78a53f76');
  expect(dense.subarray(0, 33)).toEqual(png.subarray(0, 33));
  expect(dense.subarray(54)).toEqual(png.subarray(33));
  expect(inflateSync(dense.subarray(54 + 8, 54 + 8 + 10))).toHaveLength(2);
  expect(PRINT_SIZE.width / 300).toBeCloseTo(10 / 2.54, 2);
  expect(PRINT_SIZE.height / 300).toBeCloseTo(12.5 / 2.54, 2);
});

test('what is alike before two places and hangs together with the middle is the figure', () => {
  const [width, height] = [9, 9];
  const at = (of: (x: number, y: number) => number) => Uint8ClampedArray.from({ length: 4 * width * height }, (_, i) => of(Math.floor(i / 4) % width, Math.floor(i / 4 / width)));
  const isHead = (x: number, y: number): boolean => x >= 3 && x <= 5 && y >= 2;
  // An eye reflects the stage, and one spot happens to be alike on both stages.
  const one = at((x, y) => (isHead(x, y) && !(x === 4 && y === 5) ? 120 : 20));
  const other = at((x, y) => (isHead(x, y) && !(x === 4 && y === 5) ? 123 : x === 0 && y === 0 ? 20 : 90));
  one.set(one.subarray(0, 4), 4 * (5 * width + 4));
  one.set([120, 120, 120, 255], 4 * (4 * width + 4));
  const figure = figureOf(one, other, width, height);
  for (let i = 0; i < figure.length; i += 1) expect(figure[i], String(i)).toBe(Number(isHead(i % width, Math.floor(i / width))));
});

test('files are called as the face is, in letters that any system takes', () => {
  expect(fileName('Zoë, older')).toBe('zoe-older');
  expect(fileName('../<img src=x>')).toBe('img-src-x');
  expect(fileName('李')).toBe('face');
  expect(fileName()).toBe('face');
});
