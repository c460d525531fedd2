import { afterEach, beforeAll, beforeEach, expect, test, vi } from 'vitest';
import type { NarrationFunctions } from '../element/engine/backend.js';
import { tellTo, type NarrationContext } from '../element/story/narration.js';
import type { Answer } from '../element/base/performance.js';
import type { Diagnostic } from '../element/base/types.js';
import { COMPILE_MS, openBuild } from './build.js';

/** Splits a text into pieces at positions given by a seed. */
function pieces(text: string, seed: number): string[] {
  const all: string[] = [];
  let state = seed;
  for (let from = 0; from < text.length; ) {
    state = (state * 1103515245 + 12345) % 2 ** 31;
    const to = from + 1 + (state % 7);
    all.push(text.slice(from, to));
    from = to;
  }
  return all;
}

async function* coming(all: readonly string[], fails = false): AsyncGenerator<string> {
  for (const piece of all) yield await Promise.resolve(piece);
  if (fails) throw new Error('the line is dead');
}

let telling: NarrationFunctions;
let fragments: string[];
let reports: Diagnostic[];
let answer: (index: number) => Answer;
let startMs: number;

/** Stage on which each fragment takes a second, one after another, on the fake clock. */
const stage: NarrationContext = {
  get telling() {
    return telling;
  },
  language: 'en',
  perform: (fragment) => {
    const given = answer(fragments.length);
    if (given.kind === 'accepted') fragments.push(fragment);
    return [given];
  },
  now: () => (Date.now() - startMs) / 1000,
  report: (diagnostic) => reports.push(diagnostic),
};

const accepted = (index: number): Answer => ({
  kind: 'accepted',
  timeSecs: index,
  fragment: index + 1,
  clauses: [{ clause: 0, element: 'voice-text', startSecs: index, endSecs: index + 1 }],
});

/** Returns the words of the spoken text. */
const said = (): string => fragments.map((fragment) => (fragment.match(/<div[^>]*>(.*?)<\/div>/gs) ?? []).join(' ').replace(/<[^>]*>/g, '')).join(' | ');

beforeAll(async () => {
  telling = await openBuild<NarrationFunctions>();
}, COMPILE_MS);

beforeEach(() => {
  vi.useFakeTimers();
  startMs = Date.now();
  [fragments, reports, answer] = [[], [], accepted];
});

afterEach(() => {
  vi.useRealTimers();
});

test('each clause is performed as soon as it is whole', async () => {
  let next: ((piece: string) => void) | undefined;
  async function* slow(): AsyncGenerator<string> {
    for (;;) yield await new Promise<string>((done) => (next = done));
  }
  const end = new AbortController();
  const done = tellTo(stage, slow(), end.signal);
  for (const [piece, count] of [
    ['Hello', 0],
    [' there!', 0],
    [' How', 1],
    [' are you? ', 2],
  ] as const) {
    await vi.waitFor(() => expect(next).toBeDefined());
    const give = next;
    next = undefined;
    give?.(piece);
    await vi.waitFor(() => expect(fragments).toHaveLength(count));
  }
  end.abort();
  await done;
  expect(said()).toBe('Hello there! | How are you?');
});

test('it is done when everything has been said, and no more waits than a while', async () => {
  let over = false;
  const text = 'One more thing happened. '.repeat(60);
  const done = tellTo(stage, coming(pieces(text, 3)), new AbortController().signal).then(() => (over = true));
  await vi.advanceTimersByTimeAsync(100);
  expect(fragments.length).toBeLessThan(25);
  await vi.advanceTimersByTimeAsync(58_000);
  expect(fragments).toHaveLength(60);
  expect(over).toBe(false);
  await vi.advanceTimersByTimeAsync(3_000);
  await done;
});

test('what fails on its way is told when what came has been said', async () => {
  const done = tellTo(stage, coming(['It came so far. And th', 'en'], true), new AbortController().signal);
  const failed = expect(done).rejects.toThrow('the line is dead');
  await vi.advanceTimersByTimeAsync(5_000);
  await failed;
  expect(said()).toBe('It came so far. | And then');
});

test('an interruption ends it at once, and lets its source go', async () => {
  const end = new AbortController();
  let cancelled = false;
  const words = new ReadableStream<string>({
    start: (controller) => controller.enqueue('It came so far. And then '),
    cancel: () => void (cancelled = true),
  });
  const done = tellTo(stage, words, end.signal);
  await vi.advanceTimersByTimeAsync(100);
  end.abort();
  await done;
  expect(said()).toBe('It came so far.');
  expect(cancelled).toBe(true);
});

test('an engine that is busy is asked again, and what it refuses is left out', async () => {
  let asked = 0;
  answer = (index) => {
    asked += 1;
    if (asked < 5) return { kind: 'failed', timeSecs: 0, code: 'live::busy', message: '' };
    return asked === 5 ? { kind: 'failed', timeSecs: 0, code: 'live::interrupted', message: '' } : accepted(index);
  };
  const done = tellTo(stage, 'First this. Then that.', new AbortController().signal);
  await vi.advanceTimersByTimeAsync(5_000);
  await done;
  expect(said()).toBe('Then that.');
});

test('a text without end is told so far', async () => {
  async function* endless(): AsyncGenerator<string> {
    for (;;) yield await Promise.resolve(`${'word '.repeat(40)}. `);
  }
  // The speech rate is unrealistic; the test is about the length.
  answer = (index) => ({ ...accepted(index), clauses: [{ clause: 0, element: 'voice-text', startSecs: 0, endSecs: 0 }] }) as Answer;
  await tellTo(stage, endless(), new AbortController().signal);
  expect(reports.map(({ code }) => code)).toEqual(['tell-too-long']);
  expect(said().length).toBeLessThan(110_000);
  expect(said().length).toBeGreaterThan(90_000);
});

test('feelings last as long as the text has them, over its clauses', async () => {
  const done = tellTo(stage, 'You came! :) I waited all day long. And then you left. :( So it is.', new AbortController().signal);
  await vi.advanceTimersByTimeAsync(10_000);
  await done;
  const felt = fragments.map((fragment) => /<r:emotion[^>]*type='(\w+)'/.exec(fragment)?.[1]);
  expect(felt[0]).toBe('joy');
  expect(felt).toContain('distress');
  expect(felt.at(-1) === undefined || felt.at(-1) === 'neutral').toBe(true);
});
