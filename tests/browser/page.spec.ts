/** The page that `npm start` shows. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS } from './access.js';
import { expect, ready, test } from './stage.js';

async function open(page: Page): Promise<void> {
  await page.goto('/');
  const player = page.locator('raconteur-player');
  await ready(player);
}

test('the stories are chosen by their cards, and their script can be read', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByRole('button', { name: /Hello world/ }).click();
  const player = page.locator('raconteur-player');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => (p.paused ? '' : p.label))).toBe('Hello world');
  await expect(page).toHaveURL(/#hello-world$/);
  await expect(page.getByRole('button', { name: /Hello world/ })).toHaveAttribute('aria-pressed', 'true');
  await page.getByText('Read the script').click();
  await expect(page.locator('#script')).toContainText('<eml');
});

test('a strict policy is sent, and nothing comes from elsewhere', async ({ stage, page, baseURL }) => {
  expect(stage.backend).toBe('page');
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  const response = await page.goto('/');
  const policy = response?.headers()['content-security-policy'] ?? '';
  expect(policy).toContain("script-src 'self' 'wasm-unsafe-eval'");
  expect(policy).not.toContain('unsafe-inline');
  await open(page);
  expect(asked.filter((url) => !url.startsWith(baseURL ?? '') && !url.startsWith('data:'))).toEqual([]);
});

test('accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page);
  for (const look of LOOKS) {
    await lookAt(page, look);
    await expectNoBarriers(page, look.device);
  }
});

test('people who ask for less motion are not played to', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void (p.autoplay = true));
  await open(page);
  expect(await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
});
