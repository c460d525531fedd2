/** Tests of another text for the figure on stage, and of page overlays over the image. */

import type { Locator } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, poseOf, test } from './stage.js';

/** Returns a script with the right hand at a place, from 1 to 3 s. */
const text = (x: number) => `<eml><body><gesture-is-on time="0" isOn="true"/>
  <gesture-key time="1" duration="2" handedness="right"><motion><key time="0" x="${x}" y="20" z="-14"/><key time="2" x="${x}" y="20" z="-14"/></motion></gesture-key>
</body></eml>`;

/** Returns the target of the right arm, world, metres, and its final error. */
async function target(player: Locator): Promise<readonly number[] | undefined> {
  const arm = (await poseOf(player))?.targets.find(({ name }) => name === 'rightArm');
  return arm && [...arm.position, arm.error];
}

test('a text is put on stage without a file, and changed in place', async ({ stage }) => {
  await stage.open('<raconteur-player></raconteur-player>');
  const { player } = stage;
  expect(await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), text(-10))).toEqual([]);
  await stage.ready();
  await stage.seek(2);
  const [before, canvas] = [await target(player), await player.locator('canvas').elementHandle()];
  expect(before?.[3]).toBeLessThan(0.001);
  const first = await stage.picture();

  await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), text(-20));
  const after = await target(player);
  // Ten units of a figure that is 77 units tall.
  expect((before?.[0] ?? 0) - (after?.[0] ?? 0)).toBeCloseTo((10 / 77) * 1.66, 1);
  expect(await stage.time()).toBe(2);
  expect(await canvas?.evaluate((c) => c.isConnected)).toBe(true);
  const second = await stage.picture();
  expect(await stage.difference(first.png, second.png)).toBeGreaterThan(0.3);

  // The same text gives the same frame again, so the text caused the change.
  await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), text(-10));
  expect(await target(player)).toEqual(before);
});

test('while it plays it goes on, and a longer text plays to its end', async ({ stage }) => {
  await stage.open('<raconteur-player></raconteur-player>');
  const { player } = stage;
  const until = (secs: number, x: number) => text(x).replace('</body>', `<null time="${secs}"/></body>`);
  await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), until(100, -10));
  await stage.ready();
  await player.evaluate((p: RaconteurPlayer) => p.play());
  await stage.until(0.5);
  for (let i = 0; i < 20; i += 1) await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), until(100, -10 - i / 2));
  const at = await stage.time();
  await stage.until(at + 0.5);
  await player.evaluate((p: RaconteurPlayer, eml) => p.rehearse(eml), until(200, -10));
  expect(await player.evaluate((p: RaconteurPlayer) => [p.paused, p.duration])).toEqual([false, 200]);
  expect(await stage.events()).not.toContain('pause');
});

test('a bad text tells where, and the rest plays; so does a story of a file with its voice', async ({ stage }) => {
  await stage.load('hello-world');
  const { player } = stage;
  const words = await player.evaluate((p: RaconteurPlayer) => p.duration);
  await stage.seek(0.5);
  const eml = await (await stage.page.request.get('/assets/stories/hello-world/story.eml')).text();
  const bad = eml.replace('</body>', '  <gesture-key time="3" duration="long"/>\n</body>');
  const told = await player.evaluate((p: RaconteurPlayer, t) => p.rehearse(t), bad);
  expect(told).toMatchObject([{ code: 'eml::bad-time', severity: 'error', start: { line: bad.slice(0, bad.indexOf('duration="long"')).split('\n').length } }]);
  expect(await player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toEqual(['eml::bad-time']);
  expect(await player.evaluate((p: RaconteurPlayer) => p.duration)).toBeCloseTo(words, 6);
  expect(await stage.time()).toBe(0.5);
  // The voice is the one of the bundle, still.
  await stage.play();
  await stage.until(1.2);
  expect(await stage.page.evaluate(() => window.record.starts.length)).toBeGreaterThan(0);
  expect(await player.evaluate((p: RaconteurPlayer, t) => p.rehearse(t), eml)).toEqual([]);
});
