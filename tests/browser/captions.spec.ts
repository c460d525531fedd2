/** Tests of captions: their lines, and the area that they leave visible. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, poseOf, test, type Stage } from './stage.js';

/** Opens a story of the library with captions and no controls, on a stage of a given size, and shows a time of it. */
async function at(stage: Stage, story: string, secs: number, [width, height]: readonly [number, number]): Promise<void> {
  await stage.open(`<raconteur-player src="/assets/stories/${story}/story.eml" quality="lowest" captions></raconteur-player>`, {
    'test.css': `raconteur-player { width: ${width}px; height: ${height}px; aspect-ratio: auto } body { margin: 0 }`,
  });
  await stage.ready();
  await stage.seek(secs);
  await expect(stage.player.locator('.captions')).toBeVisible();
}

/** Returns the lowest position of some joints in the image, and the top of the captions: CSS pixels from the stage's top. */
async function lowest(stage: Stage, joints: readonly string[]): Promise<{ joint: number; captions: number }> {
  const size = await stage.player.evaluate((p: RaconteurPlayer) => ({ width: p.clientWidth, height: p.clientHeight }));
  const pose = await poseOf(stage.player);
  const spots = joints.map((name) => {
    const joint = pose?.joints.find((one) => one.name === name);
    return joint && pose?.camera.project(joint.position, size.width, size.height)?.y;
  });
  for (const y of spots) expect(y).toBeDefined();
  const [stageBox, box] = await Promise.all([stage.player.boundingBox(), stage.player.locator('.captions > span').boundingBox()]);
  return { joint: Math.max(...spots.map((y) => y ?? NaN)), captions: (box?.y ?? NaN) - (stageBox?.y ?? NaN) };
}

for (const size of [
  [640, 400],
  [390, 480],
] as const) {
  test(`feet and resting hands are seen above captions, on a stage of ${size.join(' × ')}`, async ({ stage }) => {
    await at(stage, 'step-lesson', 20, size);
    const feet = await lowest(stage, ['bone_l_subtalar', 'bone_r_subtalar']);
    expect(feet.joint).toBeLessThan(feet.captions);
    await at(stage, 'white-rabbit', 16.5, size);
    const hands = await lowest(stage, ['bone_l_wrist', 'bone_r_wrist']);
    expect(hands.joint).toBeLessThan(hands.captions);
  });
}

test('without captions the picture is as it was', async ({ stage }) => {
  await at(stage, 'step-lesson', 20, [640, 400]);
  const size = async () => (await poseOf(stage.player))?.camera.pixelsPerMetre([0, 1, 0], 400) ?? NaN;
  const above = await size();
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.captions = false));
  await expect.poll(size).toBeGreaterThan(1.05 * above);
});

test('a caption has the lines of its verse', async ({ stage }) => {
  await at(stage, 'virtual-poets/os-lusiadas', 11, [640, 400]);
  const lines = await stage.player.locator('.captions > span').evaluate((span) => (span as HTMLElement).innerText.split('\n'));
  expect(lines.map((line) => line.trim())).toEqual(['por mares nunca de antes navegados', 'passaram ainda além da Taprobana,']);
});
