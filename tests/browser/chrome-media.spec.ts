/** Tests of third-party media controls with the player: media-chrome, unchanged from npm. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story, voiceFiles } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const CONTROLS = join(import.meta.dirname, '../../node_modules/media-chrome/dist/iife/all.js');

const PAGE = `<media-controller style="width: 460px; height: 300px">
    <raconteur-player slot="media" src="story.eml" quality="lowest" loading="eager" style="width: 100%; height: 100%; aspect-ratio: auto"></raconteur-player>
    <media-loading-indicator slot="centered-chrome"></media-loading-indicator>
    <media-control-bar>
      <media-play-button></media-play-button><media-seek-forward-button seekoffset="5"></media-seek-forward-button>
      <media-mute-button></media-mute-button><media-volume-range></media-volume-range>
      <media-time-range></media-time-range><media-time-display showduration></media-time-display>
      <media-playback-rate-button rates="1 1.5"></media-playback-rate-button><media-captions-button></media-captions-button>
    </media-control-bar>
  </media-controller>
  <script src="controls.js"></script>`;

async function open(stage: Stage): Promise<void> {
  const made = [{ text: 'One two three', msec: 20_000, samples: new Float32Array(882_000) }];
  const files = { 'story.eml': story("<voice-text time='0'>One two three</voice-text>"), 'controls.js': readFileSync(CONTROLS), ...voiceFiles(made) };
  // Their styles are in their script, which a strict policy forbids.
  await stage.open(PAGE, files, '', false);
  await stage.ready();
}

/** Returns an attribute of the media controller, as received by the controls. */
const understood = (stage: Stage, attribute: string) => stage.page.locator('media-controller').getAttribute(attribute);

test('controls for media elements drive the player', async ({ stage, page }) => {
  await open(stage);
  const state = () => stage.player.evaluate((p: RaconteurPlayer) => ({ paused: p.paused, muted: p.muted, captions: p.captions, rate: p.playbackRate, secs: p.currentTime }));
  await expect.poll(() => understood(stage, 'mediaduration')).toBe('20');
  expect(await understood(stage, 'mediapaused')).toBe('');
  expect(await understood(stage, 'mediasubtitleslist')).toBe('cc:en:Captions');
  await page.locator('media-play-button').click();
  await stage.until(0.2);
  await expect.poll(() => understood(stage, 'mediapaused')).toBe(null);
  await expect.poll(() => understood(stage, 'mediabuffered')).toBe('0:20');
  await page.locator('media-mute-button').click();
  await page.locator('media-captions-button').click();
  await page.locator('media-playback-rate-button').click();
  await page.locator('media-seek-forward-button').click();
  await expect.poll(async () => ({ ...(await state()), secs: 0 })).toEqual({ paused: false, muted: true, captions: true, rate: 1.5, secs: 0 });
  expect((await state()).secs).toBeGreaterThan(5);
  expect(await understood(stage, 'mediasubtitlesshowing')).toBe('cc:en:Captions');
  await page.locator('media-time-range input').fill('0.1');
  await expect.poll(async () => (await state()).secs).toBeLessThan(4);
  await page.locator('media-play-button').click();
  await expect.poll(async () => (await state()).paused).toBe(true);
  // The controls follow changes that the player makes itself.
  await stage.player.evaluate((p: RaconteurPlayer) => Object.assign(p, { muted: false, captions: false, currentTime: 12 }));
  await expect.poll(() => understood(stage, 'mediacurrenttime')).toBe('12');
  await expect.poll(() => understood(stage, 'mediasubtitlesshowing')).toBe(null);
  await expect.poll(() => understood(stage, 'mediavolumelevel')).toBe('high');
});
