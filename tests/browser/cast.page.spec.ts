/** Tests of the choice of the storyteller, on the page that `npm start` serves. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, ready, test } from './stage.js';

const figures = join(import.meta.dirname, '../../assets/figures');

async function open(page: Page, hash = ''): Promise<void> {
  await page.goto(`/${hash}`);
  const player = page.locator('raconteur-player');
  await ready(player);
}

const current = (page: Page) => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.currentFigure);

test('a figure is chosen with the keyboard, and the address names it', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const papous = page.getByRole('button', { name: 'Papous' });
  await expect(page.getByRole('button', { name: 'Sofia' })).toHaveAttribute('aria-pressed', 'true');
  await papous.focus();
  await page.keyboard.press('Enter');
  await expect(papous).toHaveAttribute('aria-pressed', 'true', { timeout: 60_000 });
  await expect(page.getByRole('button', { name: 'Sofia' })).toHaveAttribute('aria-pressed', 'false');
  await expect(page).toHaveURL(/#white-rabbit\/papous$/);
  await open(page, '#hello-world/papous');
  await page.reload();
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('papous');
});

test('a poem comes with the figure whose voice it has, unless another is asked for', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, '#zwei-parallelen');
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('nuno');
  await page.getByRole('button', { name: /Lusíadas/ }).click();
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('sofia');
  await expect(page).toHaveURL(/#os-lusiadas$/);
  await page.getByRole('button', { name: 'Nuno' }).click();
  await expect(page).toHaveURL(/#os-lusiadas\/nuno$/);
  await page.reload();
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('nuno');
});

test('who was chosen tells the next story, too, and so does a file of the user', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByRole('button', { name: 'Papous' }).click();
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('papous');
  await page.getByRole('button', { name: /Die zwei Parallelen/ }).click();
  await expect(page).toHaveURL(/#zwei-parallelen\/papous$/);
  await ready(page.locator('raconteur-player'));
  expect(await current(page)).toBe('papous');
  await expect(page.getByRole('button', { name: 'Papous' })).toHaveAttribute('aria-pressed', 'true');
  // A figure chosen while a story loads also stays.
  await page.getByRole('button', { name: 'Amara' }).click();
  await page.getByRole('button', { name: /Hello world/ }).click();
  await expect(page).toHaveURL(/#hello-world\/amara$/);
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('amara');

  await page.getByLabel('Yours').setInputFiles({ name: 'mine.glb', mimeType: 'model/gltf-binary', buffer: readFileSync(join(figures, 'sofia.glb')) });
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('mine.glb');
  await expect(page).toHaveURL(/#hello-world$/);
  await page.getByRole('button', { name: /Lusíadas/ }).click();
  await expect.poll(() => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.label)).toBe('Os Lusíadas');
  await ready(page.locator('raconteur-player'));
  expect(await current(page)).toBe('mine.glb');
});

test('after a file that is no figure the story still chooses its own teller', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.getByLabel('Yours').setInputFiles({ name: 'broken.glb', mimeType: 'model/gltf-binary', buffer: Buffer.from('no figure at all') });
  await expect(page.locator('#cast-trouble')).toContainText('broken.glb', { timeout: 60_000 });
  await page.getByRole('button', { name: /Die zwei Parallelen/ }).click();
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('nuno');
});

test('a file of the user performs, and a broken one says what is wrong', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const own = page.getByLabel('Yours');
  await own.setInputFiles({ name: 'broken.glb', mimeType: 'model/gltf-binary', buffer: Buffer.from('no figure at all') });
  await expect(page.locator('#cast-trouble')).toContainText('broken.glb', { timeout: 60_000 });
  await expect(page.locator('#cast-trouble')).toContainText('stays on stage');
  expect(await current(page)).toBe('sofia');
  await expect(page.getByRole('button', { name: 'Sofia' })).toHaveAttribute('aria-pressed', 'true');

  await own.setInputFiles({ name: 'mine.glb', mimeType: 'model/gltf-binary', buffer: readFileSync(join(figures, 'sofia.glb')) });
  await expect.poll(() => current(page), { timeout: 60_000 }).toBe('mine.glb');
  await expect(page.getByRole('button', { name: 'Sofia' })).toHaveAttribute('aria-pressed', 'false');
  await expect(page.locator('#cast-trouble')).toBeEmpty();
});
