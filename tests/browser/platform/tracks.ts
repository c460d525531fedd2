/** Tracks of text: the lists, the tracks, and their cues. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const media = 'interfaces/HTMLElement/HTMLMediaElement/';
const track = 'interfaces/TextTrack/';
const list = 'interfaces/TextTrackList/';
const cues = 'interfaces/TextTrackCueList/';

/** Adds a track; returns the exception, or the track. */
const added = ({ make, thrown }: Kit<Video>, given: readonly (string | null)[]) => {
  const element = make();
  let made: TextTrack | undefined;
  const name = thrown(() => (made = element.addTextTrack(...(given as [TextTrackKind]))));
  return made === undefined ? name : [made.kind, made.label, made.language, made.mode, made.cues?.length, element.textTracks.length];
};

const adding: readonly Row[] = [
  { test: `${media}addTextTrack.html#bogus kind`, ask: added, given: ['foo'], expected: 'TypeError' },
  { test: `${media}addTextTrack.html#null kind`, ask: added, given: [null], expected: 'TypeError' },
  { test: `${media}addTextTrack.html#kind in capitals`, ask: added, given: ['SUBTITLES'], expected: 'TypeError' },
  { test: `${media}addTextTrack.html#no argument`, ask: added, given: [], expected: 'TypeError' },
  { test: `${media}addTextTrack.html#kind only`, ask: added, given: ['subtitles'], expected: ['subtitles', '', '', 'hidden', 0, 1] },
  { test: `${media}addTextTrack.html#kind and label`, ask: added, given: ['subtitles', 'foo'], expected: ['subtitles', 'foo', '', 'hidden', 0, 1] },
  { test: `${media}addTextTrack.html#kind, label and language`, ask: added, given: ['subtitles', 'foo', 'bar'], expected: ['subtitles', 'foo', 'bar', 'hidden', 0, 1] },
  { test: `${media}addTextTrack.html#null label and language`, ask: added, given: ['subtitles', null, null], expected: ['subtitles', 'null', 'null', 'hidden', 0, 1] },
  ...['captions', 'descriptions', 'chapters', 'metadata'].map((kind) => ({
    test: `${track}kind.html#${kind}`,
    ask: added,
    given: [kind],
    expected: [kind, '', '', 'hidden', 0, 1],
  })),
  { test: `${track}label.html`, ask: added, given: ['subtitles', ' foo '], expected: ['subtitles', ' foo ', '', 'hidden', 0, 1] },
  {
    test: `${track}language.html`,
    ask: added,
    given: ['subtitles', '', 'zh-Hant-CN-x-private1-private2'],
    expected: ['subtitles', '', 'zh-Hant-CN-x-private1-private2', 'hidden', 0, 1],
  },
  { test: 'track/track-element/add-text-track.html', ask: added, given: ['subtitles', 'korean', 'ko'], expected: ['subtitles', 'korean', 'ko', 'hidden', 0, 1] },
];

const lists: readonly Row[] = [
  {
    test: `${media}textTracks.html`,
    ask: ({ make }) => {
      const element = make();
      const { textTracks } = element;
      return [element.textTracks === textTracks, textTracks.length];
    },
    expected: [true, 0],
  },
  {
    test: `${list}length.html`,
    ask: ({ make }) => {
      const { textTracks } = make();
      const before = textTracks.length;
      try {
        (textTracks as unknown as { length: number }).length = 10;
      } catch {
        // The property is read-only; in strict mode the assignment throws.
      }
      return [before, textTracks.length];
    },
    expected: [0, 0],
  },
  {
    test: `${list}getter.html`,
    ask: ({ make }) => {
      const element = make();
      const first = element.addTextTrack('chapters');
      const second = element.addTextTrack('captions');
      const { textTracks } = element;
      return [textTracks[0] === first, textTracks[1] === second, textTracks[2] === undefined, 1 in textTracks, 2 in textTracks, [...textTracks].length];
    },
    expected: [true, true, true, true, false, 2],
  },
  {
    test: `${list}getTrackById.html`,
    ask: ({ make }) => {
      const element = make();
      element.addTextTrack('subtitles', 'LABEL', 'fr');
      // A track that a script adds has no id.
      return [element.textTracks[0]?.id, element.textTracks.getTrackById('LABEL')];
    },
    expected: ['', null],
  },
  {
    test: `${list}onaddtrack.html`,
    ask: async ({ make, wait }) => {
      const element = make();
      const seen: unknown[] = [element.textTracks.onaddtrack];
      const track = element.addTextTrack('subtitles');
      element.textTracks.onaddtrack = ({ target, track: of }) => seen.push(target === element.textTracks, of === track);
      seen.push('later');
      await wait(20);
      return seen;
    },
    expected: [null, 'later', true, true],
  },
  {
    test: 'track/track-element/track-addtrack-kind.html',
    ask: async ({ make }) => {
      const element = make();
      const told = new Promise<Event>((done) => element.textTracks.addEventListener('addtrack', done, { once: true }));
      element.addTextTrack('captions', 'Captions Track', 'en');
      const event = (await told) as TrackEvent;
      return [event.track?.kind, event.track === element.textTracks[0], event.bubbles, event.cancelable];
    },
    expected: ['captions', true, false, false],
  },
  {
    test: `${list}onaddtrack.html#instanceof TrackEvent`,
    ask: async ({ make }) => {
      const element = make();
      const told = new Promise<Event>((done) => element.textTracks.addEventListener('addtrack', done, { once: true }));
      element.addTextTrack('captions');
      return (await told) instanceof TrackEvent;
    },
    expected: true,
  },
  {
    test: 'track/track-element/track-change-event.html',
    ask: async ({ make, wait }) => {
      const element = make();
      const first = element.addTextTrack('subtitles');
      const second = element.addTextTrack('captions');
      let told = 0;
      element.textTracks.onchange = () => told++;
      first.mode = 'showing';
      second.mode = 'disabled';
      const atOnce = told;
      await wait(20);
      return [atOnce, told > 0];
    },
    expected: [0, true],
  },
  {
    test: 'track/track-element/track-mode-not-changed-by-new-track.html',
    ask: async ({ make, wait }) => {
      const element = make();
      const first = element.addTextTrack('metadata');
      const second = element.addTextTrack('captions');
      second.mode = 'showing';
      const third = element.addTextTrack('subtitles', 'Subtitle Track', 'en');
      third.mode = 'showing';
      await wait(20);
      return [first.mode, second.mode, third.mode];
    },
    expected: ['hidden', 'showing', 'showing'],
  },
  {
    test: 'track/track-element/track-text-track-cue-list.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      for (const [i, at] of [3, 1, 2].entries()) track.addCue(Object.assign(new VTTCue(at, at + 1, `${at}`), { id: `${i}` }));
      return [track.cues?.length, [...(track.cues ?? [])].map(({ startTime }) => startTime), track.cues?.getCueById('2')?.startTime];
    },
    expected: [3, [1, 2, 3], 2],
  },
];

const modes: readonly Row[] = [
  {
    test: `${track}mode.html`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      return ['disabled', 'hidden', 'showing', 'foo', 'SHOWING', '', 2].map((mode) => {
        track.mode = mode as TextTrackMode;
        return track.mode;
      });
    },
    expected: ['disabled', 'hidden', 'showing', 'showing', 'showing', 'showing', 'showing'],
  },
  {
    test: 'track/track-element/track-mode-disabled.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      track.addCue(new VTTCue(0, 1, 'x'));
      const { cues } = track;
      track.mode = 'disabled';
      const off = [track.cues, track.activeCues];
      track.mode = 'hidden';
      return [off, track.cues === cues, track.cues?.length];
    },
    expected: [[null, null], true, 1],
  },
  {
    test: `${track}constants.html`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      return ['OFF', 'HIDDEN', 'SHOWING', 'NONE', 'LOADING', 'LOADED', 'ERROR', 'DISABLED'].filter((name) => name in track);
    },
    expected: [],
  },
  {
    test: 'track/track-element/track-disabled-addcue.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      track.mode = 'disabled';
      for (let i = 0; i < 10; i++) track.addCue(new VTTCue(0.1 * i, 0.1 * i + 0.1, `${i}`));
      const off = track.cues;
      track.mode = 'hidden';
      return [off, track.cues?.length];
    },
    expected: [null, 10],
  },
];

const cueing: readonly Row[] = [
  {
    test: `${track}cues.html#default attribute and different modes`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const { cues } = track;
      track.addCue(new VTTCue(0, 1, 'one'));
      track.addCue(new VTTCue(1, 2, 'two'));
      const same = track.cues === cues;
      track.mode = 'showing';
      return [same, track.cues === cues, cues?.length];
    },
    expected: [true, true, 2],
  },
  {
    test: `${track}cues.html#in order of time, the longer one first`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      for (const [from, to, text] of [
        [2, 3, 'd'],
        [0, 1, 'b'],
        [0, 2, 'a'],
        [1, 2, 'c'],
        [2, 3, 'e'],
      ] as const)
        track.addCue(new VTTCue(from, to, text));
      return [...(track.cues ?? [])].map((cue) => (cue as VTTCue).text).join('');
    },
    expected: 'abcde',
  },
  {
    test: `${track}cues.html#changing the order of cues`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const [a, b] = [new VTTCue(0, 1, 'a'), new VTTCue(1, 2, 'b')];
      track.addCue(a);
      track.addCue(b);
      a.startTime = 1.5;
      return [track.cues?.[0] === b, track.cues?.[1] === a];
    },
    expected: [true, true],
  },
  {
    test: `${track}addCue.html#a cue in two tracks`,
    ask: ({ make }) => {
      const element = make();
      const [first, second] = [element.addTextTrack('subtitles'), element.addTextTrack('subtitles')];
      const cue = new VTTCue(0, 1, 'x');
      first.addCue(cue);
      second.addCue(cue);
      return [first.cues?.length, second.cues?.length, cue.track === second];
    },
    expected: [0, 1, true],
  },
  {
    test: `${track}addCue.html#a cue to a track twice`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const cue = new VTTCue(0, 1, 'x');
      track.addCue(cue);
      const before = cue.track === track;
      track.addCue(cue);
      return [before, cue.track === track, track.cues?.length];
    },
    expected: [true, true, 1],
  },
  {
    test: `${track}addCue.html#a removed cue to a different track`,
    ask: ({ make }) => {
      const element = make();
      const [first, second] = [element.addTextTrack('subtitles'), element.addTextTrack('subtitles')];
      const cue = new VTTCue(0, 1, 'x');
      first.addCue(cue);
      first.removeCue(cue);
      const between = cue.track;
      second.addCue(cue);
      return [between, cue.track === second, first.cues?.length, second.cues?.length];
    },
    expected: [null, true, 0, 1],
  },
  {
    test: `${track}addCue.html#a removed cue to the same track`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const cue = new VTTCue(0, 1, 'x');
      const seen: (number | undefined)[] = [];
      for (const work of ['addCue', 'removeCue', 'addCue'] as const) {
        track[work](cue);
        seen.push(track.cues?.length);
      }
      return seen;
    },
    expected: [1, 0, 1],
  },
  {
    test: `${track}removeCue.html#two elementless tracks`,
    ask: ({ make, thrown }) => {
      const element = make();
      const [first, second] = [element.addTextTrack('subtitles'), element.addTextTrack('subtitles')];
      const cue = new VTTCue(0, 1, 'x');
      const names = [thrown(() => first.removeCue(cue))];
      first.addCue(cue);
      names.push(
        thrown(() => second.removeCue(cue)),
        thrown(() => first.removeCue(cue)),
        thrown(() => first.removeCue(cue)),
      );
      return names;
    },
    expected: ['NotFoundError', 'NotFoundError', 'nothing', 'NotFoundError'],
  },
  {
    test: 'track/track-element/src-addcue-removecue.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('metadata');
      const cue = Object.assign(new VTTCue(0, 10, ''), { id: 'testCue' });
      track.addCue(cue);
      const before = track.cues?.length;
      track.removeCue(cue);
      return [before, track.cues?.length];
    },
    expected: [1, 0],
  },
  {
    test: 'interfaces/TextTrackCue/track.html',
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const cue = new VTTCue(0, 1, 'x');
      const seen: unknown[] = [cue.track];
      track.addCue(cue);
      seen.push(cue.track === track);
      track.removeCue(cue);
      return [...seen, cue.track];
    },
    expected: [null, true, null],
  },
  {
    test: `${cues}getCueById.html`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const [none, some] = [new VTTCue(0, 1, 'a'), Object.assign(new VTTCue(1, 2, 'b'), { id: 'foo' })];
      track.addCue(none);
      track.addCue(some);
      return [track.cues?.getCueById(''), track.cues?.getCueById('foo') === some, track.cues?.getCueById('bar')];
    },
    expected: [null, true, null],
  },
  {
    test: `${cues}getter.html`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const cue = new VTTCue(0, 1, 'a');
      track.addCue(cue);
      return [track.cues?.[0] === cue, track.cues?.[1] === undefined, [...(track.cues ?? [])].length];
    },
    expected: [true, true, 1],
  },
  {
    test: `${cues}length.html`,
    ask: ({ make }) => {
      const track = make().addTextTrack('subtitles');
      const seen = [track.cues?.length];
      for (let i = 0; i < 3; i++) {
        track.addCue(new VTTCue(i, i + 1, ''));
        seen.push(track.cues?.length);
      }
      return seen;
    },
    expected: [0, 1, 2, 3],
  },
];

export const theme: Theme = { name: 'text tracks', control: 'audio', rows: [...adding, ...lists, ...modes, ...cueing] };
