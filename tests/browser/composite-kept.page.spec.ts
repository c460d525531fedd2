/** Tests of the browser storage of the composite editor: each step is saved before the next, whatever happens to the tab. */

import type { BrowserContext, Page } from '@playwright/test';
import type { SavedHistory } from '../../web/composite/history.js';
import type { RaconteurComposite } from '../../web/composite/element.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { random } from '../../web/test/course-questions.js';
import { sized } from '../../web/test/tier.js';
import { expectNoBarriers } from './access.js';
import { drawSimply, open } from './composite.js';
import { expect, test } from './stage.js';

const KILLS = sized(3, 200);

const editor = (page: Page) => page.locator('raconteur-composite');
const saved = (page: Page) => editor(page).evaluate((e: RaconteurComposite) => e.save()) as Promise<SavedHistory>;
const ready = (page: Page) => editor(page).evaluate((e: RaconteurComposite) => e.ready);

/** Opens a page of the editor's origin without the editor. */
async function beside(context: BrowserContext): Promise<Page> {
  const page = await context.newPage();
  await page.route('**/nothing', (route) => route.fulfill({ contentType: 'text/html', body: '<title>Nothing</title>' }));
  await page.goto('/nothing');
  return page;
}

async function listed(page: Page): Promise<string[]> {
  await page.getByRole('tab', { name: 'History' }).click();
  await page.getByText('Stored sessions', { exact: true }).click();
  const list = page.getByRole('list', { name: 'Stored sessions' }).getByRole('listitem');
  await expect(list.first()).toBeVisible();
  return await list.locator('small').allTextContents();
}

test('a reload at once after a press loses nothing, nor body, light and view', async ({ page }) => {
  await open(page);
  await page.getByRole('button', { name: 'Papous' }).click();
  await page.getByRole('combobox', { name: 'Light' }).selectOption('Lamp');
  await page.getByRole('button', { name: 'Right', exact: true }).click();
  await expect.poll(() => page.locator('#player').evaluate((p: RaconteurPlayer) => p.currentFigure)).toBe('papous');
  // The key press and the reload happen in one turn of the page, so no pending work completes.
  await editor(page).evaluate((e: RaconteurComposite) => {
    const more = [...(e.shadowRoot?.querySelectorAll('button') ?? [])].find((b) => b.getAttribute('aria-label') === 'weight: more');
    more?.click();
    more?.click();
    location.reload();
  });
  await page.waitForEvent('load');
  await ready(page);
  const { steps, here, scene } = await saved(page);
  expect([steps.length, here]).toEqual([3, 2]);
  expect(scene?.figure).toBe('papous');
  expect(scene?.light?.name).toBe('evening');
  expect(scene?.view?.turn).toBeCloseTo(-Math.PI / 2);
  expect(await page.locator('#player').evaluate((p: RaconteurPlayer) => p.currentFigure)).toBe('papous');
});

/** Presses buttons in quick succession for a time, and reports each step once the editor has reported its completion. */
function hurry(e: RaconteurComposite, pauses: readonly number[]): void {
  e.addEventListener('change', () => {
    const { steps, here } = e.save() ?? { steps: [], here: 0 };
    (window as unknown as { told(count: number, here: number): void }).told(steps.length, here);
  });
  const buttons = [...(e.shadowRoot?.querySelectorAll<HTMLButtonElement>('.feature .steps button, [part="tools"] button') ?? [])];
  const able = buttons.filter((b) => /: (more|less)$|^Hold /.test(b.getAttribute('aria-label') ?? '') || /^(Undo|Redo)$/.test(b.textContent.trim()));
  let at = 0;
  const next = (): void => {
    const pause = pauses[at % pauses.length] ?? 10;
    able[(at * 7 + pause) % able.length]?.click();
    at += 1;
    setTimeout(next, pause);
  };
  next();
}

test(`${KILLS} tabs that are killed have lost no step that was acknowledged`, async ({ browser, baseURL }) => {
  test.setTimeout(sized(240_000, 3_600_000));
  const context = await browser.newContext({ ...(baseURL === undefined ? {} : { baseURL }) });
  let told = { count: 1, here: 0 };
  await context.exposeFunction('told', (count: number, here: number) => {
    told = { count, here };
  });
  const next = random(59);
  let all = 0;
  for (let kill = 0; kill < KILLS; kill += 1) {
    const page = await context.newPage();
    await open(page);
    // Each kill uses its own session, because restoring a long session takes long.
    await editor(page).evaluate(async (e: RaconteurComposite) => {
      const start = e.save();
      await e.open({ ...start, steps: start?.steps.slice(0, 1), here: 0 });
    });
    await page.getByRole('tab', { name: 'Features' }).click();
    told = { count: 1, here: 0 };
    await editor(page).evaluate(
      hurry,
      Array.from({ length: 20 }, () => Math.floor(next() * 60)),
    );
    await expect.poll(() => told.count, { intervals: [5] }).toBeGreaterThan(1);
    await page.waitForTimeout(next() * 500);
    const devtools = await context.newCDPSession(page);
    await Promise.race([devtools.send('Page.crash').catch(() => undefined), page.waitForEvent('crash')]);
    await page.close();
    const again = await context.newPage();
    await again.goto('/composite/');
    await drawSimply(again);
    await ready(again);
    const { steps, here } = await saved(again);
    all += steps.length - 1;
    // Steps after the last reported one may be stored, too.
    expect(steps.length, `kill ${kill}`).toBeGreaterThanOrEqual(told.count);
    if (steps.length === told.count) expect(here, `kill ${kill}`).toBe(told.here);
    await again.close();
  }
  expect(all).toBeGreaterThan(2 * KILLS);
  await context.close();
});

test('two tabs have each its work, and both are found, opened and deleted', async ({ page, context }) => {
  await open(page);
  await page.getByRole('button', { name: 'weight: more' }).click();
  const other = await context.newPage();
  await open(other);
  await expect(other.locator('#trouble')).toContainText('a copy');
  await other.getByRole('button', { name: 'sex, shape: less' }).click();
  await other.getByRole('button', { name: 'sex, shape: less' }).click();
  await page.getByRole('button', { name: 'weight: more' }).click();
  // Each tab continues with its own session after a reload.
  for (const [tab, count] of [
    [page, 3],
    [other, 4],
  ] as const) {
    await tab.reload();
    await ready(tab);
    expect((await saved(tab)).steps).toHaveLength(count);
  }
  expect((await listed(page)).map((text) => /\d+ steps?.*$/.exec(text)?.[0])).toEqual(expect.arrayContaining(['2 steps, open here', '3 steps, open in another tab']));
  await expectNoBarriers(page, 'kept sessions');
  await other.close();
  // The browser releases the locks of a closed tab after a moment; the list is read when it opens.
  const reopen = page.getByRole('button', { name: /^Open: / });
  await expect(async () => {
    await page.getByText('Stored sessions', { exact: true }).click();
    await page.getByText('Stored sessions', { exact: true }).click();
    await expect(reopen).toBeVisible({ timeout: 2000 });
  }).toPass();
  await reopen.click();
  await expect.poll(async () => (await saved(page)).steps.length).toBe(4);
  await page.getByRole('button', { name: /^Delete: / }).click();
  await page.getByRole('button', { name: /^Delete permanently: / }).click();
  await expect(page.getByRole('list', { name: 'Stored sessions' }).getByRole('listitem')).toHaveCount(1);
  // Another session leaves this one as it is.
  await page.getByRole('button', { name: 'New session' }).click();
  expect((await saved(page)).steps).toHaveLength(1);
  await page.reload();
  await ready(page);
  expect((await saved(page)).steps).toHaveLength(4);
});

test('sessions of the old form are opened from the browser and from a file', async ({ page, context }) => {
  await open(page);
  const { pack } = await saved(page);
  const old = {
    format: 'raconteur-composite',
    version: 1,
    pack,
    steps: [
      { parent: -1, act: { kind: 'average' } },
      { parent: 0, act: { kind: 'random', seed: 5 }, name: 'Whom I saw' },
    ],
    here: 1,
  };
  await page.locator('.file input').setInputFiles({ name: 'old.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(old)) });
  await expect(page.locator('.steps-list [aria-current="step"]').first()).toContainText('Whom I saw');
  await page.close();
  const seeded = await beside(context);
  await seeded.evaluate(
    async (kept) =>
      await new Promise<void>((done, failed) => {
        indexedDB.deleteDatabase('raconteur-composite');
        const opening = indexedDB.open('raconteur-composite');
        opening.onupgradeneeded = () => opening.result.createObjectStore('sessions');
        opening.onsuccess = () => {
          const change = opening.result.transaction('sessions', 'readwrite');
          change.objectStore('sessions').put({ at: 1, saved: kept }, ['page', 'an-old-one']);
          change.oncomplete = () => {
            opening.result.close();
            done();
          };
          change.onerror = () => failed(new Error('it was not put'));
        };
      }),
    old,
  );
  await open(seeded);
  expect((await saved(seeded)).steps).toEqual(old.steps);
  expect(await listed(seeded)).toEqual([expect.stringContaining('1 step, open here')]);
});
