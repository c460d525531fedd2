/** The face: emotions on the disc, muscles, speech over time, and the layers under the skin. */

import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { curvesOf, type DirectControl, type FaceCurves } from '../../web/element/face/course.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { expect, ready, test } from './stage.js';

/** Opens the page paused, two seconds into its script. */
async function open(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.goto('/face/');
  const player = page.locator('raconteur-player');
  await ready(player);
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBe(2);
}

const eml = (page: Page): Promise<string> => page.locator('#eml').evaluate((code) => code.textContent ?? '');

/** Muscles by name, as the table has them; pairs are left and right. */
const PAIRS = readFileSync(new URL('../../crate/tissue/src/muscles.tsv', import.meta.url), 'utf8')
  .trimEnd()
  .split('\n')
  .slice(1)
  .map((row) => row.split('\t').slice(0, 2));
const MUSCLES = PAIRS.flatMap(([name = '', sides]) => (sides === 'pair' ? [`${name}Left`, `${name}Right`] : [name]));

/** Returns the controls of the face at `count` times. */
async function curves(page: Page, times: (p: RaconteurPlayer) => readonly [from: number, to: number, count: number]): Promise<FaceCurves> {
  const player = page.locator('raconteur-player');
  const [from, to, count] = await player.evaluate(times);
  const told = await player.evaluate((p: RaconteurPlayer, [a, b, n]) => [...(p.course(a, b, n)?.curves ?? [])], [from, to, count] as const);
  return curvesOf({ curves: Float32Array.from(told) }, count);
}

/** Indices of three muscles. */
const [INNER_BROW, SMILE_LEFT, SMILE_RIGHT] = ['FrontalisMedialLeft', 'ZygomaticusMajorLeft', 'ZygomaticusMajorRight'].map((name) => MUSCLES.indexOf(name)) as [
  number,
  number,
  number,
];

/** Returns the current value of a muscle or another control. */
async function control(page: Page, which: number | DirectControl): Promise<number> {
  const { muscles, direct } = await curves(page, (p) => [p.currentTime, p.currentTime, 1]);
  return (typeof which === 'number' ? muscles[which] : direct[which])?.[0] ?? NaN;
}

/** Presses a button as soon as possible, without waiting for an image rendered in software. */
async function press(page: Page, name: string): Promise<void> {
  const button = page.getByRole('button', { name, exact: true });
  await expect(button).toBeEnabled();
  await button.evaluate((b: HTMLElement) => b.click());
}
const turnTo = (page: Page, tab: string): Promise<void> => page.getByRole('tab', { name: tab }).evaluate((b: HTMLElement) => b.click());
const slide = (page: Page, name: string, value: number): Promise<void> => page.getByRole('slider', { name, exact: true }).fill(String(value));

test('the disc is dragged and moved by keys, and the face follows', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const before = await control(page, SMILE_LEFT);
  const disc = page.getByRole('button', { name: /^Emotion:/ });
  const box = await disc.boundingBox();
  if (box === null) throw new Error('no disc');
  // Joy has an evaluation of 42 and an activation of 17; the disc extends 108 to every side.
  const spot = (e: number, a: number): [number, number] => [box.x + (box.width * (1 + e / 108)) / 2, box.y + (box.height * (1 - a / 108)) / 2];
  await page.mouse.move(...spot(0, 0));
  await page.mouse.down();
  await page.mouse.move(...spot(20, 9));
  await page.mouse.move(...spot(41, 17));
  await page.mouse.up();
  await expect.poll(() => eml(page)).toMatch(/parameterId="(joy|love|pride|admiration|gratitude|satisfaction)"/);
  await expect.poll(() => control(page, SMILE_LEFT)).toBeGreaterThan(before + 0.4);
  // One drag is one step.
  await press(page, 'Undo');
  await expect.poll(() => eml(page)).not.toContain('parameterId');
  await expect.poll(() => control(page, SMILE_LEFT)).toBeLessThan(before + 0.05);

  await disc.focus();
  for (let i = 0; i < 9; i++) await page.keyboard.press('Shift+ArrowUp');
  await expect(disc).toHaveAttribute('aria-label', /9\d? % surprise/);
  await expect.poll(() => control(page, INNER_BROW)).toBeGreaterThan(0.5);
  await page.keyboard.press('Home');
  await expect(disc).toHaveAttribute('aria-label', /^Emotion: neutral/);

  await page.getByLabel('Word of emotion').selectOption('fear');
  await expect.poll(() => eml(page)).toContain('parameterId="fear" value="1"');
  await expect(page.getByRole('slider', { name: 'Power' })).toHaveValue('-79');
  await expect(page.locator('#problems')).toBeEmpty();
});

test('every muscle has a slider, both sides together or each for itself', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await turnTo(page, 'Muscles');
  await expect(page.locator('.dial')).toHaveCount(PAIRS.length);
  await slide(page, 'Zygomaticus major', 0.9);
  await expect.poll(() => eml(page)).toContain('parameterId="ZygomaticusMajor" value="0.9"');
  await expect.poll(() => control(page, SMILE_RIGHT)).toBeGreaterThan(0.85);
  await page.getByLabel('Left and right together').evaluate((b: HTMLElement) => b.click());
  await expect(page.locator('.dial')).toHaveCount(MUSCLES.length);
  await slide(page, 'Zygomaticus major, right', 0);
  await expect.poll(() => eml(page)).toContain('parameterId="ZygomaticusMajorLeft" value="0.9"');
  await expect.poll(() => control(page, SMILE_RIGHT)).toBeLessThan(0.2);
  expect(await control(page, SMILE_LEFT)).toBeGreaterThan(0.85);
  await press(page, 'Reset all');
  await expect.poll(() => eml(page)).not.toContain('Zygomaticus');

  await turnTo(page, 'Jaw & more');
  await slide(page, 'Open', 1);
  await slide(page, 'Blush', -1);
  await expect.poll(() => control(page, 'jawPitch')).toBeGreaterThan(0.3);
  await expect.poll(() => control(page, 'blush')).toBeLessThan(-0.9);
  await turnTo(page, 'Visemes');
  await expect(page.locator('.dial')).toHaveCount(15);
  await slide(page, 'PP', 1);
  await expect.poll(() => eml(page)).toContain('parameterId="VisemePP" value="1"');
  await expect(page.locator('#problems')).toBeEmpty();
  await page.keyboard.press('Control+z');
  await expect.poll(() => eml(page)).not.toContain('Viseme');
});

test('a sentence of a story is spoken in its voice, with phones and curves under it', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const player = page.locator('raconteur-player');
  await page.getByLabel('Story', { exact: true }).selectOption('white-rabbit');
  await expect.poll(() => eml(page)).toContain('white rabbit');
  await expect(page.locator('.phone')).not.toHaveCount(0);
  await player.evaluate((p: RaconteurPlayer) => p.pause());
  expect(await page.locator('.phone').count()).toBeGreaterThan(60);
  await expect(page.locator('.phone text').filter({ hasText: /^w$/ })).not.toHaveCount(0);
  await expect(page.locator('.curve')).toHaveCount(12);
  await expect(page.locator('.names')).toContainText('Lips sealed');
  // The bundle is available, so nothing is estimated.
  await expect(page.locator('#problems')).toBeEmpty();

  // Accompanying movements follow the audio or the text.
  const brows = async (): Promise<readonly number[]> => (await curves(page, (p) => [0, p.duration, 200])).muscles[INNER_BROW] ?? [];
  const bySound = await brows();
  await page.getByText('From its text').evaluate((b: HTMLElement) => b.click());
  await expect.poll(async () => (await brows()).some((v, i) => Math.abs(v - (bySound[i] ?? 0)) > 0.05)).toBe(true);

  await page.getByLabel('Your own line').fill('Peter Piper');
  await press(page, 'Speak');
  await expect.poll(() => eml(page)).toContain('Peter Piper');
  await expect.poll(() => page.locator('.phone').count()).toBeLessThan(30);
  await press(page, 'Silence');
  await expect(page.locator('.strip')).toHaveCount(0);
});

test('layers show springs and muscles, over the skin and without it', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const picture = async (): Promise<Buffer> => (await stage.picture()).png;
  // The head has moved to the centre.
  await page.waitForTimeout(1500);
  const seen = [await picture()];
  for (const layer of ['Muscles', 'Springs', 'Skin']) {
    await press(page, layer);
    const png = await picture();
    for (const other of seen) expect(await stage.difference(png, other), layer).toBeGreaterThan(0.2);
    seen.push(png);
  }
  expect(await eml(page)).toContain('r:isBodyVisible="false" r:areSpringsVisible="true" r:areMusclesVisible="true"');
  await expect(page.locator('#problems')).toBeEmpty();
  await press(page, 'Reset');
  await expect.poll(() => eml(page)).not.toContain('geometry');
  await press(page, 'Front');
  await expect(page.getByRole('button', { name: 'Front', exact: true })).toHaveAttribute('aria-pressed', 'true');
});

test('the text is saved as a file', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const [saved] = await Promise.all([page.waitForEvent('download'), press(page, 'Download')]);
  expect(saved.suggestedFilename()).toBe('face.eml');
  expect(readFileSync(await saved.path(), 'utf8')).toBe(await eml(page));
});

for (const [width, height] of [
  [1280, 720],
  [1440, 900],
  [1024, 768],
  [390, 844],
] as const) {
  test(`the last row of each panel is reached and seen at ${width} × ${height}`, async ({ stage, page }) => {
    expect(stage.backend).toBe('page');
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.setViewportSize({ width, height });
    // The layout is there without anybody on stage.
    await page.route(/\.(wasm|glb)$/, (route) => route.abort());
    await page.goto('/face/');
    for (const tab of ['Muscles', 'Jaw & more', 'Visemes']) {
      await turnTo(page, tab);
      const last = page.locator('.dial').last();
      // Keyboard focus reaches it.
      await last.getByRole('slider').focus();
      const seen = await last.evaluate((row) => {
        const { left, right, top, bottom } = row.getBoundingClientRect();
        const panel = row.closest('.panel');
        // The lower edge of a panel that scrolls fades.
        const edge = panel !== null && getComputedStyle(panel).maskImage !== 'none' ? panel.getBoundingClientRect().bottom - 32 : Infinity;
        const over = (x: number, y: number) => row.contains(document.elementFromPoint(x, y));
        return { top, bottom, edge, free: over(left + 4, top + 4) && over(right - 4, top + 4) && over((left + right) / 2, bottom - 4) };
      });
      expect(seen.top, tab).toBeGreaterThanOrEqual(0);
      expect(seen.bottom, tab).toBeLessThanOrEqual(Math.min(height, seen.edge + 1));
      expect(seen.free, tab).toBe(true);
    }
  });
}

test('the face is accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByLabel('Story', { exact: true }).selectOption('hello-world');
  await expect(page.locator('.phone')).not.toHaveCount(0);
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.pause());
  for (const look of LOOKS) {
    await lookAt(page, look);
    for (const tab of partsIn(look, ['Emotion', 'Muscles', 'Jaw & more', 'Visemes'])) {
      await turnTo(page, tab);
      await expectNoBarriers(page, `${tab}, ${look.device}`);
    }
  }
});
