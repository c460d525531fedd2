/** Rows about playing, pausing, repeating, and moving or removing the element. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const playing = 'playing-the-media-resource/';
const autoplaying = 'ready-states/autoplay.html#';

/** Returns true if an event occurs when it plays, automatically or by a call, with the state at that time. */
const comes = async ({ media, good, event, settle }: Kit<Video>, { type, autoplay }: { type: string; autoplay: boolean }) => {
  media.autoplay = autoplay;
  const told = (event(type) as Promise<Event>).then(({ bubbles }) => [bubbles, media.paused]);
  if (type === 'pause' && autoplay) media.addEventListener('playing', () => media.pause(), { once: true });
  media.src = good;
  const played = autoplay ? undefined : settle(media.play());
  if (type === 'pause' && !autoplay) media.pause();
  return [await told, (await played) ?? 'by itself'];
};

const EVENTS = ['play', 'playing', 'timeupdate', 'pause'];

const events: readonly Row[] = EVENTS.flatMap((type) => [
  { test: `event_${type}.html`, ask: comes, given: { type, autoplay: true }, expected: [[false, type === 'pause'], 'by itself'] },
  {
    test: `event_${type}_noautoplay.html`,
    ask: comes,
    given: { type, autoplay: false },
    expected: [[false, type === 'pause'], type === 'pause' ? 'AbortError' : 'kept'],
  },
]);

const paused: readonly Row[] = [
  {
    test: 'paused_false_during_play.html',
    ask: async ({ media, good, event, settle }) => {
      const state = event('play').then(() => media.paused);
      media.src = good;
      void settle(media.play());
      return await state;
    },
    expected: false,
  },
  {
    test: 'paused_true_during_pause.html',
    ask: async ({ media, loaded, event }) => {
      await loaded();
      await media.play();
      const state = event('pause').then(() => media.paused);
      media.pause();
      return await state;
    },
    expected: true,
  },
  {
    test: '/html/semantics/embedded-content/the-video-element/video_initially_paused.html',
    ask: async ({ media, loaded, wait }) => {
      await loaded();
      await wait(100);
      return [media.paused, media.currentTime];
    },
    expected: [true, 0],
  },
];

/** Returns the spontaneous events, in order, after some calls. */
const automatic = async ({ media, good, follow, event, settle, wait }: Kit<Video>, work: 'nothing' | 'pause, load' | 'play' | 'pause' | 'remove') => {
  media.src = good;
  media.autoplay = true;
  if (work.startsWith('pause')) media.pause();
  if (work === 'pause, load') media.load();
  if (work === 'play') void settle(media.play());
  const isPlaying = !media.paused;
  const seen = follow('canplay', 'canplaythrough', 'pause', 'play', 'playing');
  const there = event('canplaythrough');
  if (work === 'remove') media.remove();
  await there;
  await wait(50);
  return [isPlaying, seen];
};

const itself: readonly Row[] = [
  { test: `${autoplaying}autoplaying flag is initially true`, ask: automatic, given: 'nothing', expected: [false, ['canplay', 'play', 'playing', 'canplaythrough']] },
  { test: `${autoplaying}load() sets the autoplaying flag to true`, ask: automatic, given: 'pause, load', expected: [false, ['canplay', 'play', 'playing', 'canplaythrough']] },
  { test: `${autoplaying}play() sets the autoplaying flag to false`, ask: automatic, given: 'play', expected: [true, ['play', 'canplay', 'playing', 'canplaythrough']] },
  { test: `${autoplaying}pause() sets the autoplaying flag to false`, ask: automatic, given: 'pause', expected: [false, ['canplay', 'canplaythrough']] },
  { test: `${autoplaying}internal pause steps set the autoplaying flag to false`, ask: automatic, given: 'remove', expected: [false, ['canplay', 'canplaythrough']] },
];

/** Sets a rate; returns its event, or the exception with the unchanged rate. */
const rate = async ({ media, event, thrown }: Kit<Video>, value: number) => {
  const before = media.playbackRate;
  const told = event('ratechange');
  const name = thrown(() => (media.playbackRate = value));
  if (name !== 'nothing') return name === 'NotSupportedError' && media.playbackRate === before;
  await told;
  return media.playbackRate === value;
};

const RATES: readonly (readonly [string, number])[] = [
  ['small positive value', 3],
  ['large positive value', 100],
  ['small negative value', -3],
  ['large negative value', -100],
  ['0', 0],
  ['-1', -1],
];

const loops: readonly Row[] = [
  {
    test: `${playing}loop.html#seek to end while paused`,
    ask: async ({ media, loaded, event, follow }) => {
      media.loop = true;
      await loaded();
      const told = follow('seeking', 'timeupdate', 'seeked');
      const sought = event('seeked');
      media.currentTime = media.duration;
      await sought;
      // Each of the two seeks may fire `seeking`.
      return [media.currentTime, told.filter((type, i) => type !== told[i - 1])];
    },
    expected: [0, ['seeking', 'timeupdate', 'seeked']],
    uncontrolled: 'Chromium rests at the end',
  },
  {
    test: `${playing}loop.html#seek to end while playing`,
    ask: async ({ media, loaded, event, follow, wait }) => {
      media.loop = true;
      await loaded();
      await media.play();
      const told = follow('seeking', 'timeupdate', 'seeked');
      const sought = event('seeked');
      media.currentTime = media.duration;
      await sought;
      const at = media.currentTime;
      await wait(0);
      return [at < 1, told.slice(told.indexOf('seeking')).filter((type, i, all) => type !== all[i - 1])];
    },
    expected: [true, ['seeking', 'timeupdate', 'seeked']],
    uncontrolled: 'Chromium seeks once more',
  },
  {
    test: `${playing}loop-from-ended.tentative.html`,
    ask: async ({ media, loaded, event, settle }) => {
      await loaded();
      media.currentTime = media.duration - 0.1;
      const over = event('ended');
      await media.play();
      await over;
      const before = [media.ended, media.paused, media.currentTime === media.duration];
      media.loop = true;
      const between = [media.ended, media.paused];
      const sought = event('seeked');
      void settle(media.play());
      await sought;
      return [before, between, media.paused, media.ended, media.currentTime < media.duration];
    },
    expected: [[true, true, true], [false, true], false, false, true],
  },
  {
    test: 'audio_loop_base.html',
    ask: async ({ media, loaded, event, until }) => {
      media.loop = true;
      await loaded();
      media.currentTime = media.duration - 0.1;
      let isOver = false;
      void event('ended').then(() => (isOver = true));
      const again = event('seeking');
      await media.play();
      await again;
      return [await until(() => media.currentTime > 0.1 && media.currentTime < 1), isOver, media.paused];
    },
    expected: [true, false, false],
  },
];

/** Plays and removes or moves the element; returns its state immediately, at the end of the script, and later. */
const moved = async ({ media, loaded, event, wait, follow }: Kit<Video>, where: 'out' | 'elsewhere' | 'another document') => {
  await loaded();
  await media.play();
  const told = follow('pause');
  const main = document.querySelector('main');
  if (where === 'out') media.remove();
  else if (where === 'elsewhere') main?.appendChild(document.createElement('div')).append(media);
  else main?.appendChild(document.createElement('iframe')).contentDocument?.body.append(media);
  const atOnce = media.paused;
  await wait(0);
  const soon = media.paused;
  if (soon && told.length === 0) await event('pause');
  if (where === 'out') main?.append(media);
  await wait(100);
  return [atOnce, soon, told.length, media.paused];
};

const places: readonly Row[] = [
  { test: `${playing}pause-remove-from-document.html`, ask: moved, given: 'out', expected: [false, true, 1, true] },
  { test: `${playing}pause-move-within-document.html`, ask: moved, given: 'elsewhere', expected: [false, false, 0, false] },
  {
    test: `${playing}pause-move-to-other-document.html`,
    ask: moved,
    given: 'another document',
    expected: [false, false, 0, false],
  },
  {
    test: `${playing}pause-remove-from-document-different-load.html`,
    ask: async ({ media, good, event, wait }) => {
      document.querySelector('main')?.append(media);
      const plays = event('playing');
      media.src = good;
      void media.play().catch(() => undefined);
      await plays;
      const rests = event('pause').then(() => media.paused);
      media.remove();
      const atOnce = media.paused;
      const inEvent = await rests;
      document.querySelector('main')?.append(media);
      await wait(0);
      return [atOnce, inEvent, media.paused];
    },
    expected: [false, true, true],
  },
  {
    test: `${playing}pause-remove-from-document-networkState.html`,
    ask: async ({ make, settle, wait }) => {
      const media = make();
      document.querySelector('main')?.append(media);
      const played = settle(media.play());
      await wait(0);
      const before = [media.networkState, media.paused];
      const rests = new Promise((done) => media.addEventListener('pause', done, { once: true }));
      media.remove();
      const atOnce = media.paused;
      await rests;
      return [before, atOnce, await played];
    },
    expected: [[0, false], false, 'AbortError'],
  },
  {
    test: 'offsets-into-the-media-resource/currentTime-move-within-document.html',
    ask: async ({ media, loaded, wait, follow }) => {
      await loaded();
      await media.play();
      const told = follow('pause');
      media.currentTime = 0.8;
      await wait(0);
      const before = media.currentTime >= 0.8;
      document.querySelector('main')?.appendChild(document.createElement('div')).append(media);
      const atOnce = [media.paused, media.currentTime >= 0.8];
      await wait(0);
      return [before, atOnce, media.currentTime >= 0.8, told];
    },
    expected: [true, [false, true], true, []],
  },
];

export const theme: Theme = {
  name: 'playing',
  control: 'audio',
  rows: [
    ...events,
    ...paused,
    ...itself,
    ...RATES.map(([name, value]) => ({ test: `${playing}playbackRate.html#set to ${name}`, ask: rate, given: value, expected: true })),
    ...loops,
    ...places,
  ],
};
