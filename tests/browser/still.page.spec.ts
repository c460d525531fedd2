/**
 * Tests that the placeholder on the home page's stage equals the first image, so nothing jumps. With `UPDATE` in the environment the still is captured again,
 * which is required after a change of the first story's figure, shot or light.
 */

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test } from './stage.js';

const still = (name: string): string => join(import.meta.dirname, '../../web/pages/landing', name);
/**
 * Sizes of the stills: as high as stages are, with captions of the size that those have, since shots keep hands above them. The first is wider than any stage,
 * so its height alone determines the framing; on a phone the figure is centred and visible to the waist.
 */
const STILLS = [
  { name: 'still.webp', width: 1200, height: 500, caption: '20.8px' },
  { name: 'still-narrow.webp', width: 390, height: 488, caption: '15px' },
] as const;
/** Pixels of a still to one of the page. */
const DENSITY = 1.44;
/** WebP quality, the same as for packed portraits. */
const WEBP_QUALITY = 0.84;
/**
 * Maximum mean difference of images, of 255: compression and another size cause 3, a different arm pose 3, another light or shot 13 or more (software
 * rendering).
 */
const ALIKE = 8;

/** Waits for the first image, of a figure without motion, and removes overlays. */
async function open(page: Page, width: number, height: number): Promise<void> {
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  const drawn = () => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.statistics?.firstFrameMs ?? 0);
  await expect.poll(drawn, { timeout: 60_000 }).toBeGreaterThan(0);
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => {
    for (const over of p.shadowRoot?.querySelectorAll<HTMLElement>('.overlay, .lower, .notes') ?? []) over.style.opacity = '0';
  });
}

/** Returns the image on stage, with or without the canvas. */
async function look(page: Page, opacity: '0' | '1'): Promise<Buffer> {
  const canvas = page.locator('raconteur-player canvas');
  await canvas.evaluate((c: HTMLCanvasElement, value) => {
    c.style.transition = 'none';
    c.style.opacity = value;
  }, opacity);
  return await page.locator('raconteur-player').screenshot({ animations: 'disabled' });
}

/** Captures the image on stage, compressed as for the page. */
async function packed(page: Page, size: { width: number; height: number; caption: string }): Promise<Buffer> {
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer, { width, height, caption }) => {
    p.style.setProperty('--raconteur-caption-size', caption);
    Object.assign(p.style, { position: 'fixed', inset: '0', zIndex: '9', width: `${width}px`, height: `${height}px`, maxHeight: 'none', borderRadius: '0' });
  }, size);
  // The larger frame is rendered.
  await page.waitForTimeout(1500);
  const png = (await look(page, '1')).toString('base64');
  const webp = await page.evaluate(
    async ([source, quality]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${source}`;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      canvas.getContext('2d')?.drawImage(image, 0, 0);
      return canvas.toDataURL('image/webp', quality);
    },
    [png, WEBP_QUALITY] as const,
  );
  return Buffer.from(webp.split(',')[1] ?? '', 'base64');
}

// The resolution of a normal screen.
test.use({ deviceScaleFactor: 1 });

test('the still before the first picture is the first picture', async ({ stage, page, browser, baseURL }) => {
  expect(stage.backend).toBe('page');
  if (process.env['UPDATE'] !== undefined) {
    await page.goto('/');
    const context = await browser.newContext({ deviceScaleFactor: DENSITY, ...(baseURL === undefined ? {} : { baseURL }) });
    const dense = await context.newPage();
    for (const { name, ...size } of STILLS) {
      await open(dense, size.width, size.height);
      writeFileSync(still(name), await packed(dense, size));
    }
    await context.close();
    return;
  }
  for (const [width, height] of [
    [1440, 900],
    [390, 844],
  ] as const) {
    await open(page, width, height);
    expect(await stage.difference(await look(page, '1'), await look(page, '0')), `at ${width} × ${height}`).toBeLessThan(ALIKE);
  }
});
