import { expect, test } from 'vitest';
import { clock, fitted, marks, revealed, toOf, zoomed } from '../pages/transcribe/axis.js';
import { grip, MIN_SECS, type Side } from '../pages/transcribe/edges.js';
import { chosen } from '../pages/transcribe/opening.js';
import { endOf, inView, neighbour, spanOf, timeOf, tracksOf } from '../pages/transcribe/tracks.js';
import type { Item, Transcription } from '../pages/transcribe/types.js';
import { UndoStack } from '../pages/undo.js';

/** Two gestures: the first one of three phases, the second one of two, 0.2 s later; four words in two utterances. */
const sample = (): Transcription => ({
  media: [],
  words: [
    { token: 'once', start: 0.4, end: 0.6 },
    { token: 'upon', start: 0.6, end: 0.9 },
    { token: 'a', start: 0.9, end: 1 },
    { token: 'time', start: 1.2, end: 1.6 },
  ],
  utterances: [
    { text: '', first: 0, last: 2 },
    { text: 'time.', first: 3, last: 3 },
  ],
  levels: [{ level: 'narrative', first: 0, last: 1 }],
  gestures: [
    { class: 'gesticulation', start: 0.3, end: 1.5 },
    { class: 'gesticulation', start: 1.7, end: 2.5 },
  ],
  layers: [
    {
      name: 'layer1',
      phases: [
        { kind: 'preparation', start: 0.3, end: 0.6 },
        { kind: 'stroke', start: 0.6, end: 1 },
        { kind: 'retraction', start: 1, end: 1.5 },
        { kind: 'stroke', start: 1.7, end: 2 },
        { kind: 'retraction', start: 2, end: 2.5 },
      ],
      phrases: [
        { first: 0, last: 2, dimension: 'iconic', handedness: 'RH' },
        { first: 3, last: 4 },
      ],
    },
  ],
});

const at = (track: string, index: number): Item => ({ track, index });

function moved(item: Item, side: Side, secs: number): Transcription {
  const transcription = sample();
  grip(transcription, item, side)?.move(secs);
  return transcription;
}

test('a border that two spans share moves for both, and for their phrases', () => {
  const { layers } = moved(at('phases.0', 1), 'end', 1.2);
  expect(layers[0]?.phases.map(({ start, end }) => [start, end]).slice(0, 3)).toEqual([
    [0.3, 0.6],
    [0.6, 1.2],
    [1.2, 1.5],
  ]);
});

test('no span gets over its neighbour or shorter than a hundredth of a second', () => {
  for (const [secs, end] of [
    [9, 1.5 - MIN_SECS],
    [-9, 0.6 + MIN_SECS],
  ] as const) {
    expect(timeOf(moved(at('phases.0', 1), 'end', secs), at('phases.0', 1), 'end')).toBeCloseTo(end, 4);
  }
  const late = moved(at('phases.0', 2), 'end', 9);
  expect(timeOf(late, at('phases.0', 2), 'end')).toBe(1.7);
  expect(timeOf(late, at('phases.0', 3), 'start')).toBe(1.7);
  expect(timeOf(moved(at('words', 0), 'start', -1), at('words', 0), 'start')).toBe(0);
});

test('what an edge meets on its way does not stick to it', () => {
  const transcription = sample();
  const held = grip(transcription, at('phases.0', 2), 'end');
  expect([held?.move(9), held?.move(9), held?.move(1.4)]).toEqual([true, false, true]);
  expect(timeOf(transcription, at('phases.0', 3), 'start')).toBe(1.7);
});

test('a phase at the end of a gesture takes the gesture along, and the other way round', () => {
  for (const item of [at('phases.0', 2), at('gestures', 0), at('phrases.0', 0)]) {
    const transcription = moved(item, 'end', 1.6);
    expect([transcription.gestures[0]?.end, transcription.layers[0]?.phases[2]?.end], item.track).toEqual([1.6, 1.6]);
  }
});

test('an edge of a run of annotations is that of its last part', () => {
  const transcription = moved(at('levels', 0), 'end', 1.8);
  expect([transcription.words[3]?.end, timeOf(transcription, at('utterances', 1), 'end')]).toEqual([1.8, 1.8]);
});

test('an edge that does not exist, or a time that is none, moves nothing', () => {
  expect(grip(sample(), at('words', 7), 'end')).toBeUndefined();
  expect(moved(at('words', 0), 'end', NaN)).toEqual(sample());
});

test('a moved edge is one step of undo', () => {
  const transcription = sample();
  const stack = new UndoStack(transcription);
  const held = grip(transcription, at('words', 3), 'end');
  held?.move(1.7);
  held?.move(1.8);
  stack.settle(transcription);
  expect(stack.undo()).toEqual(sample());
  expect(stack.redo()?.words[3]?.end).toBe(1.8);
});

test('tracks are in the order of the passes, with times and texts of their own', () => {
  const tracks = tracksOf(sample());
  expect(tracks.map(({ id }) => id)).toEqual(['words', 'utterances', 'levels', 'gestures', 'phases.0', 'phrases.0']);
  expect(spanOf(tracks, at('utterances', 0))).toMatchObject({ start: 0.4, end: 1, label: 'once upon a' });
  expect(spanOf(tracks, at('phrases.0', 0))).toMatchObject({ start: 0.3, end: 1.5, label: 'iconic, RH' });
  expect([endOf(tracks), spanOf(tracks, undefined), spanOf(tracks, at('words', 9))]).toEqual([2.5, undefined, undefined]);
});

test('arrow keys go along a track and to the nearest span of another', () => {
  const tracks = tracksOf(sample());
  const to = (item: Item, key: string): Item | undefined => neighbour(tracks, item, key);
  expect([to(at('words', 1), 'ArrowRight'), to(at('words', 0), 'ArrowLeft'), to(at('words', 0), 'End')]).toEqual([at('words', 2), undefined, at('words', 3)]);
  expect([to(at('words', 3), 'ArrowDown'), to(at('gestures', 1), 'ArrowDown'), to(at('words', 0), 'ArrowUp')]).toEqual([at('utterances', 1), at('phases.0', 4), undefined]);
  expect(to(at('words', 0), 'x')).toBeUndefined();
});

test('only spans in view are drawn, and the selected one', () => {
  const [words] = tracksOf(sample());
  expect(inView(words?.spans ?? [], 0.95, 1.1, 0, at('words', 3)).map(({ label }) => label)).toEqual(['a', 'time']);
  // From afar, short ones hide each other.
  expect(inView(words?.spans ?? [], 0, 9, 0.35, undefined).map(({ label }) => label)).toEqual(['once', 'a', 'time']);
});

test('the time under the pointer stays there when the scale changes', () => {
  const view = { from: 10, scale: 100, width: 500 };
  const near = zoomed(view, 2, 250, 60);
  expect([near.scale, near.from + 250 / near.scale]).toEqual([200, 12.5]);
  // The whole length is the smallest scale, and its ends are those of the view.
  expect(zoomed(view, 0.001, 250, 60)).toEqual({ from: 0, scale: fitted(60, 500), width: 500 });
  expect(toOf(zoomed({ ...view, from: 56 }, 0.5, 0, 60))).toBeCloseTo(60, 9);
});

test('a span is scrolled into view only if it is not there', () => {
  const view = { from: 10, scale: 100, width: 500 };
  expect(revealed(view, 11, 12, 60)).toBe(10);
  expect([revealed(view, 20, 21, 60) + 5, revealed(view, 5, 6, 60)]).toEqual([21.4, 4.6]);
  expect(revealed(view, 20, 40, 60)).toBe(19.6);
});

test('marks of the axis have room, and round times', () => {
  expect(marks({ from: 0.3, scale: 100, width: 300 }).map(({ text }) => text)).toEqual(['1', '2', '3']);
  expect(marks({ from: 61.01, scale: 800, width: 200 }).map(({ text }) => text)).toEqual(['1:01.1', '1:01.2']);
  expect([clock(0), clock(59.999), clock(75.2), clock(125, 0)]).toEqual(['0.00', '1:00.00', '1:15.20', '2:05']);
});

test('recordings and annotations are told apart by type, and by name', () => {
  const file = (name: string, type = ''): File => new File([], name, { type });
  const { annotation, recording } = chosen([file('a.mov'), file('a.anvil')]);
  expect([annotation?.name, recording?.name]).toEqual(['a.anvil', 'a.mov']);
  expect(chosen([file('a', 'audio/wav')]).annotation).toBeUndefined();
});
