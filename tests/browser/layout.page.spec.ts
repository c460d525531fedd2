/** Tests of the page layout at desktop, tablet and phone widths, and of the availability of all requested files. */

import type { Page } from '@playwright/test';
import { expectNoBarriers } from './access.js';
import { expect, ready, test } from './stage.js';

/** Pages with a player, and documents. */
const STAGES = ['', 'viewer/', 'gestures/', 'transcribe/', 'face/', 'expression/', 'composite/'];
const DOCUMENTS = ['docs/', 'docs/readme.html', 'docs/eml.html', 'docs/voices.html', 'docs/library-music.html'];

async function open(page: Page, path: string): Promise<void> {
  await page.goto(`/${path}`);
  if (STAGES.includes(path)) await ready(page.locator('raconteur-player'));
}

test('who tells a story is chosen without scrolling on a desktop and on a tablet', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, '');
  for (const { width, height } of [
    { width: 1440, height: 900 },
    { width: 1024, height: 768 },
  ]) {
    await page.setViewportSize({ width, height });
    const box = await page.locator('.cast').boundingBox();
    expect(box!.y + box!.height, `${width}`).toBeLessThanOrEqual(height);
    const stageBox = await page.locator('raconteur-player').boundingBox();
    // It is directly below the stage, without a gap.
    expect(box!.y - (stageBox!.y + stageBox!.height), `${width}`).toBeLessThan(80);
  }
});

for (const path of [...STAGES, ...DOCUMENTS]) {
  test(`on a phone the sections of /${path} are one line, and nothing scrolls sideways`, async ({ stage, page }) => {
    expect(stage.backend).toBe('page');
    await page.setViewportSize({ width: 390, height: 844 });
    // The layout is there without anybody on stage.
    await page.route(/\.(wasm|glb)$/, (route) => route.abort());
    await page.goto(`/${path}`);
    const links = page.getByRole('navigation', { name: 'Sections' }).getByRole('link');
    const tops = await links.evaluateAll((all) => all.filter((a) => a.getClientRects().length > 0).map((a) => Math.round(a.getBoundingClientRect().top)));
    expect(tops.length).toBeGreaterThan(3);
    expect(new Set(tops).size).toBe(1);
    const brand = await page.locator('.brand').boundingBox();
    expect(Math.abs(brand!.y + brand!.height / 2 - tops[0]!)).toBeLessThan(40);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  });
}

for (const path of DOCUMENTS) {
  test(`/${path} has no barriers`, async ({ stage, page }) => {
    expect(stage.backend).toBe('page');
    await open(page, path);
    await expectNoBarriers(page);
  });
}

test('every page and every story finds all that it asks for', async ({ stage, page }) => {
  test.setTimeout(300_000);
  expect(stage.backend).toBe('page');
  const missing: string[] = [];
  page.on('response', (response) => {
    if (response.status() >= 400) missing.push(`${response.status()} ${response.url()}`);
  });
  for (const path of [...STAGES, ...DOCUMENTS, '#mathematical-dance', '#step-lesson']) {
    // A URL that differs only in its fragment would not reload the page.
    await page.goto('about:blank');
    await page.goto(`/${path}`);
    await page.waitForLoadState('networkidle');
  }
  expect(missing).toEqual([]);
  expect((await page.request.get('/favicon.ico')).status()).toBe(200);
  // A URL without its trailing slash redirects to the page.
  for (const folder of [...STAGES.filter((path) => path !== ''), 'docs/']) {
    const response = await page.request.get(`/${folder.slice(0, -1)}`);
    expect([response.status(), new URL(response.url()).pathname]).toEqual([200, `/${folder}`]);
  }
});

test('handles of the timeline are large enough for a finger', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, 'gestures/');
  const handles = page.locator('#timeline :is(.edge, .key, input)');
  await expect(handles.first()).toBeVisible();
  const sizes = await handles.evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).map(({ width, height }) => Math.min(width, height)));
  expect(sizes.length).toBeGreaterThan(4);
  expect(Math.min(...sizes)).toBeGreaterThanOrEqual(24);
});

test('the tabs of the face are whole on a phone', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.setViewportSize({ width: 390, height: 844 });
  await page.route(/\.(wasm|glb)$/, (route) => route.abort());
  await page.goto('/face/');
  await expect(page.getByRole('tab').first()).toBeVisible();
  const tabs = await page.getByRole('tab').evaluateAll((all) => all.map((e) => ({ right: e.getBoundingClientRect().right, cut: e.scrollWidth > e.clientWidth })));
  expect(tabs.length).toBeGreaterThan(3);
  for (const { right, cut } of tabs) {
    expect(right).toBeLessThanOrEqual(390);
    expect(cut).toBe(false);
  }
});
