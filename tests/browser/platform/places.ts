/** Rows about the element's location: removed from its page and returned, or in no page at all. None of web-platform-tests covers these. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

/** Plays, removes the element for a time, and inserts it elsewhere; returns its position, its events, and its progress there. */
const returned = async ({ media, loaded, wait, until, follow }: Kit<Video>, { ms, into }: { ms: number; into: 'the same' | 'elsewhere' | 'a fragment' | 'a shadow' }) => {
  const main = document.querySelector('main');
  await loaded();
  media.volume = 0.5;
  await media.play();
  await until(() => media.currentTime > 0.3);
  const told = follow('emptied', 'abort', 'loadstart', 'error');
  media.remove();
  await wait(ms);
  const at = media.currentTime;
  const out = [media.paused, media.readyState, at > 0.3 && at < 1];
  const place = document.createElement('div');
  main?.append(place);
  if (into === 'a fragment') {
    const fragment = new DocumentFragment();
    fragment.append(media);
    await wait(20);
    place.append(fragment);
  } else if (into === 'a shadow') place.attachShadow({ mode: 'open' }).append(media);
  else (into === 'elsewhere' ? place : main)?.append(media);
  await wait(20);
  const back = [media.paused, media.readyState, media.currentTime === at, media.volume];
  await media.play();
  const goesOn = await until(() => media.currentTime > at);
  return [out, back, goesOn, told];
};

const RETURNS: readonly (readonly [number, 'the same' | 'elsewhere' | 'a fragment' | 'a shadow'])[] = [
  [30, 'the same'],
  [500, 'elsewhere'],
  [1500, 'a fragment'],
  [5000, 'a shadow'],
];

/** Plays an element to its end outside a document, after it was in one before or never. */
const detached = async ({ media, make, good, wait }: Kit<Video>, was: 'never' | 'before') => {
  const other = was === 'never' ? make() : media;
  if (was === 'before') {
    other.remove();
    await wait(0);
  }
  const seen: string[] = [];
  for (const type of ['play', 'playing', 'ended']) other.addEventListener(type, () => seen.push(type));
  other.src = good;
  const over = new Promise((done) => other.addEventListener('ended', done));
  const played = await other.play().then(
    () => 'kept',
    (error: Error) => error.name,
  );
  const at = [other.paused, other.readyState > 1, other.networkState > 0];
  await over;
  return [played, at, seen, other.ended, other.currentTime === other.duration];
};

const rows: readonly Row[] = [
  ...RETURNS.map(([ms, into]) => ({
    test: `specification#taken out for ${ms} ms and put into ${into}`,
    ask: returned,
    given: { ms, into },
    expected: [[true, 4, true], [true, 4, true, 0.5], true, []],
  })),
  { test: 'specification#played in no document, never inserted', ask: detached, given: 'never', expected: ['kept', [false, true, true], ['play', 'playing', 'ended'], true, true] },
  { test: 'specification#played in no document, taken out', ask: detached, given: 'before', expected: ['kept', [false, true, true], ['play', 'playing', 'ended'], true, true] },
  {
    test: 'specification#what cannot be had, played in no document',
    ask: async ({ make, absent, settle }) => {
      const media = make();
      media.src = absent;
      const played = await settle(media.play());
      return [played, media.networkState, media.error?.code];
    },
    expected: ['NotSupportedError', 3, 4],
  },
];

export const theme: Theme = { name: 'places', control: 'audio', rows };
