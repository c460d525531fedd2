import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { cuesOf } from '../element/subtitles/vtt.js';
import { nameOf } from '../element/controls/caption-menu.js';
import { StoryTextTracks } from '../element/media/text-tracks.js';

class FakeCue extends EventTarget {
  constructor(
    public startTime: number,
    public endTime: number,
    public text: string,
  ) {
    super();
  }
}

beforeEach(() => {
  vi.stubGlobal('VTTCue', FakeCue);
  vi.stubGlobal('TrackEvent', Event);
});
afterEach(() => void vi.unstubAllGlobals());

describe('a file of subtitles', () => {
  const read = async (text: string) => (await cuesOf(text))?.map(({ id, startTime, endTime, text: own }) => [id, startTime, endTime, own]);

  it('has cues with their markup, without comments, styles and places', async () => {
    const text =
      'WEBVTT Kind: captions\r\n\r\nNOTE a comment\r\n\r\nSTYLE\r\n::cue { color: red }\r\n\r\n1\r\n00:01.500 --> 01:00:02.000 line:0\r\n<i>One</i>\r\ntwo\r\n\r\n00:03.000 --> 00:04.000\r\nlast';
    expect(await read(text)).toEqual([
      ['1', 1.5, 3602, '<i>One</i>\ntwo'],
      ['', 3, 4, 'last'],
    ]);
    expect(await read('WEBVTT')).toEqual([]);
  });

  it('begins with its name', async () => {
    expect(await read('1\n00:00:01,500 --> 00:00:02,000\nSubRip')).toBeUndefined();
    expect(await read('WEBVTTX\n\n00:01.000 --> 00:02.000\nx')).toBeUndefined();
    expect(await read('')).toBeUndefined();
  });
});

it('a language is named as its speakers name it', () => {
  expect(['pt', 'de-AT', 'fr', '', 'not a tag'].map(nameOf)).toEqual(['Português', 'Österreichisches Deutsch', 'Français', '', '']);
});

describe('of the tracks, these are shown', () => {
  /** Returns a list with tracks of languages, and what it tells the player. */
  const list = (...languages: string[]) => {
    const told: boolean[] = [];
    const tracks = new StoryTextTracks(
      (shown) => told.push(shown),
      () => undefined,
    );
    const added = languages.map((language) => tracks.addElement({ kind: 'subtitles', label: '', language }, false));
    return { tracks, added, told, shown: () => tracks.shown.map(({ language }) => language).join(' ') };
  };

  it('those of the mode showing, instead of the own captions', () => {
    const { tracks, added, told, shown } = list('pt', 'de');
    tracks.setStory('en', true);
    const [pt, de] = added;
    expect([shown(), pt?.mode, told]).toEqual(['en', 'disabled', []]);
    if (pt === undefined || de === undefined) return;
    de.mode = 'hidden';
    pt.mode = 'showing';
    expect([shown(), tracks.own?.mode, de.mode, told]).toEqual(['pt', 'disabled', 'hidden', [true]]);
    de.mode = 'showing';
    expect([shown(), pt.mode, told]).toEqual(['pt de', 'showing', [true, true]]);
    pt.mode = 'hidden';
    expect([shown(), told]).toEqual(['de', [true, true, true]]);
    de.mode = 'hidden';
    expect([shown(), told]).toEqual(['', [true, true, true, false]]);
    tracks.setShown(true);
    expect(shown()).toBe('de');
    pt.mode = 'showing';
    if (tracks.own !== undefined) tracks.own.mode = 'showing';
    expect([shown(), pt.mode, de.mode]).toEqual(['en', 'disabled', 'disabled']);
  });

  it('the one that a user chose, instead of all others', () => {
    const { tracks, added, told, shown } = list('pt', 'de');
    tracks.setStory('en', true);
    const [pt, de] = added;
    if (pt === undefined || de === undefined) return;
    pt.mode = de.mode = 'showing';
    tracks.select(pt);
    expect([shown(), de.mode]).toEqual(['pt', 'disabled']);
    tracks.select(undefined);
    expect([shown(), pt.mode]).toEqual(['', 'disabled']);
    tracks.setShown(true);
    expect(shown()).toBe('pt');
    tracks.select(tracks.own);
    expect([shown(), told]).toEqual(['en', [true, true, true, false, true]]);
  });

  it('that of the story, where a track has nothing to show or goes', () => {
    const { tracks, added, shown } = list('pt', 'de');
    tracks.setStory('en', true);
    const [pt, de] = added;
    if (pt === undefined || de === undefined) return;
    pt.mode = 'showing';
    tracks.giveUp(pt);
    expect([shown(), pt.mode]).toEqual(['en', 'disabled']);
    de.mode = 'showing';
    tracks.remove(de);
    expect([shown(), tracks.length]).toEqual(['en', 2]);
  });

  it('that of the language chosen last, where another story has it', () => {
    const { tracks, added, shown } = list('pt');
    tracks.setStory('en', true);
    if (added[0] !== undefined) added[0].mode = 'showing';
    tracks.setStory(undefined, false);
    tracks.setStory('de', true);
    expect(shown()).toBe('pt');
    if (added[0] !== undefined) tracks.remove(added[0]);
    expect(shown()).toBe('de');
    tracks.addElement({ kind: 'captions', label: '', language: 'pt-BR' }, false);
    expect(shown()).toBe('pt-BR');
    tracks.setShown(false);
    tracks.setStory(undefined, false);
    tracks.setStory('en', false);
    expect(shown()).toBe('');
  });

  it('a default one, unless a language was chosen before', () => {
    const { tracks, told, shown } = list();
    tracks.addElement({ kind: 'subtitles', label: '', language: 'pt' }, true);
    tracks.addElement({ kind: 'subtitles', label: '', language: 'de' }, true);
    tracks.setStory('en', true);
    expect([shown(), told]).toEqual(['pt', [true]]);
  });
});
