/** Steps of the specification that web-platform-tests does not cover separately: order of tasks, speeds, seeks, released resources. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

/** Returns the progress of the story over a period, as a share of the progress at that speed; the speed changes during playback. */
const passed = async ({ media, loaded, until, wait }: Kit<Video>, rate: number) => {
  await loaded();
  await media.play();
  await until(() => media.currentTime > 0.1);
  media.playbackRate = rate;
  await wait(60);
  const [from, since] = [media.currentTime, performance.now()];
  await wait(250);
  const secs = (media.currentTime - from) / rate;
  const share = (1000 * secs) / (performance.now() - since);
  return [media.paused, media.playbackRate === rate, share > 0.6 && share < 1.4];
};

const speeds: readonly Row[] = [
  ...[0.25, 4].map((rate) => ({ test: `specification#${rate} times the speed`, ask: passed, given: rate, expected: [false, true, true] })),
  {
    test: 'specification#at the speed 0 time stands still, and it is not paused',
    ask: async ({ media, loaded, until, wait, follow }) => {
      await loaded();
      await media.play();
      const told = follow('pause', 'waiting', 'ended');
      await until(() => media.currentTime > 0.2);
      media.playbackRate = 0;
      await wait(150);
      const at = media.currentTime;
      await wait(300);
      const stands = [media.paused, media.ended, media.currentTime === at];
      media.playbackRate = 1;
      return [stands, await until(() => media.currentTime > at + 0.1), media.paused, told];
    },
    expected: [[false, false, true], true, false, []],
  },
  {
    test: 'specification#played at the speed 0',
    ask: async ({ media, loaded, wait, until, settle }) => {
      await loaded();
      media.playbackRate = 0;
      const played = await settle(media.play());
      await wait(200);
      const at = [media.paused, media.currentTime];
      media.currentTime = 0.5;
      await wait(200);
      const sought = media.currentTime;
      media.playbackRate = 1;
      return [played, at, sought, await until(() => media.currentTime > 0.6)];
    },
    expected: ['kept', [false, 0], 0.5, true],
  },
  ...[1, 1.5].map((usual) => ({
    test: `specification#load() returns the speed to a default of ${usual}`,
    ask: async ({ media, loaded, wait }: Kit<Video>, usual: number) => {
      await loaded();
      media.defaultPlaybackRate = usual;
      media.playbackRate = 2;
      await wait(50);
      media.load();
      return media.playbackRate;
    },
    given: usual,
    expected: usual,
  })),
  {
    test: 'specification#another src returns the speed to its default',
    ask: async ({ media, loaded, other, event }) => {
      await loaded();
      media.playbackRate = 2;
      const there = event('loadedmetadata');
      media.src = other;
      await there;
      return media.playbackRate;
    },
    expected: 1,
  },
];

const tasks: readonly Row[] = [
  {
    test: 'specification#events come in tasks, not in microtasks',
    ask: async ({ media, follow, wait }) => {
      const told = follow('volumechange');
      media.volume = 0.5;
      for (let i = 0; i < 20; i++) await Promise.resolve();
      const soon = told.length;
      await wait(20);
      return [soon, told.length];
    },
    expected: [0, 1],
  },
  {
    test: 'specification#each event has a task of its own',
    ask: async ({ media, good, event }) => {
      const seen: string[] = [];
      media.addEventListener('loadedmetadata', () => void Promise.resolve().then(() => seen.push('microtask')));
      media.addEventListener('loadeddata', () => seen.push('loadeddata'));
      const there = event('canplay');
      media.src = good;
      await there;
      return seen;
    },
    expected: ['microtask', 'loadeddata'],
  },
  {
    test: 'specification#play() is kept after playing is told',
    ask: async ({ media, loaded }) => {
      await loaded();
      const seen: string[] = [];
      for (const type of ['play', 'playing']) media.addEventListener(type, () => seen.push(type));
      await media.play().then(() => seen.push('kept'));
      return seen;
    },
    expected: ['play', 'playing', 'kept'],
  },
  {
    test: 'specification#play() is broken after pause is told',
    ask: async ({ media, good, settle, follow }) => {
      media.src = good;
      const seen = follow('play', 'pause');
      const played = settle(media.play()).then((name) => seen.push(name));
      media.pause();
      await played;
      return seen;
    },
    expected: ['play', 'pause', 'AbortError'],
  },
  {
    test: 'specification#play() while it plays is kept',
    ask: async ({ media, loaded, settle }) => {
      await loaded();
      await media.play();
      return await settle(media.play());
    },
    expected: 'kept',
  },
  {
    test: 'specification#another src breaks a play() that waits',
    ask: async ({ media, good, other, settle }) => {
      media.src = good;
      const played = settle(media.play());
      media.src = other;
      return await played;
    },
    expected: 'AbortError',
  },
  {
    test: 'specification#load() breaks a play() that waits',
    ask: async ({ media, good, event, settle }) => {
      const begins = event('loadstart');
      media.src = good;
      const played = settle(media.play());
      await begins;
      media.load();
      return await played;
    },
    expected: 'AbortError',
  },
  {
    test: 'specification#error is an Event, and error tells why',
    ask: async ({ media, absent, event }) => {
      const failed = event('error') as Promise<Event>;
      media.src = absent;
      const told = await failed;
      return [told.constructor.name, 'message' in told, media.error?.code, typeof media.error?.message];
    },
    expected: ['Event', false, 4, 'string'],
  },
];

const seeks: readonly Row[] = [
  {
    test: 'specification#sought to the end while paused',
    ask: async ({ media, loaded, event, wait, follow, settle, until }) => {
      await loaded();
      const told = follow('seeking', 'seeked', 'pause', 'ended');
      const over = event('seeked');
      media.currentTime = media.duration;
      await over;
      await wait(300);
      const state = [media.ended, media.paused, media.currentTime === media.duration];
      const seen = [...told];
      const played = await settle(media.play());
      return [state, seen, played, await until(() => media.currentTime > 0.05 && media.currentTime < 1), media.ended];
    },
    expected: [[true, true, true], ['seeking', 'seeked'], 'kept', true, false],
  },
  {
    test: 'specification#sought away from the end',
    ask: async ({ media, loaded, event }) => {
      await loaded();
      const over = event('seeked');
      media.currentTime = media.duration;
      await over;
      const sought = event('seeked');
      media.currentTime = 0.5;
      await sought;
      return [media.ended, media.paused, media.currentTime];
    },
    expected: [false, true, 0.5],
  },
  {
    test: 'specification#two seeks have one end',
    ask: async ({ media, loaded, wait, follow }) => {
      await loaded();
      const told = follow('seeking', 'seeked');
      media.currentTime = 0.4;
      media.currentTime = 0.9;
      await wait(300);
      return [told, media.currentTime, media.seeking];
    },
    expected: [['seeking', 'seeking', 'seeked'], 0.9, false],
  },
  {
    test: 'specification#an early negative time',
    ask: async ({ make, media, good, event }) => {
      const early = make();
      early.currentTime = -1;
      media.currentTime = -1;
      const there = event('canplaythrough');
      media.src = good;
      await there;
      return [early.currentTime, media.currentTime];
    },
    expected: [-1, 0],
  },
  ...(['buffered', 'seekable', 'played'] as const).map((name) => ({
    test: `specification#${name} asked for no range`,
    ask: ({ media, thrown }: Kit<Video>, name: 'buffered' | 'seekable' | 'played') => {
      const ranges = media[name] as unknown as { start(): number; end(): number };
      return [thrown(() => ranges.start()), thrown(() => ranges.end())];
    },
    given: name,
    expected: ['TypeError', 'TypeError'],
  })),
];

const gone: readonly Row[] = [
  {
    test: 'specification#without its src it goes on playing',
    ask: async ({ media, loaded, follow, until }) => {
      await loaded();
      await media.play();
      const told = follow('emptied', 'abort', 'pause', 'error');
      media.removeAttribute('src');
      const at = media.currentTime;
      return [await until(() => media.currentTime > at + 0.2), media.paused, media.src, told];
    },
    expected: [true, false, '', []],
  },
  {
    test: 'specification#without its src load() lets go of it',
    ask: async ({ media, loaded, wait }) => {
      await loaded();
      media.removeAttribute('src');
      media.load();
      await wait(100);
      return [media.readyState, Number.isNaN(media.duration), media.paused];
    },
    expected: [0, true, true],
  },
];

export const theme: Theme = { name: 'steps of the specification', control: 'audio', rows: [...speeds, ...tasks, ...seeks, ...gone] };
