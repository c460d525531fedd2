import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Caption } from '../element/captions/captions.js';
import { canPlay, crossOriginOf, preloadOf } from '../element/media/media.js';
import { after, dispatch, isPending, takeBack, takeBackSeek } from '../element/media/media-events.js';
import { FrameCallbacks } from '../element/sound/outputs.js';
import { Ranges, without, type Span } from '../element/base/ranges.js';
import { StoryTextTracks } from '../element/media/text-tracks.js';

const spansOf = (ranges: TimeRanges) => Array.from({ length: ranges.length }, (_, i) => [ranges.start(i), ranges.end(i)]);

/** Returns a seeded random generator: the spans are the same in every run of this test. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1103515245 + 12345) % 2 ** 31;
    return state / 2 ** 31;
  };
}

describe('ranges', () => {
  it('have each time once, in order, whatever they were made of', () => {
    for (let seed = 1; seed <= 200; seed++) {
      const next = random(seed);
      const spans = Array.from({ length: 8 }, (): Span => {
        const start = 20 * next();
        return [start, start + 4 * next()];
      });
      const found = spansOf(new Ranges(spans));
      const inside = (of: readonly (readonly number[])[], t: number) => of.some(([a = 0, b = 0]) => a <= t && t <= b);
      for (let t = 0; t < 25; t += 0.13) {
        expect(inside(found, t)).toBe(inside(spans, t));
        expect(inside(without(25, spans), t)).toBe(!spans.some(([a, b]) => a < t && t < b));
      }
      for (let i = 1; i < found.length; i++) expect(found[i]?.[0]).toBeGreaterThan(found[i - 1]?.[1] ?? Infinity);
    }
  });

  it('refuse what is beyond them', () => {
    const ranges = new Ranges([[0, 1]]);
    for (const index of [-1, 1, NaN]) {
      expect(() => ranges.start(index)).toThrow(expect.objectContaining({ name: 'IndexSizeError' }));
      expect(() => ranges.end(index)).toThrow(expect.objectContaining({ name: 'IndexSizeError' }));
    }
  });
});

/** Waits until all queued tasks have run. */
const over = () => new Promise((done) => setTimeout(done, 20));

describe('events', () => {
  it('come when the script is over, in order, and not after they were taken back', async () => {
    const media = new EventTarget();
    const told: string[] = [];
    for (const type of ['seeking', 'seeked', 'emptied']) media.addEventListener(type, () => told.push(type));
    // Events that a listener triggers come after the queued ones.
    media.addEventListener('seeking', () => dispatch(media, 'emptied'));
    dispatch(media, 'seeking');
    dispatch(media, 'seeked');
    expect([told.length, isPending(media, 'seeked')]).toEqual([0, true]);
    await over();
    expect(told).toEqual(['seeking', 'seeked', 'emptied']);
    expect(isPending(media, 'seeked')).toBe(false);
    dispatch(media, 'seeking');
    takeBack(media);
    dispatch(media, 'emptied');
    await over();
    expect(told.slice(3)).toEqual(['emptied']);
  });
});

describe('steps of the same queue', () => {
  it('come between the events, each in a task of its own', async () => {
    const media = new EventTarget();
    const told: string[] = [];
    for (const type of ['playing', 'pause']) {
      media.addEventListener(type, () => {
        told.push(type);
        void Promise.resolve().then(() => told.push(`after ${type}`));
      });
    }
    dispatch(media, 'playing', 'pause');
    after(media, () => told.push('kept'));
    for (let i = 0; i < 10; i++) await Promise.resolve();
    expect(told).toEqual([]);
    await over();
    expect(told).toEqual(['playing', 'after playing', 'pause', 'after pause', 'kept']);
  });

  it('are done at once where a new load takes the events back', async () => {
    const media = new EventTarget();
    const told: string[] = [];
    for (const type of ['playing', 'volumechange', 'seeked']) media.addEventListener(type, () => told.push(type));
    dispatch(media, 'playing', 'volumechange');
    after(media, () => told.push('kept'));
    takeBack(media);
    expect(told).toEqual(['kept']);
    await over();
    expect(told).toEqual(['kept', 'volumechange']);
  });

  it('are those of one seek where another begins before the first is over', async () => {
    const media = new EventTarget();
    const told: string[] = [];
    for (const type of ['seeking', 'timeupdate', 'seeked', 'pause']) media.addEventListener(type, () => told.push(type));
    dispatch(media, 'pause', 'seeking', 'timeupdate', 'seeked');
    takeBackSeek(media);
    dispatch(media, 'seeking', 'timeupdate', 'seeked');
    await over();
    // No seek is in progress.
    takeBackSeek(media);
    expect(told).toEqual(['pause', 'seeking', 'seeking', 'timeupdate', 'seeked']);
  });
});

describe('words of attributes', () => {
  it('are those of the standard', () => {
    expect([null, '', 'none', 'NONE', 'metadata', 'auto', 'soon'].map(preloadOf)).toEqual(['metadata', 'auto', 'none', 'none', 'metadata', 'auto', 'metadata']);
    expect([null, '', 'anonymous', 'Use-Credentials', 'other'].map(crossOriginOf)).toEqual([null, 'anonymous', 'anonymous', 'use-credentials', 'anonymous']);
    expect(['application/eml+xml; charset=utf-8', 'text/xml', 'video/mp4', ''].map(canPlay)).toEqual(['probably', 'maybe', '', '']);
  });
});

describe('callbacks of frames', () => {
  it('come once, in order, and not after they were taken back', () => {
    const frames = new FrameCallbacks();
    const told: string[] = [];
    frames.request(() => {
      told.push('a');
      frames.request(() => told.push('again'));
    });
    frames.cancel(frames.request(() => told.push('b')));
    frames.request((_, { mediaTime, presentedFrames, width }) => told.push(`c ${mediaTime} ${presentedFrames} ${width}`));
    frames.drawn(1, { width: 4, height: 3 });
    frames.drawn(2, { width: 4, height: 3 });
    frames.drawn(3, { width: 4, height: 3 });
    expect(told).toEqual(['a', 'c 1 1 4', 'again']);
  });
});

class FakeCue extends EventTarget {
  id = '';
  pauseOnExit = false;
  track: unknown;
  constructor(
    readonly startTime: number,
    readonly endTime: number,
    readonly text: string,
  ) {
    super();
  }
}

const captions: readonly Caption[] = [0, 2, 3].map((startSecs) => ({
  startSecs,
  endSecs: startSecs + 1,
  second: 1,
  words: ['Fish', '&', '<chips>'].map((text) => ({ text, startSecs, endSecs: startSecs + 1, emphasized: false })),
}));

describe('text tracks', () => {
  beforeEach(() => {
    vi.stubGlobal('VTTCue', FakeCue);
    vi.stubGlobal('TrackEvent', Event);
  });
  afterEach(() => void vi.unstubAllGlobals());

  it('tell cues as they begin and end', () => {
    const tracks = new StoryTextTracks(
      () => undefined,
      () => undefined,
    );
    tracks.setStory('en', false);
    const track = tracks[0];
    expect([track?.mode, track?.cues, track?.language]).toEqual(['disabled', null, 'en']);
    if (track === undefined) return;
    track.mode = 'hidden';
    const told: number[] = [];
    track.oncuechange = () => told.push(track.activeCues?.length ?? NaN);
    for (const secs of [0, 0.5, 1.5, 2.5, 3, 9, 0]) tracks.march(captions, secs, () => undefined);
    expect(told).toEqual([1, 0, 1, 1, 0, 1]);
    expect((track.cues?.[0] as VTTCue | undefined)?.text).toBe('Fish\n&amp; &lt;chips>');
  });

  it('tell what began and ended between two moments, but not what was passed by a leap; one that wants it pauses first', () => {
    const told: string[] = [];
    const tracks = new StoryTextTracks(
      () => undefined,
      () => undefined,
    );
    const track = tracks.add('metadata', '', '');
    const cues = [
      [1, 2],
      [1.2, 1.3],
      [3, -10],
      [5, 6],
    ].map(([start = 0, end = 0], i) => {
      const cue = Object.assign(new FakeCue(start, end, ''), { pauseOnExit: i === 0 }) as unknown as TextTrackCue;
      for (const type of ['enter', 'exit']) cue.addEventListener(type, () => told.push(`${type === 'enter' ? '+' : '-'}${i}`));
      track.addCue(cue);
      return cue;
    });
    const to = (secs: number): string => {
      tracks.march([], secs, () => told.push('pause'));
      return told.splice(0).join(' ');
    };
    expect([to(0), to(1.1), to(1.5), to(2.5), to(4)]).toEqual(['', '+0', '+1 -1', 'pause -0', '+2 -2']);
    tracks.leap(0);
    expect(to(0)).toBe('');
    tracks.leap(5);
    expect([to(5), track.activeCues?.length]).toEqual(['+3', 1]);
    const [, , , last] = cues;
    if (last !== undefined) track.removeCue(last);
    expect([track.activeCues?.length, last?.track]).toEqual([0, null]);
  });

  it('keep cues in order, and refuse those of others', () => {
    const track = new StoryTextTracks(
      () => undefined,
      () => undefined,
    ).add('metadata', '', '');
    const cues = [5, 1, 3, 1].map((start, i) => Object.assign(new FakeCue(start, start + 1 + i, ''), { id: `${i}` }) as unknown as TextTrackCue);
    for (const cue of cues) track.addCue(cue);
    expect([...(track.cues ?? [])].map(({ id }) => id)).toEqual(['3', '1', '2', '0']);
    expect(track.cues?.getCueById('2')).toBe(cues[2]);
    Object.assign(cues[2] ?? {}, { startTime: 0 });
    expect([...(track.cues ?? [])].map(({ id }) => id)).toEqual(['2', '3', '1', '0']);
    const [first] = cues;
    if (first !== undefined) track.removeCue(first);
    expect(() => first && track.removeCue(first)).toThrow(expect.objectContaining({ name: 'NotFoundError' }));
    expect(() =>
      new StoryTextTracks(
        () => undefined,
        () => undefined,
      ).add('songs' as TextTrackKind, '', ''),
    ).toThrow(TypeError);
  });

  it('are listed by number and name, and a list tells of its changes', async () => {
    const shown: boolean[] = [];
    const tracks = new StoryTextTracks(
      (is) => shown.push(is),
      () => undefined,
    );
    const told: string[] = [];
    for (const type of ['addtrack', 'removetrack', 'change']) tracks.addEventListener(type, (event) => told.push(`${type} ${(event as TrackEvent).track?.kind ?? ''}`));
    const own = tracks.add('metadata', '', '');
    tracks.setStory('en', true);
    await Promise.resolve();
    expect([tracks.length, tracks[0]?.kind, tracks[1] === own, tracks.getTrackById('story')?.kind]).toEqual([2, 'captions', true, 'captions']);
    tracks.setShown(false);
    own.mode = 'disabled';
    await Promise.resolve();
    expect(shown).toEqual([]);
    if (tracks[0] !== undefined) tracks[0].mode = 'showing';
    expect(shown).toEqual([true]);
    await Promise.resolve();
    tracks.setStory(undefined, false);
    await Promise.resolve();
    expect([tracks.length, tracks[0] === own, tracks[1]]).toEqual([1, true, undefined]);
    expect(told).toEqual(['addtrack metadata', 'addtrack captions', 'change ', 'change ', 'removetrack captions']);
  });
});
