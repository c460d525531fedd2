/** Tests that a stalled resource delays nothing independent of it. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page, Route } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const CLAP = 'arms-overhead-clap';
const CLIP = readFileSync(join(import.meta.dirname, `../../assets/animations/${CLAP}.json`));

const ANIMATED = story(
  `<body-player-add time='0' name='arms' type='multiple'/>
  <body-deterministic-primitive time='0' primitive='push' player='arms' animationSetName='${CLAP}'><tracks><ly index='0'/></tracks></body-deterministic-primitive><null time='6'/>`,
);
const PLAIN = story("<null time='2'/>");

/** Requests for the animation, which wait until the test answers. */
async function hold(page: Page): Promise<Route[]> {
  const held: Route[] = [];
  await page.route(`**/animations/${CLAP}.json`, (route) => void held.push(route));
  return held;
}

const open = (stage: Stage): Promise<void> =>
  stage.open('<raconteur-player src="story.eml" quality="lowest" loading="eager"></raconteur-player>', { 'story.eml': ANIMATED, 'plain.eml': PLAIN });

const codes = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code));
const state = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => [p.readyState, p.duration] as const);
const pose = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => [...(p.pose()?.numbers ?? [])]);

test('an animation that does not come does not hold up the next story', async ({ stage, page }) => {
  const held = await hold(page);
  await open(stage);
  await expect.poll(() => held.length, { timeout: 60_000 }).toBe(1);
  const sinceMs = Date.now();
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.src = 'plain.eml'));
  await expect.poll(() => state(stage), { timeout: 60_000 }).toEqual([4, 2]);
  // The new story does not wait for the timeout of the old one.
  expect(Date.now() - sinceMs).toBeLessThan(15_000);
  expect(await codes(stage)).toEqual([]);
});

test('a story goes on without an animation that does not come, and takes it when it does', async ({ stage, page }) => {
  const held = await hold(page);
  await open(stage);
  await stage.ready();
  await stage.play();
  await stage.until(0.5);
  await stage.pause();
  const at = async (secs: number) => {
    await stage.seek(secs);
    return JSON.stringify(await pose(stage));
  };
  const times = [3, 3.5, 4, 4.5, 5, 5.5];
  const without = new Map<number, string>();
  for (const secs of times) without.set(secs, await at(secs));
  await stage.seek(0.5);
  await held[0]?.fulfill({ body: CLIP, contentType: 'application/json' });
  // The animation eases in from the story time at which it arrives, which may be the time being
  // read. Each reading uses a later time, and the story returns to its start between two readings.
  await expect
    .poll(async () => {
      const secs = times.shift() ?? 5.9;
      const now = await at(secs);
      await stage.seek(0.5);
      return now !== (without.get(secs) ?? now);
    })
    .toBe(true);
  expect(await codes(stage)).toEqual([]);
});

test('an animation that could not be had is told, and asked for again with the next load', async ({ stage, page }) => {
  let has = false;
  await page.route(`**/animations/${CLAP}.json`, (route) => (has ? route.fulfill({ body: CLIP, contentType: 'application/json' }) : route.fulfill({ status: 503 })));
  await open(stage);
  await stage.ready();
  await expect.poll(() => codes(stage)).toContain('player::no-animation');
  has = true;
  await stage.player.evaluate((p: RaconteurPlayer) => p.load());
  await stage.ready();
  expect(await codes(stage)).toEqual([]);
});
