/** Rows about cues during playback. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const element = 'track/track-element/';
const active = 'interfaces/TextTrack/activeCues.html#';

/** Plays with cues in a track; returns their events in order, with the cues active at them. */
const told = async ({ media, loaded, event }: Kit<Video>, given: readonly (readonly [number, number])[]) => {
  await loaded();
  const track = media.addTextTrack('metadata');
  const seen: string[] = [];
  for (const [i, [from, to]] of given.entries()) {
    const cue = new VTTCue(from, to, `${i}`);
    cue.onenter = () => seen.push(`+${i}`);
    cue.onexit = () => seen.push(`-${i}`);
    track.addCue(cue);
  }
  const over = event('ended');
  await media.play();
  await over;
  return seen.join(' ');
};

const rows: readonly Row[] = [
  {
    test: `${element}track-cues-enter-exit.html`,
    ask: told,
    given: [
      [0.2, 0.5],
      [0.6, 0.8],
      [1, 1.2],
    ],
    expected: '+0 -0 +1 -1 +2 -2',
  },
  {
    test: `${element}track-cues-missed.html`,
    ask: told,
    given: [
      [0.3, 0.301],
      [0.6, 0.601],
      [0.602, 0.603],
      [0.9, 0.901],
    ],
    expected: '+0 -0 +1 -1 +2 -2 +3 -3',
  },
  {
    test: `${element}track-cues-sorted-before-dispatch.html`,
    ask: told,
    given: [
      [0.2, 1],
      [0.4, 0.8],
      [0.4, 0.6],
      [0.9, 1.2],
    ],
    expected: '+0 +1 +2 -2 -1 +3 -0 -3',
  },
  {
    test: 'specification#events of the same moment, in the order of cues',
    ask: told,
    given: [
      [0.4, 0.8],
      [0.8, 1.2],
    ],
    expected: '+0 -0 +1 -1',
  },
  { test: `${element}track-cue-negative-duration.html`, ask: told, given: [[0.5, -10]], expected: '+0 -0' },
  {
    test: `${element}track-cue-negative-timestamp-events.html`,
    ask: told,
    given: [
      [-10, 0.5],
      [-110, -3.4],
    ],
    expected: '+0 -0',
  },
  {
    test: `${element}track-cues-cuechange.html`,
    ask: async ({ media, loaded, event }) => {
      await loaded();
      const track = media.addTextTrack('metadata');
      for (const [i, from] of [0.2, 0.6, 1].entries()) track.addCue(Object.assign(new VTTCue(from, from + 0.2, ''), { id: `${i + 1}` }));
      const seen: (string | undefined)[] = [];
      track.oncuechange = ({ target }) => seen.push(target === track ? (track.activeCues?.[0]?.id ?? '-') : 'elsewhere');
      const over = event('ended');
      await media.play();
      await over;
      return seen;
    },
    expected: ['1', '-', '2', '-', '3', '-'],
  },
  {
    test: 'interfaces/TextTrack/oncuechange.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const seen: unknown[] = [track.oncuechange];
      track.oncuechange = ({ target }) => seen.push(target === track);
      track.dispatchEvent(new Event('cuechange'));
      track.oncuechange = null;
      track.dispatchEvent(new Event('cuechange'));
      return seen;
    },
    expected: [null, true],
  },
  {
    test: `${element}track-cues-enter-seeking.html`,
    ask: async ({ media, loaded, event, wait }) => {
      await loaded();
      const track = media.addTextTrack('metadata');
      const seen: number[] = [];
      for (const [i, from] of [0, 0.4, 0.8].entries()) {
        const cue = new VTTCue(from, from + 0.3, '');
        cue.onenter = () => seen.push(i);
        if (i > 0) track.addCue(cue);
      }
      const there = event('seeked');
      media.currentTime = 0.9;
      await there;
      await wait(300);
      return seen;
    },
    expected: [2],
  },
  {
    test: `${element}track-cues-seeking.html`,
    ask: async ({ media, loaded, event }) => {
      await loaded();
      const track = media.addTextTrack('subtitles');
      for (const [from, to] of [
        [0.4, 1.4],
        [0.6, 1.4],
        [0.8, 1.4],
      ] as const)
        track.addCue(new VTTCue(from, to, ''));
      const counts: (number | undefined)[] = [];
      for (const at of [0.25, 0.5, 0.75, 1]) {
        const there = event('seeked');
        media.currentTime = at;
        await there;
        counts.push(track.activeCues?.length);
      }
      return counts;
    },
    expected: [0, 1, 2, 3],
  },
  {
    test: `${element}track-cues-pause-on-exit.html`,
    ask: async ({ media, loaded, event, until }) => {
      await loaded();
      const track = media.addTextTrack('subtitles');
      const cue = Object.assign(new VTTCue(0.2, 0.5, ''), { pauseOnExit: true });
      const seen: boolean[] = [];
      cue.onexit = () => seen.push(media.paused);
      track.addCue(cue);
      const rests = event('pause');
      await media.play();
      await rests;
      await until(() => seen.length > 0);
      return [seen, media.currentTime >= 0.5, media.currentTime < 1];
    },
    expected: [[true], true, true],
  },
  {
    test: `${element}track-remove-active-cue.html`,
    ask: async ({ media, loaded, settle }) => {
      await loaded();
      const track = media.addTextTrack('captions', 'regular captions track', 'en');
      const cue = new VTTCue(0, 4, 'Random');
      const begun = new Promise((done) => (cue.onenter = done));
      track.addCue(cue);
      track.mode = 'showing';
      void settle(media.play());
      await begun;
      const before = track.activeCues?.length;
      track.removeCue(cue);
      return [before, track.activeCues?.length, track.cues?.length];
    },
    expected: [1, 0, 0],
  },
  {
    test: `${element}track-disabled.html`,
    ask: async ({ media, loaded, until, wait }) => {
      await loaded();
      const track = media.addTextTrack('subtitles');
      track.mode = 'disabled';
      const seen: string[] = [];
      const cue = new VTTCue(0.1, 0.3, '');
      cue.onenter = cue.onexit = ({ type }) => seen.push(type);
      track.oncuechange = ({ type }) => seen.push(type);
      track.addCue(cue);
      await media.play();
      await until(() => media.currentTime > 0.5);
      await wait(50);
      return seen;
    },
    expected: [],
  },
  {
    test: `${element}track-cue-rendering-empty-cue.html`,
    ask: async ({ media, good, event, settle }) => {
      media.src = good;
      media.addTextTrack('captions', 'regular captions track', 'en').addCue(new VTTCue(0, 4, ''));
      const plays = event('playing');
      void settle(media.play());
      await plays;
      return media.paused;
    },
    expected: false,
  },
  {
    test: `${element}track-active-cues.html`,
    ask: async ({ media, loaded, event, until }) => {
      await loaded();
      const track = media.addTextTrack('captions');
      track.addCue(new VTTCue(0, 4, ''));
      await media.play();
      const isActive = await until(() => track.activeCues?.length === 1);
      const failed = event('error');
      media.src = '';
      await failed;
      return [isActive, track.activeCues?.length, media.networkState];
    },
    expected: [true, 0, 3],
  },
  {
    test: `${active}empty list`,
    ask: ({ make }) => {
      const element = make();
      const [first, second] = [element.addTextTrack('subtitles'), element.addTextTrack('subtitles')];
      const { activeCues } = first;
      return [first.activeCues === activeCues, second.activeCues !== activeCues, activeCues?.length];
    },
    expected: [true, true, 0],
  },
  {
    test: `${active}after addCue()`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const { activeCues } = track;
      track.addCue(new VTTCue(0, 1, ''));
      track.addCue(new VTTCue(1, 2, ''));
      return [track.activeCues === activeCues, activeCues?.length];
    },
    expected: [true, 0],
  },
  {
    test: `${active}different modes`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const { activeCues } = track;
      const same = (['showing', 'hidden', 'disabled'] as const).map((mode) => {
        track.mode = mode;
        return track.activeCues === activeCues;
      });
      return [same, track.activeCues, activeCues?.length];
    },
    expected: [[true, true, false], null, 0],
  },
  {
    test: `${active}video loading`,
    ask: async ({ media, loaded }) => {
      const track = media.addTextTrack('subtitles');
      track.addCue(new VTTCue(0, 1, ''));
      const { activeCues } = track;
      await loaded();
      return [track.activeCues === activeCues, activeCues?.length];
    },
    expected: [true, 0],
  },
  {
    test: `${active}video playing`,
    ask: async ({ media, loaded, event, settle }) => {
      await loaded();
      const track = media.addTextTrack('subtitles');
      track.addCue(new VTTCue(0, 1, ''));
      const { activeCues } = track;
      const plays = event('playing').then(() => [track.activeCues === activeCues, activeCues?.length]);
      void settle(media.play());
      return await plays;
    },
    expected: [true, 1],
  },
  {
    test: `${active}adding cue during playback`,
    ask: async ({ media, loaded, wait }) => {
      await loaded();
      const track = media.addTextTrack('subtitles');
      await media.play();
      const before = track.activeCues?.length;
      track.addCue(new VTTCue(0, 2, ''));
      const atOnce = track.activeCues?.length;
      await wait(0);
      return [before, atOnce, track.activeCues?.length];
    },
    // The event fires immediately.
    expected: [0, 1, 1],
  },
];

export const theme: Theme = { name: 'cues', control: 'audio', rows };
