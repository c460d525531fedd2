/** Tests of the exports of a composite: thumbnails of its steps, a printable image, a film, a report. */

import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { isLong } from '../../web/test/tier.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { open, Visit } from './composite.js';
import { expect, test } from './stage.js';

/** Software draws slowly. */
const DRAWN_MS = 100_000;

const tab = (page: Page, name: string) => page.getByRole('tab', { name }).click();

async function set(page: Page, name: string, to: string): Promise<void> {
  const value = page.getByLabel(`${name}, exactly`);
  await value.fill(to);
  await value.blur();
}

/** Clicks a button and returns the file that it saves. */
async function saved(page: Page, button: string, within = DRAWN_MS): Promise<{ name: string; bytes: Buffer }> {
  const [file] = await Promise.all([page.waitForEvent('download', { timeout: within }), page.getByRole('button', { name: button }).click()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

// Ninety-six portraits take minutes in software.
if (isLong) {
  test('the film is a video where the browser has an encoder', async ({ page }) => {
    test.slow();
    await open(page, 1024, 700);
    await tab(page, 'Export');
    const { name, bytes } = await saved(page, 'Save film', 3 * DRAWN_MS);
    if (name === 'face.webm') expect(bytes.readUInt32BE(0)).toBe(0x1a45dfa3);
    else expect([name, bytes.subarray(4, 8).toString()]).toEqual(['face.mp4', 'ftyp']);
    expect(bytes.length).toBeGreaterThan(50_000);
  });
}

/** Tests that need only an editor. */
test.describe('in one visit', () => {
  test.describe.configure({ mode: 'serial' });
  let visit: Visit;
  let page: Page;
  test.beforeAll(async ({ browser }, { file }) => {
    visit = await Visit.begin(browser, file, 1024, 700);
    page = visit.page;
  });
  test.afterAll(() => visit.end());
  test.beforeEach(() => visit.anew());

  test('steps have small pictures, and branches say where they come from', async () => {
    await set(page, 'weight', '0.5');
    await tab(page, 'History');
    const steps = page.getByRole('list', { name: 'Steps' }).getByRole('listitem');
    const pictures = steps.locator('img');
    await expect(pictures.last()).toHaveAttribute('src', /^data:image\/(webp|png);/);
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await tab(page, 'Features');
    await set(page, 'weight', '-0.5');
    await tab(page, 'History');
    await expect(steps.nth(2)).toContainText('from the beginning');
    await expect(steps.nth(2).locator('img')).toBeAttached();
    await expect(steps.nth(1)).toHaveClass('aside');
  });

  test('a picture for paper has the size that it says', async () => {
    await tab(page, 'Export');
    await page.getByText('Profile', { exact: true }).click();
    const { name, bytes } = await saved(page, 'Save picture');
    expect(name).toBe('face-profile.png');
    expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual([1181, 1476]);
    expect(bytes.subarray(37, 41).toString()).toBe('pHYs');
    await expect(page.locator('#status')).toHaveText('face-profile.png is saved.');
  });

  test('pictures are framed as asked, from where the stage shows the face and from all sides, before a plain wall', async () => {
    const corner = (bytes: Buffer) =>
      page.evaluate(async (text) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))]));
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context?.drawImage(image, 0, 0);
        return [...(context?.getImageData(20, 20, 1, 1).data ?? [])].slice(0, 3);
      }, bytes.toString('base64'));
    await tab(page, 'Export');
    await page.getByRole('radio', { name: 'As on the stage' }).first().check({ force: true });
    const stage = await saved(page, 'Save picture');
    expect(stage.name).toBe('face-view.png');
    await page.getByText('Head and shoulders', { exact: true }).click();
    await page.getByText('A plain wall, in even light', { exact: true }).click();
    const plain = await saved(page, 'Save picture');
    expect(await corner(plain.bytes)).toEqual([205, 205, 205]);
    expect(await corner(stage.bytes)).not.toEqual([205, 205, 205]);
    expect(plain.bytes.equals(stage.bytes)).toBe(false);
    await page.getByText('All three', { exact: true }).click();
    const names: string[] = [];
    page.on('download', (file) => names.push(file.suggestedFilename()));
    await page.getByRole('button', { name: 'Save picture' }).click();
    await expect.poll(() => names.sort().join(' '), { timeout: DRAWN_MS }).toBe('face-front.png face-profile.png face-quarter.png');
    page.removeAllListeners('download');
    await page.locator('.choice').getByText('Front', { exact: true }).click();
    await page.getByText('Head', { exact: true }).click();
    await page.getByRole('radio', { name: 'As on the stage' }).last().check({ force: true });
  });

  test('a report has all values, and what somebody typed is text in it', async ({ context }) => {
    await set(page, 'weight', '0.5');
    await tab(page, 'History');
    await page.getByLabel('Name this face').fill('<img src=x> & </title>');
    await page.getByRole('button', { name: 'Name', exact: true }).click();
    await tab(page, 'Export');
    const { name, bytes } = await saved(page, 'Save report');
    expect(name).toBe('img-src-x-title.html');
    const text = bytes.toString();
    expect(text).toContain('&lt;img src=x&gt; &amp; &lt;/title&gt;');
    expect(text).not.toMatch(/<img src="?x|<script|<!--/);
    const reader = await context.newPage();
    const asked: string[] = [];
    reader.on('request', ({ url }) => {
      if (!url().startsWith('data:')) asked.push(url());
    });
    await reader.setContent(text);
    await expect(reader.locator('h1')).toHaveText('<img src=x> & </title>');
    await expect(reader.locator('tr', { hasText: 'weight' }).first()).toContainText('+0.50');
    await expect(reader.locator('dl div', { hasText: 'Hair' }).first()).toContainText('As it is');
    expect(text).not.toMatch(/\d percent none/);
    await expect(reader.locator('img')).toHaveCount(3);
    await expect(reader.locator('.steps li')).toHaveCount(2);
    await expectNoBarriers(reader, 'the report');
    expect(asked).toEqual([]);
  });

  test('pictures are accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async () => {
    await set(page, 'weight', '0.5');
    for (const look of LOOKS) {
      await lookAt(page, look);
      for (const name of partsIn(look, ['History', 'Export'])) {
        await tab(page, name);
        await expectNoBarriers(page, `${name}, ${look.device}`);
      }
    }
  });

  test('on paper there is the report alone, and the screen stays as it is', async () => {
    await page.evaluate(() => {
      window.print = () => document.documentElement.setAttribute('data-printed', '');
    });
    await tab(page, 'Export');
    await page.getByRole('button', { name: 'Print report' }).click();
    await expect(page.locator('html[data-printed]')).toBeAttached({ timeout: DRAWN_MS });
    const report = page.locator('body > .report');
    await expect(report).toBeHidden();
    await page.emulateMedia({ media: 'print' });
    await expect(report.locator('h1')).toHaveText('Face without a name');
    await expect(page.locator('raconteur-composite')).toBeHidden();
    await page.emulateMedia({ media: 'screen' });
    await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    await expect(report).not.toBeAttached();
    await expect(page.locator('raconteur-composite')).toBeVisible();
  });

  test('a browser without an encoder saves the film as a GIF, and a film can be cancelled', async () => {
    await page.evaluate(() => Reflect.deleteProperty(globalThis, 'VideoEncoder'));
    await tab(page, 'Export');
    await page.getByRole('button', { name: 'Save film' }).click();
    await expect(page.getByRole('progressbar', { name: 'Film' })).toBeVisible();
    await expect(page.getByRole('button', { name: 'Save picture' })).toBeDisabled();
    await page.getByRole('button', { name: 'Cancel' }).click();
    await expect(page.locator('#status')).toHaveText('Film: cancelled.');
    await expect(page.getByRole('progressbar', { name: 'Film' })).not.toBeAttached();
    // The player that rendered the portraits is removed.
    await expect(page.getByLabel('Pictures of the face')).toHaveCount(0);
    const { name, bytes } = await saved(page, 'Save film');
    expect(name).toBe('face.gif');
    expect(bytes.subarray(0, 6).toString()).toBe('GIF89a');
    expect(bytes.length).toBeGreaterThan(50_000);
  });
});
