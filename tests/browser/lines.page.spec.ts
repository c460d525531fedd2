/** Tests of the story's lines below the stage of the home page: the spoken line is highlighted. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers } from './access.js';
import { bundle, expect, ready, test } from './stage.js';

const current = (page: Page) => page.locator('#lines [aria-current="true"]');
const player = (page: Page) => page.locator('raconteur-player');

async function open(page: Page, width: number, story = 'white-rabbit'): Promise<void> {
  await page.setViewportSize({ width, height: 900 });
  await page.goto(`/#${story}`);
  await ready(player(page));
}

const text = (page: Page): Promise<string> => page.locator('#lines ol button > span').evaluateAll((lines) => lines.map((line) => line.textContent).join(' '));
const told = (story: string): string[] => bundle(story).flatMap(({ words }) => words.map((word) => word.text));

test('the line that is spoken is lit, then the next', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page, 1440);
  await expect.poll(() => text(page)).toBe(told('white-rabbit').join(' '));
  await expect(current(page)).toHaveCount(0);
  await player(page).evaluate((p: RaconteurPlayer) => p.play());
  await expect(current(page)).toHaveCount(1);
  const first = await current(page).innerText();
  await expect(current(page).locator('.said')).toHaveCount(1);
  await expect.poll(() => current(page).innerText()).not.toBe(first);
  await expect(page.locator('#lines .past').first()).toBeVisible();
  expect(await page.evaluate(() => scrollY)).toBe(0);
  // The current and the past words are legible in the light and the dark theme.
  await player(page).evaluate((p: RaconteurPlayer) => p.pause());
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await expectNoBarriers(page, colorScheme);
  }
});

test('a line is sought by click and key, and the box alone scrolls', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page, 1440);
  const lines = page.locator('#lines button');
  await expect.poll(() => lines.count()).toBeGreaterThan(20);
  const [, , third] = bundle('white-rabbit');
  const line = lines
    .filter({
      hasText: third!.words
        .slice(0, 4)
        .map((word) => word.text)
        .join(' '),
    })
    .first();
  await line.focus();
  await page.keyboard.press('Enter');
  await expect(line).toHaveAttribute('aria-current', 'true');
  // The next spoken words are those of the line; the first begins exactly at the seek target.
  await player(page).evaluate((p: RaconteurPlayer) => p.play());
  const heard = (): Promise<string[]> =>
    page.evaluate(() => window.record.events.filter(({ type }) => type === 'word').map(({ detail }) => (detail as { word: { text: string } }).word.text));
  await expect.poll(async () => (await heard()).length).toBeGreaterThan(0);
  expect(third!.words.slice(0, 2).map((word) => word.text)).toContain((await heard())[0]);
  await player(page).evaluate((p: RaconteurPlayer) => p.pause());
  const scrolled = await page.evaluate(() => scrollY);
  await player(page).evaluate((p: RaconteurPlayer) => void (p.currentTime = p.duration - 4));
  await expect(current(page)).not.toHaveText(await line.innerText());
  const [lit, box] = [await current(page).boundingBox(), await page.locator('#lines').boundingBox()];
  expect(lit!.y).toBeGreaterThanOrEqual(box!.y);
  expect(lit!.y + lit!.height).toBeLessThanOrEqual(box!.y + box!.height);
  expect(await page.evaluate(() => scrollY)).toBe(scrolled);
});

test('what a story says twice is there twice, another one has its own lines and language, and one that says nothing says so', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 1440, 'step-lesson');
  // The script has more text than its bundle.
  await expect.poll(async () => (await text(page)).split(' ').length).toBeGreaterThan(told('step-lesson').length);
  await page.getByRole('button', { name: /Die zwei Parallelen/ }).click();
  await expect.poll(() => text(page)).toBe(told('virtual-poets/zwei-parallelen').join(' '));
  await expect(page.locator('#lines ol')).toHaveAttribute('lang', /^de/);
  await page.getByRole('button', { name: /Mathematical dance/ }).click();
  await expect(page.locator('#lines')).toHaveText('This story has no speech.');
});

test('the lines of a text of one’s own are lit as they are said', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 1440);
  await page.getByLabel('Say it: your own words').fill('Good morning. Who are you & I, <b>really</b>?');
  await page.keyboard.press('Enter');
  await expect.poll(() => text(page)).toBe('Good morning. Who are you I, <b>really</b>?');
  await expect(current(page)).toContainText('Who are you');
  await expect(page.locator('#lines b')).toHaveCount(0);
});

test('a narrower page does not show them', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 834);
  await player(page).evaluate((p: RaconteurPlayer) => p.play());
  await expect.poll(() => player(page).evaluate((p: RaconteurPlayer) => p.currentTime), { timeout: 60_000 }).toBeGreaterThan(2);
  await expect(page.locator('.lines')).toBeHidden();
  // A window that becomes wide has them.
  await page.setViewportSize({ width: 1440, height: 900 });
  await expect(current(page)).toHaveCount(1);
});
