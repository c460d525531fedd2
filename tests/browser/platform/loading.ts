/** Rows about loading: events and their order, states, the effect of a new load, and errors. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const selection = 'loading-the-media-resource/resource-selection-';
const loading = 'loading-the-media-resource/';

/** Returns true if an event follows after `src` was set, with its properties. */
const comes = async ({ media, good, event }: Kit<Video>, { type, autoplay }: { type: string; autoplay: boolean }) => {
  media.autoplay = autoplay;
  const told = event(type) as Promise<Event>;
  media.src = good;
  const { bubbles, target } = await told;
  media.pause();
  return [bubbles, target === media];
};

/** Returns the order of the first events of each type after `src` was set. */
const order = async ({ media, good, follow, event }: Kit<Video>, { types, autoplay }: { types: readonly string[]; autoplay: boolean }) => {
  media.autoplay = autoplay;
  const seen = follow(...types);
  const last = event(types.at(-1) ?? '');
  media.src = good;
  await last;
  media.pause();
  return [...new Set(seen)];
};

/** The least state that an event may find. */
const stateAt = async ({ media, good, event }: Kit<Video>, { type, least, most }: { type: string; least: number; most: number }) => {
  media.autoplay = type === 'playing';
  const state = event(type).then(() => media.readyState);
  media.src = good;
  const found = await state;
  return found >= least && found <= most;
};

const EVENTS = ['loadstart', 'progress', 'loadedmetadata', 'loadeddata', 'canplay', 'canplaythrough'];

const events: readonly Row[] = EVENTS.flatMap((type) => [
  { test: `event_${type}.html`, ask: comes, given: { type, autoplay: true }, expected: [false, true] },
  { test: `event_${type}_noautoplay.html`, ask: comes, given: { type, autoplay: false }, expected: [false, true] },
]);

const orders: readonly Row[] = [
  ['canplay_canplaythrough', ['canplay', 'canplaythrough']],
  ['canplay_playing', ['canplay', 'playing']],
  ['durationchange_resize_loadedmetadata', ['durationchange', 'loadedmetadata']],
  ['loadedmetadata_loadeddata', ['loadedmetadata', 'loadeddata']],
  ['loadstart_progress', ['loadstart', 'progress']],
].map(([name, types]) => ({ test: `event_order_${name}.html`, ask: order, given: { types, autoplay: true }, expected: types }));

const STATES: readonly (readonly [string, number, number])[] = [
  ['loadedmetadata', 1, 4],
  ['loadeddata', 2, 4],
  ['canplay', 3, 4],
  ['canplaythrough', 4, 4],
  ['playing', 3, 4],
];

const states: readonly Row[] = [
  ...STATES.map(([type, least, most]) => ({ test: `readyState_during_${type}.html`, ask: stateAt, given: { type, least, most }, expected: true })),
  {
    test: 'networkState_during_loadstart.html',
    ask: async ({ media, good, event }) => {
      const state = event('loadstart').then(() => media.networkState);
      media.src = good;
      return await state;
    },
    expected: 2,
  },
  {
    test: 'networkState_during_progress.html',
    uncontrolled: 'Chromium has a small file at once, and rests',
    ask: async ({ media, good, event }) => {
      const state = event('progress').then(() => media.networkState);
      media.src = good;
      return (await state) === media.NETWORK_LOADING;
    },
    expected: true,
  },
];

/** Returns the events of `load()` in a given state: none immediately, and then its own before the next `loadstart`. */
const reload = async ({ media, good, absent, event, follow, wait }: Kit<Video>, when: 'idle' | 'loading' | 'moved' | 'failed') => {
  const there = event({ idle: 'suspend', loading: 'loadstart', moved: 'loadeddata', failed: 'error' }[when]);
  media.src = when === 'failed' ? absent : good;
  await there;
  // Listeners of the event run first, as in the original test.
  const told = follow('abort', 'emptied', 'timeupdate', 'loadstart');
  if (when === 'moved') media.currentTime = 1;
  const again = event('loadstart');
  media.load();
  const atOnce = [...told];
  await again;
  await wait(0);
  return [atOnce, told.slice(0, told.indexOf('loadstart') + 1)];
};

const again: readonly Row[] = [
  { test: `${loading}load-events-networkState.html#NETWORK_IDLE`, ask: reload, given: 'idle', expected: [[], ['abort', 'emptied', 'loadstart']] },
  { test: `${loading}load-events-networkState.html#NETWORK_LOADING`, ask: reload, given: 'loading', expected: [[], ['abort', 'emptied', 'loadstart']] },
  {
    test: `${loading}load-events-networkState.html#NETWORK_DISPATCH_EMPTIED_BEFORE_TIMEUPDATE`,
    ask: reload,
    given: 'moved',
    expected: [[], ['abort', 'emptied', 'timeupdate', 'loadstart']],
  },
  { test: `${loading}load-events-networkState.html#NETWORK_NO_SOURCE`, ask: reload, given: 'failed', expected: [[], ['emptied', 'loadstart']] },
  {
    test: `${loading}load-removes-queued-error-event.html`,
    ask: async ({ media, absent, good, event, follow }) => {
      const told = follow('error');
      media.src = absent;
      await event('loadstart');
      media.src = good;
      await event('canplay');
      return told;
    },
    expected: [],
  },
];

const AUTOPLAY: readonly Row[] = ['none', 'metadata'].flatMap((preload) =>
  ['first', 'last'].map((place) => ({
    test: `${loading}autoplay-overrides-preload.html#set ${place}, ${preload}`,
    ask: async ({ media, good, event }: Kit<Video>, [preload, place]: [HTMLMediaElement['preload'], string]) => {
      const plays = event('playing').then(() => [media.readyState, media.paused]);
      media.src = good;
      if (place === 'first') media.autoplay = true;
      media.preload = preload;
      if (place === 'last') media.autoplay = true;
      return await plays;
    },
    given: [preload, place],
    expected: [4, false],
  })),
);

/** Returns the state immediately after a call, and after all pending work. */
const invoked = async ({ make, wait }: Kit<Video>, { work, isIn }: { work: string; isIn: boolean }) => {
  const media = make();
  if (isIn) document.querySelector('main')?.append(media);
  await wait(0);
  const before = media.networkState;
  const works: { [name: string]: () => unknown } = {
    load: () => media.load(),
    play: () => void media.play().catch(() => undefined),
    pause: () => media.pause(),
    'set src': () => media.setAttribute('src', ''),
    'remove src': () => media.removeAttribute('src'),
    'src in another namespace': () => media.setAttributeNS('bogus', 'src', ''),
    remove: () => media.remove(),
  };
  works[work]?.();
  return [before, media.networkState];
};

const SELECTED: readonly (readonly [string, string, boolean, number])[] = [
  ['invoke-load', 'load', true, 3],
  ['invoke-play', 'play', true, 3],
  ['invoke-pause', 'pause', true, 3],
  ['invoke-set-src', 'set src', true, 3],
  ['invoke-set-src-not-in-document', 'set src', false, 3],
  ['invoke-set-src-in-namespace', 'src in another namespace', true, 0],
  ['invoke-remove-src', 'remove src', true, 0],
  ['invoke-remove-from-document', 'remove', true, 0],
];

const selected: readonly Row[] = [
  ...SELECTED.map(([name, work, isIn, state]) => ({ test: `${selection}${name}.html`, ask: invoked, given: { work, isIn }, expected: [0, state] })),
  {
    test: `${selection}invoke-set-src-networkState.html`,
    ask: async ({ media, absent, event }) => {
      const failed = event('error');
      media.src = absent;
      await failed;
      const state = media.networkState;
      const again = event('loadstart');
      media.setAttribute('src', media.getAttribute('src') ?? '');
      await again;
      return state;
    },
    expected: 3,
  },
  {
    test: `${selection}invoke-pause-networkState.html`,
    ask: async ({ media, absent, event, follow, wait }) => {
      const failed = event('error');
      media.src = absent;
      await failed;
      const told = follow('loadstart');
      media.pause();
      await wait(50);
      return told;
    },
    expected: [],
  },
  {
    test: `${selection}invoke-remove-from-document-networkState.html`,
    ask: async ({ media, absent, event, follow, wait }) => {
      const failed = event('error');
      media.src = absent;
      await failed;
      const told = follow('loadstart');
      media.remove();
      await wait(50);
      return [told, media.networkState];
    },
    expected: [[], 3],
  },
  {
    test: `${selection}invoke-in-sync-event.html`,
    ask: async ({ media, good, event }) => {
      const seen: number[] = [];
      const told = new Promise((done) => {
        const button = document.createElement('button');
        button.addEventListener('click', () => {
          media.src = good;
          seen.push(media.networkState);
        });
        button.click();
        seen.push(media.networkState);
        event('loadstart').then(done);
      });
      await told;
      return [...seen, media.networkState];
    },
    expected: [3, 3, 2],
  },
  {
    test: `${selection}remove-src.html`,
    ask: async ({ media, good, event, wait }) => {
      const there = event('canplaythrough');
      media.src = good;
      await there;
      media.removeAttribute('src');
      await wait(100);
      // Nothing is released before the next load.
      return [media.readyState, media.currentSrc.endsWith(good)];
    },
    expected: [4, true],
  },
];

const failures: readonly Row[] = [
  {
    test: 'currentSrc_nonempty_after_setting_src.html',
    ask: async ({ media, good, wait }) => {
      media.src = good;
      await wait(0);
      return media.currentSrc.endsWith(good);
    },
    expected: true,
  },
  {
    test: 'error-codes/error.html#after successful load',
    ask: async ({ media, loaded }) => {
      await loaded();
      return media.error;
    },
    expected: null,
  },
  {
    test: 'error-codes/error.html#after setting src to the empty string',
    ask: async ({ media, event }) => {
      const failed = event('error');
      media.src = '';
      await failed;
      return [media.error?.code, media.error?.MEDIA_ERR_SRC_NOT_SUPPORTED, typeof media.error?.message];
    },
    expected: [4, 4, 'string'],
  },
  {
    test: 'error-codes/error.html#instanceof MediaError',
    ask: async ({ media, absent, event }) => {
      const failed = event('error');
      media.src = absent;
      await failed;
      return media.error instanceof MediaError;
    },
    expected: true,
  },
  {
    test: 'error-sequence.html#empty src attribute',
    ask: async ({ media, event, follow }) => {
      const told = follow('loadstart', 'error', 'volumechange');
      const failed = event('error');
      media.src = '';
      const before = media.error;
      media.volume = 0;
      await failed;
      return [before, told];
    },
    expected: [null, ['volumechange', 'loadstart', 'error']],
  },
  {
    test: 'error-sequence.html#urlRecord failure',
    ask: async ({ media, event, follow }) => {
      const told = follow('loadstart', 'error', 'volumechange');
      const failed = event('error');
      media.src = 'https://#fragment';
      const before = media.error;
      media.volume = 0;
      await failed;
      return [before, told, media.error?.code];
    },
    expected: [null, ['volumechange', 'loadstart', 'error'], 4],
  },
];

export const theme: Theme = {
  name: 'loading',
  control: 'audio',
  rows: [...events, ...orders, ...states, ...again, ...AUTOPLAY, ...selected, ...failures],
};
