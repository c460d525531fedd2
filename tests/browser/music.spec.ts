/** Music under a story. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test, type Stage } from './stage.js';

declare global {
  interface Window {
    /** Pieces of music with their gain nodes. */
    music: { sound: HTMLAudioElement; gain: GainNode | undefined }[];
  }
}

/** Runs before the page's own scripts: records the sources that Web Audio plays. */
function listen(): void {
  window.music = [];
  const create = AudioContext.prototype.createMediaElementSource;
  AudioContext.prototype.createMediaElementSource = function (sound) {
    const source = create.call(this, sound);
    const note: { sound: HTMLAudioElement; gain: GainNode | undefined } = { sound: sound as HTMLAudioElement, gain: undefined };
    window.music.push(note);
    const connect = source.connect.bind(source) as (node: AudioNode) => AudioNode;
    source.connect = ((node: AudioNode) => {
      if (node instanceof GainNode) note.gain = node;
      return connect(node);
    }) as typeof source.connect;
    return source;
  };
}

/** Returns a story of 45 s with some music and without words. */
const story = (music: string): string => `<eml xmlns:r='urn:raconteur:eml:1'><body>${music}<null time='45'/></body></eml>`;

async function open(stage: Stage, page: Page, music: string): Promise<void> {
  await page.addInitScript(listen);
  await stage.open('<raconteur-player src="/test/story.eml" controls></raconteur-player>', { 'story.eml': story(music) });
  await stage.ready();
}

/** Returns the deviation of the first piece from the story's position, measured at the output, its level, and its playing state. */
function state(page: Page): Promise<{ drift: number; level: number; rate: number; paused: boolean }> {
  return page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => {
    const [piece] = window.music;
    const late = window.record.contexts[0]?.outputLatency ?? NaN;
    return {
      // Audio computed now is audible after this latency; the player ignores more than a second.
      drift: (piece?.sound.currentTime ?? NaN) - p.currentTime - (late < 1 ? late * p.playbackRate : 0),
      level: piece?.gain?.gain.value ?? NaN,
      rate: piece?.sound.playbackRate ?? NaN,
      paused: piece?.sound.paused ?? true,
    };
  });
}

/** Maximum deviation, seconds: the clock of the output is some hundredths behind that of the graph, and software rendering is slow. */
const NEAR_SECS = 0.15;

test('music plays in time, after a seek and at another speed as well', async ({ stage, page }) => {
  await open(stage, page, "<r:music time='0' valence='positive' volume='0.5' fade='1'/>");
  await stage.play();
  await stage.until(2);
  await expect.poll(async () => Math.abs((await state(page)).drift)).toBeLessThan(NEAR_SECS);
  await expect.poll(async () => (await state(page)).level).toBeCloseTo(0.5, 1);

  await stage.seek(20);
  await expect.poll(async () => (await state(page)).paused).toBe(false);
  await stage.until(21);
  await expect.poll(async () => Math.abs((await state(page)).drift)).toBeLessThan(NEAR_SECS);

  await stage.player.evaluate((p: RaconteurPlayer) => void (p.playbackRate = 1.5));
  await stage.until(25);
  await expect.poll(async () => Math.abs((await state(page)).rate / 1.5 - 1)).toBeLessThan(0.02);
  await expect.poll(async () => Math.abs((await state(page)).drift)).toBeLessThan(1.5 * NEAR_SECS);
  expect(await page.evaluate(() => window.music[0]?.sound.preservesPitch)).toBe(true);

  await stage.pause();
  expect((await state(page)).paused).toBe(true);
  // The piece and the voices that arousal adds.
  expect(await page.evaluate(() => window.music.length)).toBe(2);
});

test('what is felt has music, which does not keep the story waiting', async ({ stage, page }) => {
  await open(stage, page, "<r:emotion time='0' type='joy' potential='8' duration='40'/>");
  await stage.play();
  await stage.until(20);
  const { music } = (await stage.player.evaluate((p: RaconteurPlayer) => p.expressed)) ?? { music: [] };
  expect(music).toEqual(['positive-lively.opus', 'positive-lively-rise.opus']);
  await expect.poll(() => page.evaluate(() => window.music.some(({ sound, gain }) => sound.src.includes('positive-lively.') && (gain?.gain.value ?? 0) > 0.3))).toBe(true);
});

test('a story goes on without music that is not there', async ({ stage, page }) => {
  await open(stage, page, "<r:music time='0' file='absent.opus'/>");
  await stage.play();
  await stage.until(1.5);
  const found = await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => d.code === 'sound-missing').map((d) => d.message));
  expect(found).toEqual([expect.stringContaining('absent.opus')]);
});

test('no file outside the folder of the story is asked for', async ({ stage, page }) => {
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  await open(stage, page, "<r:music time='0' file='../secret.opus'/>");
  await stage.play();
  await stage.until(1);
  expect(asked.filter((url) => url.includes('secret'))).toEqual([]);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('eml::bad-path');
});

test('stories without music do not fetch what plays it', async ({ stage, page }) => {
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  await open(stage, page, "<null time='2'/>");
  expect(asked.filter((url) => /\/music-/.test(url))).toEqual([]);
});
