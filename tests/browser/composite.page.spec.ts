/** The composite editor: features, parts, faces of the database, what is held, history, session, speech. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, LOOKS } from './access.js';
import { expect, test } from './stage.js';

async function open(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.goto('/composite/');
  await ready(page);
}

async function ready(page: Page): Promise<void> {
  await expect(page.locator('#bench[data-ready]')).toBeAttached({ timeout: 30_000 });
}

const value = (page: Page, name: string) => page.getByLabel(`${name}, exactly`);

/** Sets a feature by its number. */
async function set(page: Page, name: string, to: string): Promise<void> {
  await value(page, name).fill(to);
  await value(page, name).blur();
}

async function group(page: Page, name: string): Promise<void> {
  await page.getByLabel('Group').selectOption(name);
}

test('features change, are held, undone and found by a word', async ({ page }) => {
  await open(page);
  await group(page, 'nose');
  await set(page, 'breadth of the alar wings', '0.8');
  await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
  await page.getByRole('button', { name: 'Hold breadth of the alar wings' }).click();
  await set(page, 'length of the nose', '0.1');
  await page.getByRole('button', { name: 'length of the nose: more' }).click();
  await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
  await expect(value(page, 'length of the nose')).toHaveValue('0.2');
  await page.getByRole('tab', { name: 'Held' }).click();
  await expect(page.getByRole('button', { name: 'Let go of breadth of the alar wings' })).toBeVisible();
  await page.getByRole('tab', { name: 'Features' }).click();
  for (let i = 0; i < 4; i += 1) await page.getByRole('button', { name: 'Undo', exact: true }).click();
  await expect(value(page, 'breadth of the alar wings')).toHaveValue('0');
  await expect(page.getByRole('button', { name: 'Undo', exact: true })).toBeDisabled();
  await page.keyboard.press('Control+Shift+Z');
  await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
  await page.getByLabel('Search').fill('freckl');
  await expect(value(page, 'freckles')).toBeVisible();
});

test('a description chooses faces, and parts of them are taken over', async ({ page }) => {
  await open(page);
  await page.getByRole('tab', { name: 'Parts' }).click();
  await page.getByRole('checkbox', { name: 'nose', exact: true }).check();
  await page.getByRole('tab', { name: 'Faces' }).click();
  await page.getByText('A woman', { exact: true }).click();
  await page.getByText('56 and older', { exact: true }).click();
  const faces = page.locator('.sheet button');
  await expect(faces.first()).toContainText(/^\s*Woman of (5[6-9]|[67]\d|80)/);
  // Choosing changes nothing by itself.
  await expect(page.getByRole('button', { name: 'Undo', exact: true })).toBeDisabled();
  await expect(page.locator('.sheet img').first()).toBeVisible({ timeout: 30_000 });
  await faces.nth(1).click();
  await page.getByRole('tab', { name: 'History' }).click();
  await expect(page.locator('.steps-list [aria-current="step"]')).toContainText('nose');
});

test('what the browser kept is there again, and a hostile file loses nothing', async ({ page }) => {
  await open(page);
  await set(page, 'weight', '0.5');
  await page.getByRole('tab', { name: 'History' }).click();
  const present = page.locator('.steps-list [aria-current="step"]');
  await expect(present).toContainText('weight');
  await page.waitForTimeout(800);
  await page.reload();
  await ready(page);
  await expect(value(page, 'weight')).toHaveValue('0.5');
  await page.locator('.file input').setInputFiles({ name: 'bad.json', mimeType: 'application/json', buffer: Buffer.from('{"format":"raconteur-composite","version":9}') });
  await expect(page.locator('#trouble')).toContainText('newer version');
  await expect(value(page, 'weight')).toHaveValue('0.5');
});

test('the face says a sentence, and nothing leaves the machine', async ({ page, baseURL }) => {
  const elsewhere: string[] = [];
  page.on('request', (request) => {
    const { origin, protocol } = new URL(request.url());
    if (protocol.startsWith('http') && origin !== new URL(baseURL ?? '').origin) elsewhere.push(request.url());
    if (request.method() !== 'GET') elsewhere.push(`${request.method()} ${request.url()}`);
  });
  await open(page);
  await set(page, 'weight', '0.5');
  await page.getByLabel('Let this face speak').fill('Hello world');
  await page.getByRole('button', { name: 'Speak' }).click();
  const time = () => page.locator('#player').evaluate((p: RaconteurPlayer) => p.currentTime);
  await expect.poll(time, { timeout: 30_000 }).toBeLessThan(1.9);
  await page.getByRole('button', { name: 'Stop' }).click();
  await expect.poll(time).toBe(2);
  await expect(value(page, 'weight')).toHaveValue('0.5');
  expect(elsewhere).toEqual([]);
});

for (const { colorScheme, device, width, height } of LOOKS) {
  test(`the editor is accessible in ${colorScheme} on a ${device}, without a sideways scroll`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    await open(page);
    await page.setViewportSize({ width, height });
    for (const tab of ['Features', 'Parts', 'Held', 'History', 'Faces']) {
      await page.getByRole('tab', { name: tab }).click();
      await expectNoBarriers(page, tab);
    }
  });
}
