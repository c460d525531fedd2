/** Tests of the home page's stage: visible during playback, and free of elements without use for a visitor. */

import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, poseOf, ready, test } from './stage.js';

const STORIES = join(import.meta.dirname, '../../assets/stories');

/** Folders of stories, as the cards name them. */
const SHIPPED = readdirSync(STORIES, { recursive: true, encoding: 'utf8' })
  .filter((path) => path.endsWith('story.eml'))
  .map((path) => dirname(path).replaceAll('\\', '/'))
  .sort();

async function open(page: Page, width: number, height: number, hash = ''): Promise<void> {
  await page.setViewportSize({ width, height });
  await page.goto(`/${hash}`);
  await ready(page.locator('raconteur-player'));
}

/** Returns the part of the stage beyond the edges of the window, pixels; 0 if it is fully visible. */
const unseen = (page: Page): Promise<number> =>
  page.locator('raconteur-player').evaluate((p) => {
    const { top, bottom } = p.getBoundingClientRect();
    return Math.round(Math.max(0, -top, bottom - innerHeight));
  });

/** Taps the card of a story at its usual place, the lower edge of the window. Returns the hidden part of the stage immediately afterwards. */
const tap = (page: Page, name: RegExp): Promise<number> =>
  page.getByRole('button', { name }).evaluate((button: HTMLElement) => {
    button.scrollIntoView({ block: 'end', behavior: 'instant' });
    button.click();
    const { top, bottom } = document.querySelector('raconteur-player')!.getBoundingClientRect();
    return Math.round(Math.max(0, -top, bottom - innerHeight));
  });

test('a story that is tapped plays in sight at each width', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 390, 844);
  for (const [width, height] of [
    [390, 844],
    [1024, 768],
    [1440, 900],
  ] as const) {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    await page.setViewportSize({ width, height });
    // It glides there.
    expect(await tap(page, /Hello world/), `${width}`).toBeGreaterThan(0);
    await expect.poll(() => unseen(page)).toBe(0);
    await expect.poll(() => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.label)).toBe('Hello world');
    // Users who prefer reduced motion see the final state immediately.
    await page.emulateMedia({ reducedMotion: 'reduce' });
    expect(await tap(page, /Mathematical dance/), `${width}`).toBe(0);
    await expect.poll(() => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.label)).toBe('Mathematical dance');
  }
});

test('words of one’s own are said in sight on a phone', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page, 390, 844);
  expect(await unseen(page)).toBeGreaterThan(0);
  await page.getByLabel('Say it: your own words').fill('Hello there!');
  await page.getByRole('button', { name: 'Say it' }).click();
  await expect.poll(() => unseen(page)).toBe(0);
});

test('every story of the library is offered', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 1440, 900, '#the-road-not-taken');
  const offered = await page.locator('[data-story]').evaluateAll((all) => all.map((e) => (e as HTMLElement).dataset['story'] ?? ''));
  expect(offered.sort()).toEqual(SHIPPED);
  // The frame without the poem plays, in its own words.
  const player = page.locator('raconteur-player');
  await expect(page.locator('[data-story$=the-road-not-taken]')).toHaveAttribute('aria-pressed', 'true');
  await expect(page.locator('#lines')).toContainText('Robert Frost');
  await player.evaluate((p: RaconteurPlayer) => p.play());
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
});

test('remarks on a script do not stand on the stage', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 1440, 900, '#the-road-not-taken');
  const player = page.locator('raconteur-player');
  // Authors see diagnostics.
  expect(await player.evaluate((p: RaconteurPlayer) => p.diagnostics.length)).toBeGreaterThan(0);
  await expect(player.locator('[part=diagnostics]')).toBeHidden();
  await expect(page.locator('#own-remarks')).toBeHidden();
});

test('a visitor reads, folded, what is to be said of a figure of their own', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 1440, 900);
  const glb = readFileSync(join(STORIES, '../figures/sofia.glb'));
  // An image of the file is no longer valid.
  const length = glb.readUInt32LE(12);
  const gltf = JSON.parse(glb.toString('utf8', 20, 20 + length)) as { images: { bufferView: number }[]; bufferViews: { byteOffset?: number }[] };
  const at = 20 + length + 8 + (gltf.bufferViews[gltf.images[0]?.bufferView ?? -1]?.byteOffset ?? Number.NaN);
  glb.fill(0x55, at + 8, at + 400);
  await page.getByLabel('Yours').setInputFiles({ name: 'faded.glb', mimeType: 'model/gltf-binary', buffer: glb });
  const remarks = page.locator('#own-remarks');
  await expect(remarks).toBeVisible({ timeout: 60_000 });
  await expect(remarks.locator('li').first()).toBeHidden();
  await remarks.locator('summary').press('Enter');
  await expect(remarks.locator('li').first()).toContainText('cannot be shown');
  await page.getByRole('button', { name: 'Sofia' }).click();
  await expect(remarks).toBeHidden({ timeout: 60_000 });
});

test('the stage’s shadow does not dim who stands below it, by day and by night', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page, 1440, 900);
  const portrait = page.locator('.cast img').nth(2);
  const shadow = (value: string) => page.locator('raconteur-player').evaluate((p: HTMLElement, to) => (p.style.boxShadow = to), value);
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    await shadow('');
    const shaded = await portrait.screenshot();
    await shadow('none');
    expect(await stage.difference(shaded, await portrait.screenshot()), colorScheme).toBeLessThan(0.5);
  }
});

test('the disc that plays does not lie on the face at each width', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const player = page.locator('raconteur-player');
  for (const [width, height] of [
    [390, 844],
    [1024, 768],
    [1440, 900],
    [1920, 1080],
  ] as const) {
    await open(page, width, height);
    await page.reload();
    await ready(player);
    const pose = await poseOf(player);
    const frame = await player.boundingBox();
    const disc = await player.locator('.disc').boundingBox();
    const skull = pose?.joints.find((joint) => joint.name === 'bone_skull')?.position;
    if (pose === undefined || frame === null || disc === null || skull === undefined) throw new Error('nobody is on stage');
    // The face as a ball about the middle of the head, metres.
    const middle = [skull[0], skull[1] + 0.025, skull[2] + 0.03] as const;
    const at = pose.camera.project(middle, frame.width, frame.height)!;
    const reach = 0.12 * pose.camera.pixelsPerMetre(middle, frame.height) + disc.width / 2;
    expect(Math.hypot(disc.x + disc.width / 2 - frame.x - at.x, disc.y + disc.height / 2 - frame.y - at.y), `${width}`).toBeGreaterThan(reach);
  }
});
