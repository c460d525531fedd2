/** Tests of the viewer: animations in layers, limbs by hand and by joint, and the view under the skin. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { expect, poseOf, ready, test, type Stage } from './stage.js';

const figures = join(import.meta.dirname, '../../assets/figures');

/** Opens the viewer paused, two seconds into its script. */
async function open(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.goto('/viewer/');
  const player = page.locator('raconteur-player');
  await ready(player);
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBe(2);
  await expect(page.locator('.handle')).toHaveCount(5);
}

const eml = (page: Page): Promise<string> => page.locator('#eml').evaluate((code) => code.textContent ?? '');

/** Returns the present position of a joint, world, metres. */
async function joint(page: Page, name: string): Promise<number[]> {
  const joints = (await poseOf(page.locator('raconteur-player')))?.joints ?? [];
  return [...(joints.find((found) => found.name === name)?.position ?? [])];
}

const apart = (a: number[], b: number[]): number => Math.hypot(...a.map((x, i) => x - (b[i] ?? 0)));

/** Returns the image without the handles over it. */
async function picture(stage: Stage): Promise<Buffer> {
  await stage.page.locator('#overlay').evaluate((e: HTMLElement) => (e.style.visibility = 'hidden'));
  const { png } = await stage.picture();
  await stage.page.locator('#overlay').evaluate((e: HTMLElement) => (e.style.visibility = ''));
  return png;
}

/** Moves a slider like a user, in one step. */
const slide = (page: Page, name: string, value: number): Promise<void> => page.getByRole('slider', { name }).fill(String(value));

/** Performs an action, and waits until the player has read the resulting text. */
async function read(page: Page, act: () => Promise<void>): Promise<void> {
  const player = page.locator('raconteur-player');
  await player.evaluate((p: RaconteurPlayer) => {
    p.dataset['read'] = 'not yet';
    p.addEventListener('durationchange', () => (p.dataset['read'] = 'yes'), { once: true });
  });
  await act();
  await expect(player).toHaveAttribute('data-read', 'yes');
}

test('a hand follows the pointer, and undo brings it back', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const before = await joint(page, 'bone_r_wrist');
  const handle = page.locator('[data-limb=rightArm]');
  const box = await handle.boundingBox();
  if (box === null) throw new Error('no handle');
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= 6; i++) await page.mouse.move(x - 5 * i, y - 15 * i);
  await page.mouse.up();
  await expect(page.getByRole('tab', { name: 'Manipulators' })).toHaveAttribute('aria-selected', 'true');
  await expect.poll(() => eml(page)).toContain('joint-interpolation time="0" manipulator="rightArm"');
  await expect.poll(async () => (await joint(page, 'bone_r_wrist'))[1]).toBeGreaterThan((before[1] ?? 0) + 0.15);
  const after = await joint(page, 'bone_r_wrist');
  // It is under the pointer again: a target within reach is reached.
  const now = await handle.boundingBox();
  expect(Math.abs((now?.x ?? 0) + 22 - (x - 30))).toBeLessThan(6);
  expect(Math.abs((now?.y ?? 0) + 22 - (y - 90))).toBeLessThan(6);

  // The keyboard does the same, in units of the figure.
  await handle.focus();
  await page.keyboard.press('Shift+ArrowDown');
  await expect.poll(async () => apart(after, await joint(page, 'bone_r_wrist'))).toBeGreaterThan(0.05);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect.poll(async () => apart(after, await joint(page, 'bone_r_wrist'))).toBeLessThan(0.002);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect.poll(() => eml(page)).not.toContain('rightArm');
  await expect.poll(async () => apart(before, await joint(page, 'bone_r_wrist'))).toBeLessThan(0.002);
});

test('joints are turned by sliders, each limb and the head', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByRole('tab', { name: 'Manipulators' }).click();
  const cases = [
    ['Left arm', 'Shoulder, to the side', 80, 'bone_l_wrist', 'leftArm'],
    ['Right arm', 'Elbow, right arm', 90, 'bone_r_wrist', 'rightArm'],
    ['Left leg', 'Hip, forwards', 50, 'bone_l_subtalar', 'leftLeg'],
    ['Right leg', 'Knee, right leg', 60, 'bone_r_subtalar', 'rightLeg'],
    ['Head', 'Neck, forwards', 30, 'bone_skull', 'head'],
  ] as const;
  for (const [limb, slider, degrees, bone, name] of cases) {
    await page.getByText(limb, { exact: true }).click();
    const free = await joint(page, bone);
    await read(page, () => page.getByText('Its joints', { exact: true }).click());
    await expect.poll(() => eml(page)).toContain(`body-non-deterministic-fk time="0" manipulator="${name}"`);
    const before = await joint(page, bone);
    // They begin where they are, but for the turn of an upper arm about itself, which has no joint in
    // EML: some 20 degrees of it, by a forearm of a quarter of a metre. A hanging arm were 0.3 m away.
    expect(apart(free, before), limb).toBeLessThan(0.1);
    await slide(page, slider, degrees);
    await expect.poll(async () => apart(before, await joint(page, bone)), { message: slider }).toBeGreaterThan(0.02);
    await expect.poll(() => eml(page)).toMatch(new RegExp(`manipulator="${name}"[^>]*="${degrees}"`));
  }
});

test('a layer is weighed, and its animation fetched and played', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const knee = () => joint(page, 'bone_l_wrist');
  await slide(page, 'Weight, layer 1', 1);
  await slide(page, 'Weight, layer 2', 0);
  await page.getByLabel('Layer 1', { exact: true }).selectOption('arms-overhead-clap');
  await expect.poll(() => eml(page)).toContain('animationSetName="arms-overhead-clap"');
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void (p.currentTime = 3));
  // After half a circle of two seconds the hands meet over the head.
  await expect.poll(async () => (await knee())[1]).toBeGreaterThan(1.7);
  await slide(page, 'Weight, layer 2', 1);
  await expect(page.getByRole('slider', { name: 'Weight, layer 2' })).toHaveAttribute('aria-valuetext', /50 percent/);
  await expect.poll(async () => (await knee())[1]).toBeLessThan(1.6);

  for (const [mechanism, type] of [
    ['Body groups', 'bodyGroup'],
    ['Stances', 'pose'],
  ] as const) {
    await page.getByText(mechanism, { exact: true }).click();
    await expect.poll(() => eml(page)).toContain(`type="${type}"`);
  }
  const half = await knee();
  await slide(page, 'Blend', 1);
  await expect.poll(async () => apart(half, await knee())).toBeGreaterThan(0.02);
  await expect(page.locator('#problems')).toBeEmpty();
});

test('an animation goes on from where it is when its speed changes', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void (p.currentTime = 7.3));
  await page.getByText('How it plays').first().click();
  const knees = async () => [...(await joint(page, 'bone_l_knee')), ...(await joint(page, 'bone_r_knee'))];
  // The next frame shows that time.
  await page.waitForTimeout(500);
  const before = await knees();
  await read(page, () => slide(page, 'Speed, layer 1', 2));
  await expect.poll(() => eml(page)).toContain('time="7.3" player="layers" property="speed" newValue="2"');
  // At double speed throughout, it would be twice as far, that is at another step.
  expect(apart(before, await knees())).toBeLessThan(0.001);
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void (p.currentTime += 0.3));
  await expect.poll(async () => apart(before, await knees())).toBeGreaterThan(0.02);
  // From the start it is twice as fast all along.
  await page.getByRole('button', { name: 'From the start' }).click();
  await expect.poll(() => eml(page)).toContain('time="0" player="layers" property="speed" newValue="2"');
  expect(await eml(page)).not.toContain('time="7.3"');
});

test('the look changes the picture: wireframe, points, bones and clay are all different', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByRole('tab', { name: 'Look' }).click();
  const solid = await picture(stage);
  const seen: Buffer[] = [solid];
  for (const name of ['X-ray', 'Skeleton', 'Clay', 'Point cloud']) {
    await page.getByRole('button', { name }).click();
    await expect(page.getByRole('button', { name })).toHaveAttribute('aria-pressed', 'true');
    const png = await picture(stage);
    for (const other of seen) expect(await stage.difference(png, other), name).toBeGreaterThan(0.2);
    seen.push(png);
  }
  await page.getByRole('button', { name: 'As on stage' }).click();
  expect(await eml(page)).not.toContain('geometry');
  expect(await stage.difference(solid, await picture(stage))).toBeLessThan(0.05);
  await page.getByRole('checkbox', { name: /^Bones/ }).check();
  await page.getByRole('checkbox', { name: /^Skin/ }).uncheck();
  expect(await eml(page)).toContain('visibleMeshes="bones"');
});

test('the view turns by dragging and by keys', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const front = await picture(stage);
  await page.getByRole('button', { name: 'Back', exact: true }).click();
  expect(await stage.difference(front, await picture(stage))).toBeGreaterThan(1);
  await page.locator('#pad').focus();
  await page.keyboard.press('Home');
  await page.locator('#pad').blur();
  expect(await stage.difference(front, await picture(stage))).toBeLessThan(0.05);
  const box = await page.locator('#pad').boundingBox();
  if (box === null) throw new Error('no pad');
  await page.mouse.move(box.x + 30, box.y + 30);
  await page.mouse.down();
  await page.mouse.move(box.x + 130, box.y + 30, { steps: 4 });
  await page.mouse.up();
  expect(await stage.difference(front, await picture(stage))).toBeGreaterThan(1);
});

test('a file of the user is shown, and a wrong one says what is wrong', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const current = () => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.currentFigure);
  await page.getByLabel('Yours').setInputFiles({ name: 'broken.glb', mimeType: 'model/gltf-binary', buffer: Buffer.from('no figure at all') });
  await expect(page.locator('#cast-trouble')).toContainText('broken.glb', { timeout: 60_000 });
  expect(await current()).toBe('sofia');
  await page.getByLabel('Yours').setInputFiles({ name: 'mine.glb', mimeType: 'model/gltf-binary', buffer: readFileSync(join(figures, 'papous.glb')) });
  await expect.poll(current, { timeout: 60_000 }).toBe('mine.glb');
  await expect(page.locator('#cast-trouble')).toBeEmpty();
  // The settings stay, and work on the other figure.
  await page.getByRole('tab', { name: 'Look' }).click();
  const before = await picture(stage);
  await page.getByText('Wireframe').click();
  expect(await stage.difference(before, await picture(stage))).toBeGreaterThan(0.2);
});

test('the camera stays above the floor, however one drags, shifts and steps back', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const height = async (): Promise<number> => (await poseOf(page.locator('raconteur-player')))?.camera.eye[1] ?? NaN;
  const pad = page.locator('#pad');
  await pad.focus();
  for (const keys of [Array<string>(10).fill('ArrowDown'), Array<string>(6).fill('-'), Array<string>(12).fill('Shift+ArrowDown'), Array<string>(10).fill('ArrowDown')]) {
    for (const key of keys) await pad.press(key);
    await page.waitForTimeout(500);
    expect(await height()).toBeGreaterThan(0.1);
  }
  await pad.press('Home');
  const box = await pad.boundingBox();
  if (box === null) throw new Error('no pad');
  await page.mouse.move(box.x + 30, box.y + box.height - 40);
  await page.mouse.down();
  await page.mouse.move(box.x + 30, box.y + 20, { steps: 6 });
  await page.mouse.up();
  await page.waitForTimeout(500);
  expect(await height()).toBeGreaterThan(0.1);
  // The camera still shows the figure from below.
  const { eye, target } = (await poseOf(page.locator('raconteur-player')))!.camera;
  expect(eye[1]).toBeLessThan(target[1]);
});

test('the handle of the head leaves the face free, for every figure', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const player = page.locator('raconteur-player');
  for (const figure of ['Sofia', 'Papous', 'Nuno', 'Amara', 'Kenji', 'Lia']) {
    await page.getByRole('button', { name: figure, exact: true }).click();
    await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentFigure), { timeout: 60_000 }).toBe(figure.toLowerCase());
    await page.waitForTimeout(500);
    const pose = (await poseOf(player))!;
    const frame = (await player.boundingBox())!;
    const skull = pose.joints.find((found) => found.name === 'bone_skull')!;
    const dot = (await page.locator('[data-limb=head] span').boundingBox())!;
    // The crown of a head of middle size, metres above the joint.
    const crown = pose.camera.project([skull.position[0], skull.position[1] + 0.16, skull.position[2]], frame.width, frame.height)!;
    expect(dot.y + dot.height, figure).toBeLessThan(frame.y + crown.y);
    expect(dot.y, figure).toBeGreaterThan(frame.y);
  }
});

test('the text is copied and saved as a file', async ({ stage, page, context }) => {
  expect(stage.backend).toBe('page');
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await open(page);
  await page.getByRole('button', { name: 'Copy', exact: true }).click();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(await eml(page));
  const [saved] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Download' }).click()]);
  expect(saved.suggestedFilename()).toBe('viewer.eml');
  expect(readFileSync(await saved.path(), 'utf8')).toBe(await eml(page));
  await expect(page.locator('#status')).toHaveText('viewer.eml is saved.');
});

test('the viewer is accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  for (const look of LOOKS) {
    await lookAt(page, look);
    for (const tab of partsIn(look, ['Animations', 'Manipulators', 'Look'])) {
      await page.getByRole('tab', { name: tab }).click();
      if (tab === 'Manipulators') await page.getByText('A target').click();
      await expectNoBarriers(page, `${tab}, ${look.device}`);
    }
  }
});
