/** Choice of the performer: the story's choice, and the fallback if it is unavailable. */

import { beforeEach, expect, test, vi } from 'vitest';
import { PlayerError, type Diagnostic } from '../element/base/types.js';

const performerOf = vi.fn(() => Promise.resolve({ figure: 'nuno' }));
const fetchFigure = vi.fn((name: string, _library: URL, _wanted: unknown, url?: URL) =>
  name === 'nobody' ? Promise.reject(new PlayerError('The figure was not found.')) : Promise.resolve({ name, where: String(url), glb: new Uint8Array(), diagnostics: [] }),
);
vi.mock('../element/engine/backend.js', () => ({ performerOf }));
vi.mock('../element/engine/loader.js', () => ({ fetchFigure }));
const { fetchChoice, figureOf, USUAL_FIGURE } = await import('../element/story/cast.js');

beforeEach(() => vi.clearAllMocks());

test('only a text that may choose is read for it', async () => {
  const backend = () => Promise.resolve('webgl' as const);
  expect(await figureOf("<eml><head/><body><null time='1'/></body></eml>", backend)).toBeUndefined();
  expect(performerOf).not.toHaveBeenCalled();
  for (const element of ['r:performer', 'Performer', 'x:PERFORMER']) {
    expect(await figureOf(`<eml><head><${element} figure='nuno'/></head></eml>`, backend)).toBe('nuno');
  }
});

const story = new URL('https://x.org/stories/a/story.eml');
const told: Diagnostic[] = [];
const choose = async (choice: string | undefined) => {
  told.length = 0;
  const figure = await fetchChoice(choice, story, new URL('https://x.org/assets/'), { signal: new AbortController().signal, progress: () => undefined }, (d) => told.push(d));
  return [figure.name, figure.where];
};

test('a choice is of the library or of the folder of the story', async () => {
  expect(await choose(undefined)).toEqual([USUAL_FIGURE, 'undefined']);
  expect(await choose('papous')).toEqual(['papous', 'undefined']);
  expect(await choose('me/own.glb')).toEqual(['me/own.glb', 'https://x.org/stories/a/me/own.glb']);
  expect(told).toEqual([]);
});

test.each(['nobody', '../b/own.glb', '%2e%2e/b/own.glb', '/own.glb', 'https://evil.example/own.glb', '//evil.example/own.glb'])(
  'the usual figure performs where %s cannot',
  async (choice) => {
    expect((await choose(choice))[0]).toBe(USUAL_FIGURE);
    expect(told.map((d) => [d.code, d.severity])).toEqual([['figure-unusable', 'warning']]);
    // There was no request to another origin.
    for (const [, , , url] of fetchFigure.mock.calls) expect(url?.href ?? story.href).toContain('https://x.org/');
  },
);
