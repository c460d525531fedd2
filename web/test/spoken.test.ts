import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { SpokenSource } from '../element/sound/spoken.js';
import type { Utterance } from '../element/base/types.js';

/** Fake speech synthesis that records the texts to speak. */
class FakeSpeech {
  voice: { name: string } | null = null;
  lang = '';
  rate = 1;
  volume = 1;
  onstart?: () => void;
  onend?: () => void;
  onerror?: (event: { error: string }) => void;
  constructor(readonly text: string) {}
}

const voice = (name: string, lang: string, localService = true) => ({ name, lang, localService, default: false });

let voices: ReturnType<typeof voice>[];
let said: FakeSpeech[];
let cancelled: number;
let told: string[];
let comes: (() => void) | undefined;

beforeEach(() => {
  vi.useFakeTimers();
  voices = [voice('Far', 'en-US', false), voice('Ann', 'en_GB'), voice('Max', 'de-DE')];
  [said, cancelled, told, comes] = [[], 0, [], undefined];
  vi.stubGlobal('SpeechSynthesisUtterance', FakeSpeech);
  vi.stubGlobal('speechSynthesis', {
    getVoices: () => voices,
    addEventListener: (_: string, listener: () => void) => (comes = listener),
    speak: (speech: FakeSpeech) => said.push(speech),
    cancel: () => (cancelled += 1),
  });
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** Returns an utterance of two seconds, with words of equal length. */
function utterance(startSecs: number, text: string, more: Partial<Utterance> = {}): Utterance {
  const texts = text.split(' ');
  const length = 2 / texts.length;
  const words = texts.map((word, i) => ({ text: word, startSecs: startSecs + i * length, endSecs: startSecs + (i + 1) * length, emphasized: false }));
  return { startSecs, durationSecs: 2, audio: [], words, estimated: true, ...more };
}

const find = (utterances: Utterance[], language = 'en-GB', voice?: string) => SpokenSource.find(utterances, { language, voice }, (why) => told.push(why));

test('the voice that a story names says it, unless a part is in another language or names another', async () => {
  const all = [utterance(1, 'One'), utterance(4, 'Two', { voice: 'ann' }), utterance(7, 'Drei', { language: 'de' }), utterance(10, 'Four', { voice: 'nobody' })];
  const by = async (voice?: string) => {
    const spoken = await find(all, 'en-GB', voice);
    said.length = 0;
    spoken.start(1);
    for (const { startSecs } of all) {
      spoken.prepare(startSecs);
      said.at(-1)?.onend?.();
    }
    spoken.stop();
    return said.map((s) => s.voice?.name);
  };
  expect(await by()).toEqual(['Ann', 'Ann', 'Max', 'Ann']);
  // A voice of another language counts as chosen, too.
  expect(await by('Max')).toEqual(['Max', 'Ann', 'Max', 'Ann']);
});

test('each utterance is said when its time comes, by a voice of its language', async () => {
  const spoken = await find([utterance(1, 'One two'), utterance(4, 'Drei vier', { language: 'de' }), utterance(7, 'Cinq six', { language: 'fr' })]);
  expect(spoken.name).toBe('Ann');
  spoken.setVolume(0.5);
  spoken.start(1.5);
  spoken.prepare(0.5);
  expect(said).toEqual([]);
  spoken.prepare(1);
  spoken.prepare(1.1);
  expect(said.map((s) => [s.text, s.voice?.name, s.rate, s.volume])).toEqual([['One two', 'Ann', 1.5, 0.5]]);
  said[0]?.onend?.();
  spoken.prepare(1.5);
  expect(said).toHaveLength(1);
  spoken.prepare(4);
  expect(said[1]?.voice?.name).toBe('Max');
  said[1]?.onend?.();
  // There is no French voice here.
  spoken.prepare(7);
  expect(said).toHaveLength(2);
  expect(spoken.ready(9.5)).toBe(true);
});

test('a voice of the same region is better than one of another, and one of this machine than one far away', async () => {
  voices = [voice('Far', 'en-GB', false), voice('Near', 'en-US'), voice('Here', 'en-GB')];
  expect((await find([utterance(0, 'One')])).name).toBe('Here');
  expect((await find([utterance(0, 'One')], 'en')).name).toBe('Near');
  expect((await find([utterance(0, 'One')], 'sw')).name).toBeUndefined();
  expect((await find([])).name).toBeUndefined();
});

test('what has a recording is left to it', async () => {
  const spoken = await find([utterance(0, 'One two', { audio: [{ file: 'a.opus', mime: 'audio/ogg' }] })]);
  spoken.start(1);
  spoken.prepare(0.5);
  expect(said).toEqual([]);
});

test('from the middle, after a seek or a pause, it goes on with the present word', async () => {
  const spoken = await find([utterance(0, 'One two three four')]);
  spoken.start(1);
  spoken.prepare(0.1);
  spoken.stop();
  expect(cancelled).toBe(1);
  // The end event of a cancelled utterance does not end the current one.
  said[0]?.onend?.();
  spoken.start(1);
  spoken.prepare(1.2);
  expect(said.map((s) => s.text)).toEqual(['One two three four', 'three four']);
});

test('muting ends it at once, and unmuting goes on with the present word', async () => {
  const spoken = await find([utterance(0, 'One two three four')]);
  spoken.start(1);
  spoken.prepare(0.1);
  spoken.setVolume(0);
  expect(cancelled).toBe(1);
  spoken.prepare(0.2);
  expect(said).toHaveLength(1);
  spoken.setVolume(1);
  spoken.prepare(1.6);
  expect(said.at(-1)?.text).toBe('four');
});

test('the story waits for one that is late, but not for ever', async () => {
  const spoken = await find([utterance(0, 'One two'), utterance(2, 'Three four')]);
  spoken.start(1);
  spoken.prepare(0);
  expect(spoken.ready(1.9)).toBe(true);
  expect(spoken.ready(2.01)).toBe(false);
  spoken.stop(true);
  expect(cancelled).toBe(0);
  vi.advanceTimersByTime(600);
  expect(spoken.ready(2.01)).toBe(false);
  said[0]?.onend?.();
  expect(spoken.ready(2.01)).toBe(true);
  spoken.start(1);
  spoken.prepare(2.01);
  expect(said.at(-1)?.text).toBe('Three four');
  // This one never ends.
  expect(spoken.ready(4)).toBe(false);
  // A page that was busy for long received no end event; that alone is no reason to give up.
  vi.advanceTimersByTime(10_000);
  expect(spoken.ready(4)).toBe(false);
  let looks = 0;
  for (; looks < 100 && !spoken.ready(4); looks += 1) vi.advanceTimersByTime(100);
  // 2.5 s are waited, of which the long one counts as 0.3.
  expect(looks).toBe(22);
  expect(cancelled).toBe(1);
});

test('the next is asked to be faster when the last took too long', async () => {
  const spoken = await find([utterance(0, 'One two'), utterance(3, 'Three four')]);
  spoken.start(1);
  spoken.prepare(0);
  said[0]?.onstart?.();
  vi.advanceTimersByTime(2880);
  said[0]?.onend?.();
  spoken.prepare(3);
  expect(said[1]?.rate).toBeCloseTo(1.2, 5);
});

test('a browser that reads its voices late is waited for, one without voices is not', async () => {
  voices = [];
  const late = find([utterance(0, 'One')]);
  voices = [voice('Ann', 'en-GB')];
  comes?.();
  expect((await late).name).toBe('Ann');
  voices = [];
  const none = find([utterance(0, 'One')]);
  vi.advanceTimersByTime(1000);
  expect((await none).name).toBeUndefined();
});

test('a browser that refuses to speak is complained of once', async () => {
  const spoken = await find([utterance(0, 'One two'), utterance(2, 'Three'), utterance(4, 'Four')]);
  spoken.start(1);
  for (const [i, error] of ['interrupted', 'not-allowed', 'not-allowed'].entries()) {
    spoken.prepare(i * 2);
    said[i]?.onerror?.({ error });
    expect(spoken.ready(i * 2 + 2)).toBe(true);
  }
  expect(told).toHaveLength(1);
  expect(told[0]).toContain('not-allowed');
});
