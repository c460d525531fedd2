import { beforeEach, expect, test } from 'vitest';
import type { Voice } from '../element/sound/voice.js';
import { Transport } from '../element/media/transport.js';

/** Voice with a manual clock and a latency of 0.1 s. */
class FakeVoice implements Voice {
  time = 100;
  running = true;
  missingFrom = Infinity;
  starts: { position: number; rate: number; at: number }[] = [];
  stops = 0;

  now = () => this.time;
  heard = () => this.time - 0.1;
  start = (position: number, rate: number, at: number) => void this.starts.push({ position, rate, at });
  stop = () => void (this.stops += 1);
  prepare = () => undefined;
  ready = (position: number) => position < this.missingFrom;
  setVolume = () => undefined;
  keepPitch = () => undefined;
  setDevice = () => undefined;
  track = () => undefined;
  missing = () => [];
  readonly come = 0;
  setMusic = () => undefined;
  give = () => undefined;
  hold = () => undefined;
  cut = () => undefined;
  forget = () => undefined;
  substitute = () => Promise.resolve(undefined);
  close = () => undefined;
}

let voice: FakeVoice;
let events: string[];
let transport: Transport;

beforeEach(() => {
  voice = new FakeVoice();
  events = [];
  transport = new Transport(voice, 10, (event) => events.push(event));
});

test("plays on the voice's clock, as it is heard", () => {
  transport.play();
  expect(events).toEqual(['play', 'playing']);
  expect(transport.position).toBe(0);
  voice.time += 2.13;
  // 0.03 s of lead and 0.1 s of latency.
  expect(transport.update()).toBeCloseTo(2, 9);
});

test('what is not there yet is not passed, however slowly pictures come', () => {
  voice.missingFrom = 2.5;
  transport.play();
  voice.time += 1.13;
  expect(transport.update()).toBeCloseTo(1, 9);
  voice.time += 4;
  expect(transport.update()).toBeLessThan(2.5);
  expect(transport.position).toBeGreaterThan(2.49);
  expect(transport.waiting).toBe(true);
  voice.missingFrom = Infinity;
  transport.update();
  expect(voice.starts.at(-1)?.position).toBeCloseTo(transport.position, 9);
});

test('pausing keeps what was heard, and playing goes on from there', () => {
  transport.play();
  voice.time += 1.13;
  transport.pause();
  voice.time += 50;
  expect(transport.position).toBeCloseTo(1, 9);
  transport.play();
  expect(voice.starts.at(-1)?.position).toBeCloseTo(1, 9);
});

test('seeking while playing starts the sound in the middle of a word', () => {
  transport.play();
  transport.seek(4.321);
  expect(voice.starts.at(-1)?.position).toBe(4.321);
  expect(transport.position).toBe(4.321);
  expect(events.slice(-3)).toEqual(['seeking', 'playing', 'seeked']);
});

test('seeking outside the story goes to its ends', () => {
  transport.seek(99);
  expect(transport.position).toBe(10);
  transport.seek(-1);
  expect(transport.position).toBe(0);
  transport.seek(NaN);
  expect(transport.position).toBe(0);
});

test('a new speed goes on from the same place', () => {
  transport.play();
  voice.time += 3.13;
  transport.setRate(2);
  expect(voice.starts.at(-1)).toMatchObject({ rate: 2 });
  voice.time += 1.13;
  expect(transport.position).toBeCloseTo(5, 9);
});

test('a clock that steps back does not move the story back', () => {
  transport.play();
  voice.time += 2;
  const before = transport.position;
  voice.time -= 0.02;
  expect(transport.position).toBe(before);
});

test('waits for sound that is not there, rather than drift', () => {
  voice.missingFrom = 2;
  transport.play();
  voice.time += 2.2;
  transport.update();
  expect(transport.waiting).toBe(true);
  const held = transport.position;
  voice.time += 5;
  expect(transport.update()).toBe(held);
  voice.missingFrom = Infinity;
  transport.update();
  expect(transport.waiting).toBe(false);
  voice.time += 1.13;
  expect(transport.position).toBeCloseTo(held + 1, 9);
  expect(events.filter((e) => e === 'waiting' || e === 'playing')).toEqual(['playing', 'waiting', 'playing']);
});

test('at the speed 0 it plays and stands still, and goes on at another', () => {
  transport.play();
  voice.time += 2.13;
  transport.setRate(0);
  voice.time += 5;
  expect([transport.update(), transport.paused, transport.waiting]).toEqual([expect.closeTo(2, 9), false, false]);
  transport.seek(3);
  voice.time += 5;
  expect(transport.update()).toBe(3);
  transport.setRate(0.25);
  expect(voice.starts.at(-1)).toMatchObject({ position: 3, rate: 0.25 });
  voice.time += 4.13;
  expect(transport.update()).toBeCloseTo(4, 9);
  expect(events).toEqual(['play', 'playing', 'ratechange', 'seeking', 'playing', 'seeked', 'ratechange']);
});

test('sought to its end at rest it has ended, and in a loop it is at its beginning', () => {
  transport.seek(10);
  expect([transport.ended, transport.position]).toEqual([true, 10]);
  transport.seek(4);
  expect(transport.ended).toBe(false);
  transport.loop = true;
  transport.seek(10);
  expect([transport.ended, transport.position]).toEqual([false, 0]);
  expect(events).toEqual(['seeking', 'seeked', 'seeking', 'seeked', 'seeking', 'seeking', 'seeked']);
});

test('ends once, and plays again from the start', () => {
  transport.play();
  voice.time += 20;
  expect(transport.update()).toBe(10);
  transport.update();
  expect(events.filter((e) => e === 'ended')).toHaveLength(1);
  expect([transport.ended, transport.paused]).toEqual([true, true]);
  transport.play();
  expect(voice.starts.at(-1)?.position).toBe(0);
});

test('a loop begins again by itself', () => {
  transport.loop = true;
  transport.play();
  voice.time += 20;
  transport.update();
  expect(transport.paused).toBe(false);
  expect(voice.starts.at(-1)?.position).toBe(0);
  expect(events).not.toContain('ended');
});

test('an empty story ends, also in a loop', () => {
  // Like the element, the test renders a seek immediately.
  const told: string[] = [];
  const empty = new Transport(voice, 0, (event) => {
    told.push(event);
    if (event === 'seeked') empty.update();
  });
  empty.loop = true;
  empty.play();
  voice.time += 1;
  empty.update();
  expect([empty.ended, empty.paused]).toEqual([true, true]);
  expect(told).toEqual(['play', 'playing', 'pause', 'ended']);
  // It may be played again, and ends again.
  empty.play();
  voice.time += 1;
  empty.update();
  expect(empty.ended).toBe(true);
});

test('a loop that is paused as it begins again stays paused', () => {
  const looping: Transport = new Transport(voice, 10, (event) => event === 'seeking' && looping.pause());
  looping.loop = true;
  looping.play();
  voice.time += 20;
  looping.update();
  voice.time += 5;
  expect([looping.paused, looping.position]).toEqual([true, 0]);
});

test('waits while what plays the sound does not run, be it suspended or another one', () => {
  transport.play();
  voice.time += 1.13;
  voice.running = false;
  const held = transport.update();
  expect([transport.waiting, transport.paused]).toEqual([true, false]);
  // The clock of another context begins at 0.
  voice.time = 0;
  expect(transport.update()).toBe(held);
  voice.running = true;
  transport.update();
  expect(voice.starts.at(-1)?.position).toBe(held);
  voice.time += 1.13;
  expect(transport.position).toBeCloseTo(held + 1, 9);
  expect(events).toEqual(['play', 'playing', 'waiting', 'playing']);
});

test('an open-ended performance goes on past its end and keeps what it has come to', () => {
  transport.openEnded = true;
  transport.play();
  voice.time += 15.13;
  expect(transport.update()).toBeCloseTo(15, 9);
  expect([transport.ended, transport.endSecs]).toEqual([false, transport.position]);
  transport.openEnded = false;
  voice.time += 1;
  transport.update();
  expect(transport.ended).toBe(true);
  expect(transport.position).toBeCloseTo(15, 9);
  // The performance is extended, so playback continues from there.
  transport.extend(20);
  expect(transport.ended).toBe(false);
  transport.play();
  expect(transport.position).toBeCloseTo(15, 9);
});
