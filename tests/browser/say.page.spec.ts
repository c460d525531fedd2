/** Text of one's own on the first page. */

import { readFileSync } from 'node:fs';
import { expect, test, type Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';

/** Records the phones that the player reports from now on. */
async function listen(page: Page): Promise<void> {
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => {
    p.dataset['phones'] = '';
    p.addEventListener('phone', (event) => {
      p.dataset['phones'] += ` ${(event as CustomEvent<{ symbol: string }>).detail.symbol}`;
    });
  });
}

const phones = (page: Page): Promise<string> => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.dataset['phones'] ?? '');

test('a visitor types a sentence and the figure says it, with the phones of its voice', async ({ page }) => {
  await page.goto('/');
  const player = page.locator('raconteur-player');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.readyState), { timeout: 60_000 }).toBe(4);
  await listen(page);
  await page.getByLabel('Say it: your own words').fill('Good morning. Who are you?');
  await page.keyboard.press('Enter');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
  const said = await phones(page);
  // flite's, of the radio set.
  expect(said).toMatch(/g uh d m ao r n ih ng/);
  await expect.poll(() => phones(page)).toMatch(/hh uw aa?r? ?.*y uw/);
  await expect(page.locator('#say-note')).toContainText('flite speaks');
  expect(page.url()).toContain('#say=Good%20morning');
  // The spoken text can be saved.
  const [kept] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Keep as a story' }).click()]);
  expect(kept.suggestedFilename()).toBe('my-story.zip');
  const packed = readFileSync(await kept.path());
  for (const name of ['my-story/story.eml', 'my-story/voice/speech.json', '.wav']) expect(packed.includes(name), name).toBe(true);
  // A second text starts immediately, and the first is not spoken again.
  await player.evaluate((p: RaconteurPlayer) => void (p.dataset['phones'] = ''));
  await page.getByLabel('Say it: your own words').fill('And now the cat.');
  await page.getByRole('button', { name: 'Say it' }).click();
  await expect.poll(() => phones(page), { timeout: 60_000 }).toMatch(/k ae t/);
  expect(await phones(page)).not.toMatch(/g uh d m ao/);
  // A story replaces the text.
  await page.getByRole('button', { name: /Hello world/ }).click();
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.label)).toBe('Hello world');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.duration), { timeout: 60_000 }).toBeLessThan(8);
});

test('other languages are spoken by espeak-ng, whose licence is said where it is chosen', async ({ page }) => {
  await page.goto('/');
  const player = page.locator('raconteur-player');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.readyState), { timeout: 60_000 }).toBe(4);
  await listen(page);
  for (const [language, text, phones_] of [
    ['de', 'Guten Morgen. Wie heißt du?', /g u: t @ n m O r g @ n .*v i: h aI s t d u:/],
    ['pt', 'Olá! Era uma vez um coelho.', /O l a .*E \* & u m & v e z u~ N k u e l\^ U/],
  ] as const) {
    await player.evaluate((p: RaconteurPlayer) => void (p.dataset['phones'] = ''));
    await page.getByLabel('Language of your words').selectOption(language);
    await page.getByLabel('Say it: your own words').fill(text);
    await page.keyboard.press('Enter');
    await expect.poll(() => phones(page), { timeout: 60_000 }).toMatch(phones_);
    await expect(page.locator('#say-note')).toContainText('espeak-ng speaks (GPL-3.0-or-later)');
    expect(page.url()).toContain(`#say.${language}=`);
  }
});

test('a shared text stands in the box and on the stage, and waits to be played', async ({ page }) => {
  await page.goto(`/#say=${encodeURIComponent('Hi! <b>Bold</b> & brave :)')}`);
  await expect(page.getByLabel('Say it: your own words')).toHaveValue('Hi! <b>Bold</b> & brave :)');
  const player = page.locator('raconteur-player');
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.label), { timeout: 60_000 }).toBe('Your own words');
  expect(await player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
});
