/** Moving to another time, and the ranges of time. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const offsets = 'offsets-into-the-media-resource/';

/** Returns the position and the seeking state after the time was set. */
const sought = async ({ media, loaded, event }: Kit<Video>, to: 'same' | 'less' | 'most' | number) => {
  await loaded();
  const before = [media.seeking, media.seekable.length];
  const there = event('seeked').then(() => media.seeking);
  media.currentTime = typeof to === 'number' ? to : { same: media.currentTime, less: -1, most: Number.MAX_VALUE }[to];
  const at = [media.currentTime === media.seekable.end(0), media.currentTime, media.seeking];
  return [before, at[2], to === 'most' ? at[0] : at[1], await there, media.currentTime === (to === 'most' ? media.duration : at[1])];
};

const rows: readonly Row[] = [
  { test: 'seeking/seek-to-negative-time.htm', ask: sought, given: 'less', expected: [[false, 1], true, 0, false, true] },
  { test: 'seeking/seek-to-max-value.htm', ask: sought, given: 'most', expected: [[false, 1], true, true, false, true] },
  { test: `${offsets}currentTime.html#setting when readyState is greater than HAVE_NOTHING`, ask: sought, given: 1, expected: [[false, 1], true, 1, false, true] },
  {
    test: `${offsets}currentTime.html#setting to precise number`,
    ask: sought,
    given: 0.12345678912367891,
    expected: [[false, 1], true, 0.12345678912367891, false, true],
    uncontrolled: 'Chromium counts in microseconds',
  },
  {
    test: `${offsets}currentTime.html#setting when readyState is HAVE_NOTHING`,
    ask: ({ make }) => {
      const media = make();
      media.currentTime = Number.MAX_VALUE;
      return [media.readyState, media.currentTime === Number.MAX_VALUE, media.seeking];
    },
    expected: [0, true, false],
  },
  {
    test: `${offsets}currentTime.html#setting out of bounds`,
    ask: async ({ media, loaded }) => {
      await loaded();
      media.currentTime = Number.MAX_VALUE;
      return [media.currentTime === media.duration, media.seeking];
    },
    expected: [true, true],
  },
  {
    test: 'seeking/seek-to-currentTime.html',
    ask: async ({ media, loaded, event }) => {
      await loaded();
      const told: (string | boolean)[][] = [];
      for (const type of ['seeking', 'timeupdate', 'seeked']) {
        media.addEventListener(type, () => told.push(type === 'seeking' ? [type] : [type, media.seeking]));
      }
      const there = event('seeked');
      const { currentTime } = media;
      media.currentTime = currentTime;
      const atOnce = media.seeking;
      await there;
      return [atOnce, told];
    },
    expected: [true, [['seeking'], ['timeupdate', false], ['seeked', false]]],
  },
  {
    test: 'video_007.htm',
    ask: async ({ media, good, event }) => {
      media.autoplay = true;
      const there = event('seeked').then(() => media.currentTime);
      media.addEventListener(
        'play',
        () => {
          media.pause();
          media.currentTime = -1;
        },
        { once: true },
      );
      media.src = good;
      return await there;
    },
    expected: 0,
  },
  {
    test: 'video_timeupdate_on_seek.html',
    ask: async ({ media, loaded, event }) => {
      await loaded();
      const told = event('timeupdate').then(() => media.currentTime);
      media.currentTime = 0.5;
      return await told;
    },
    expected: 0.5,
  },
  {
    test: 'specification#currentTime takes finite numbers only',
    ask: ({ media, thrown }) => [NaN, Infinity, -Infinity, 'later' as unknown as number].map((secs) => thrown(() => (media.currentTime = secs))),
    expected: ['TypeError', 'TypeError', 'TypeError', 'TypeError'],
  },
  {
    test: 'specification#fastSeek',
    ask: async ({ media, loaded, event, thrown }) => {
      await loaded();
      const there = event('seeked');
      media.fastSeek(0.5);
      await there;
      return [media.currentTime, thrown(() => media.fastSeek(NaN))];
    },
    expected: [0.5, 'TypeError'],
    uncontrolled: 'Chromium has no fastSeek',
  },
  ...(['buffered', 'seekable', 'played'] as const).map((name) => ({
    test: `specification#${name} of nothing`,
    ask: ({ make, thrown }: Kit<Video>, name: 'buffered' | 'seekable' | 'played') => {
      const ranges = make()[name];
      return [ranges.length, thrown(() => ranges.start(0)), thrown(() => ranges.end(0))];
    },
    given: name,
    expected: [0, 'IndexSizeError', 'IndexSizeError'],
  })),
  {
    test: 'specification#buffered and seekable',
    ask: async ({ media, loaded }) => {
      await loaded();
      const { buffered, seekable } = media;
      return [buffered.start(0), buffered.end(0) > 0, seekable.length, seekable.start(0), Math.abs(seekable.end(0) - media.duration) < 0.1];
    },
    expected: [0, true, 1, 0, true],
  },
  {
    test: 'specification#played',
    ask: async ({ media, loaded, until }) => {
      await loaded();
      const before = media.played.length;
      await media.play();
      await until(() => media.currentTime > 0.2);
      media.pause();
      return [before, media.played.length, media.played.start(0), media.played.end(0) >= 0.2];
    },
    expected: [0, 1, 0, true],
  },
  {
    test: 'specification#duration at durationchange',
    ask: async ({ media, good, event }) => {
      const told = event('durationchange').then(() => Math.abs(media.duration - 1.5) < 0.1);
      media.src = good;
      return await told;
    },
    expected: true,
  },
];

export const theme: Theme = { name: 'seeking', control: 'audio', rows };
