/** Tests of many players on one page, each with its own device: all render simultaneously, and none is blank. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { sized } from '../../web/test/tier.js';
import { story } from './fixture.js';
import { expect, ready, test } from './stage.js';

const PLAYERS = sized(4, 8);
/** Minimum mean absolute difference of an image from its own mean: a canvas of one colour has none. */
const MIN_SPREAD = 4;

/** Returns the rendering of each player, as grey values of a few points: screenshots of the window would stall a machine that plays eight stories. */
const looks = (page: Page): Promise<number[][]> =>
  page.evaluate(() =>
    [...document.querySelectorAll<RaconteurPlayer>('raconteur-player')].map((player) => {
      const context = new OffscreenCanvas(28, 38).getContext('2d');
      const picture = player.snapshot();
      if (context === null || picture === undefined) return [];
      context.drawImage(picture, 0, 0, 28, 38);
      return [...context.getImageData(0, 0, 28, 38).data].filter((_, i) => i % 4 === 1);
    }),
  );

/** Returns the mean absolute difference from a reference. */
const apart = (look: readonly number[], from: (place: number) => number): number => look.reduce((sum, grey, k) => sum + Math.abs(grey - from(k)), 0) / look.length;

test(`${PLAYERS} players on one page paint at once, at rest and in play`, { tag: '@draws' }, async ({ stage, page }) => {
  test.setTimeout(300_000);
  const text = "<voice-text time='0'>All of us speak at once and for quite a while.</voice-text><null time='600'/>";
  const one = '<raconteur-player src="story.eml" quality="lowest" loading="eager" muted></raconteur-player>';
  await stage.open(`<main>${one.repeat(PLAYERS)}</main>`, {
    'story.eml': story(text),
    'test.css': 'main { display: grid; grid-template-columns: repeat(4, 112px); gap: 4px } raconteur-player { width: 112px; height: 150px; aspect-ratio: auto } body { margin: 0 }',
  });
  const players = await page.locator('raconteur-player').all();
  expect(players).toHaveLength(PLAYERS);
  for (const player of players) await ready(player);
  const shown = () =>
    page.evaluate(() =>
      [...document.querySelectorAll<RaconteurPlayer>('raconteur-player')].map((player) => ({
        first: player.statistics?.firstFrameMs ?? 0,
        calls: player.statistics?.drawCalls ?? 0,
        backend: player.backend,
      })),
    );
  await expect.poll(async () => (await shown()).every(({ first, calls }) => first > 0 && calls > 0), { timeout: 60_000 }).toBe(true);
  for (const { spread } of await Promise.all(players.map((player) => stage.picture(player)))) expect(spread).toBeGreaterThan(MIN_SPREAD);
  await page.evaluate(() => Promise.all([...document.querySelectorAll<RaconteurPlayer>('raconteur-player')].map((player) => player.play())));
  await stage.until(1, players.at(-1));
  const before = await looks(page);
  const times = await Promise.all(players.map((player) => stage.time(player)));
  for (const [i, player] of players.entries()) await stage.until((times[i] ?? 0) + 1.5, player);
  for (const [i, look] of (await looks(page)).entries()) {
    const mean = look.reduce((sum, grey) => sum + grey, 0) / look.length;
    expect(
      apart(look, () => mean),
      `player ${i}`,
    ).toBeGreaterThan(MIN_SPREAD);
    expect(
      apart(look, (k) => before[i]?.[k] ?? 0),
      `player ${i}`,
    ).toBeGreaterThan(0.05);
  }
});
