/** Tests of the composite editor: segment selection, hair and accessories, skin marks, figure files, and errors. */

import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import type { RaconteurComposite } from '../../web/composite/element.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { drawSimply, open, Visit } from './composite.js';
import { expect, test } from './stage.js';

const tab = (page: Page, name: string) => page.getByRole('tab', { name }).click();
const press = (page: Page, name: string) => page.getByRole('button', { name, exact: true }).first().click();
const present = (page: Page) => page.locator('.steps-list [aria-current="step"]');

/** Returns a position in the image, as shares of its width and height. */
async function at(page: Page, x: number, y: number): Promise<[number, number]> {
  const box = await page.locator('#pad').boundingBox();
  if (box === null) throw new Error('there is no picture');
  return [box.x + x * box.width, box.y + y * box.height];
}

/** Returns the image as a data URL: two are equal if nothing changed. */
const picture = (page: Page) => page.locator('#player').evaluate((p: RaconteurPlayer) => p.snapshot()?.toDataURL() ?? '');

/** Returns the current session with one more act. */
async function session(page: Page, act: unknown): Promise<Buffer> {
  const saved = await page.locator('raconteur-composite').evaluate((e) => (e as unknown as { save(): { steps: unknown[] } }).save());
  return Buffer.from(JSON.stringify({ ...saved, steps: [...saved.steps, { parent: 0, act }], here: saved.steps.length }));
}

async function put(page: Page, act: unknown): Promise<void> {
  await page.locator('.file input').setInputFiles({ name: 'it.json', mimeType: 'application/json', buffer: await session(page, act) });
}

test('hair, its colour and what is worn are steps, kept with the session', async ({ page }) => {
  await open(page);
  const bare = await picture(page);
  await tab(page, 'Style');
  await page.getByRole('region', { name: 'Hair', exact: true }).getByLabel('Style').selectOption('Short, combed forward');
  await press(page, 'red');
  await press(page, 'Round glasses');
  await press(page, 'Hat');
  // One cover at a time.
  await press(page, 'Headscarf');
  await expect(page.getByRole('button', { name: 'Hat', exact: true })).toHaveAttribute('aria-pressed', 'false');
  await expect(page.getByRole('button', { name: 'Round glasses' })).toHaveAttribute('aria-pressed', 'true');
  const dressed = await picture(page);
  expect(dressed).not.toBe(bare);
  await page.reload();
  await expect(page.locator('raconteur-composite[data-ready]')).toBeAttached({ timeout: 60_000 });
  await tab(page, 'Style');
  await expect(page.getByRole('button', { name: 'Headscarf' })).toHaveAttribute('aria-pressed', 'true');
  for (let i = 0; i < 5; i += 1) await press(page, 'Undo');
  await expect(page.getByRole('button', { name: 'Undo', exact: true })).toBeDisabled();
  await expect(page.getByRole('button', { name: 'Headscarf' })).toHaveAttribute('aria-pressed', 'false');
});

test('the figure file tells a story on another page', async ({ page }) => {
  await open(page);
  await tab(page, 'Style');
  await press(page, 'Round glasses');
  await tab(page, 'Marks');
  await press(page, 'Tattoo');
  await page.mouse.click(...(await at(page, 0.5, 0.3)));
  await expect(page.getByRole('region', { name: 'Tattoo 1' })).toBeVisible();
  await tab(page, 'Export');
  await page.getByLabel('Name of the figure').fill('Ida');
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: 60_000 }), page.getByRole('button', { name: 'Save figure' }).click()]);
  expect(download.suggestedFilename()).toBe('ida.glb');
  const buffer = readFileSync(await download.path());
  await page.goto('/');
  await page.locator('#own-figure').setInputFiles({ name: 'ida.glb', mimeType: 'model/gltf-binary', buffer });
  const player = page.locator('raconteur-player').first();
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentFigure), { timeout: 60_000 }).toBe('ida.glb');
  expect(await player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => /figure|avatar/.test(d.code)))).toEqual([]);
});

/** Tests that need only an editor. */
test.describe('in one visit', () => {
  test.describe.configure({ mode: 'serial' });
  let visit: Visit;
  let page: Page;
  test.beforeAll(async ({ browser }, { file }) => {
    visit = await Visit.begin(browser, file);
    page = visit.page;
  });
  test.afterAll(() => visit.end());
  test.beforeEach(() => visit.anew());

  test('a press on the face chooses a segment, and dragging moves it', async () => {
    await tab(page, 'Parts');
    const chosen = page.locator('.segments :checked');
    await page.mouse.click(...(await at(page, 0.5, 0.52)));
    await expect(chosen).toHaveCount(1);
    await expect(page.locator('.segments label:has(:checked)')).toContainText('nose');
    await page.keyboard.down('Shift');
    await page.mouse.click(...(await at(page, 0.5, 0.75)));
    await page.keyboard.up('Shift');
    await expect(chosen).toHaveCount(2);
    await page.getByText('moves', { exact: true }).click();
    const [x, y] = await at(page, 0.5, 0.5);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x, y - 30, { steps: 4 });
    await page.mouse.up();
    await tab(page, 'History');
    await expect(present(page)).toContainText('moved, nose');
    await expect(page.getByRole('list', { name: 'Steps' }).getByRole('listitem')).toHaveCount(2);
    // A click next to the head chooses nothing.
    await tab(page, 'Parts');
    await page.getByText('turns the head', { exact: true }).click();
    await page.mouse.click(...(await at(page, 0.03, 0.1)));
    await expect(chosen).toHaveCount(0);
  });

  test('a beard is chosen, cut and taken off', async () => {
    await tab(page, 'Style');
    const style = page.getByRole('region', { name: 'Beard' }).getByLabel('Style');
    const bare = await picture(page);
    for (const [cut, differs] of [
      ['Full, long', true],
      ['Moustache', true],
      ['None', false],
      ['Goatee', true],
      ['Stubble', true],
      ['As it is', false],
    ] as const) {
      await style.selectOption(cut);
      if (differs) await expect.poll(() => picture(page)).not.toBe(bare);
      else await expect.poll(() => picture(page)).toBe(bare);
      await expect(page.locator('#trouble')).toHaveText('');
    }
  });

  test('marks are placed by a press and by the keyboard, made longer and taken away', async () => {
    await tab(page, 'Marks');
    const bare = await picture(page);
    await press(page, 'Scar');
    await page.mouse.click(...(await at(page, 0.03, 0.1)));
    await expect(page.locator('#trouble')).toContainText('outside the head');
    await page.mouse.click(...(await at(page, 0.57, 0.6)));
    const scar = page.getByRole('region', { name: 'Scar 1' });
    await expect(scar).toBeVisible();
    await expect.poll(() => picture(page)).not.toBe(bare);
    await scar.getByLabel('Length, Scar 1, exactly').fill('60');
    await scar.getByLabel('Length, Scar 1, exactly').blur();
    await press(page, 'Mole');
    await page.locator('#pad').focus();
    await page.keyboard.press('Enter');
    await expect(page.getByRole('region', { name: 'Mole 2' })).toBeVisible();
    const marked = await picture(page);
    await press(page, 'Remove scar 1');
    await press(page, 'Remove mole 1');
    await expect.poll(() => picture(page)).not.toBe(marked);
    await expect(page.getByRole('region', { name: 'Mole 1' })).toBeHidden();
    await press(page, 'Undo');
    await expect(page.getByRole('region', { name: 'Mole 1' })).toBeVisible();
  });

  test('every feature can be changed alone', async () => {
    const told = await page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite) => {
      const { faces } = e;
      const start = e.save();
      if (faces === undefined || start === undefined) throw new Error('it is not open');
      const acts = faces.pack.attributes.map(({ part, name }) => ({ kind: 'add', part, name, amount: 0.1, region: {}, alone: true }));
      await e.open({ ...start, steps: [...start.steps, ...acts.map((act, i) => ({ parent: i, act }))], here: acts.length });
      e.undo();
      const last = faces.pack.attributes.at(-1);
      const before = last === undefined ? 0 : faces.value(last.part, last.name);
      e.redo();
      return [acts.length, last === undefined ? 0 : faces.value(last.part, last.name) - before];
    });
    expect(told[0]).toBeGreaterThan(49);
    expect(told[1]).toBeCloseTo(0.1, 6);
  });

  test('what cannot be is told, and nothing is lost', async () => {
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    await tab(page, 'Features');
    await page.getByLabel('weight, exactly').fill('0.5');
    await page.getByLabel('weight, exactly').blur();
    const trouble = page.locator('#trouble');
    const held = [0, 1].map((value) => ({ part: 'shape', name: 'weight', value, segments: [] }));
    const faults: [unknown, RegExp][] = [
      [{ kind: 'hold', held }, /weight/],
      [{ kind: 'look', what: 'x', look: { hair: { from: 'https://example.com/x.glb' } } }, /Step 2: its hair or an accessory is unknown/],
      [{ kind: 'marks', what: 'x', marks: [{ kind: 'scar', size: 1e9 }] }, /Step 2: a mark is unknown/],
      [{ kind: 'import', index: 10 ** 9, part: 'both', region: {} }, /could not be opened/],
    ];
    for (const [act, told] of faults) {
      await put(page, act);
      await expect(trouble).toContainText(told);
      await expect(trouble).toContainText('Your work is unchanged');
      await expect(page.getByLabel('weight, exactly')).toHaveValue('0.5');
    }
    expect(asked.filter((url) => url.includes('example.com'))).toEqual([]);
  });

  test('light comes from elsewhere', async () => {
    const before = await picture(page);
    await page.getByRole('combobox', { name: 'Light' }).selectOption('Lamp');
    await expect.poll(() => picture(page)).not.toBe(before);
    const lamp = await picture(page);
    await page.getByRole('button', { name: 'Light more from the right' }).click();
    await expect.poll(() => picture(page)).not.toBe(lamp);
  });

  test('style and marks are accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async () => {
    await tab(page, 'Style');
    await press(page, 'Round glasses');
    await press(page, 'blond');
    await tab(page, 'Marks');
    await press(page, 'Tattoo');
    await page.locator('#pad').focus();
    await page.keyboard.press('Enter');
    await expect(page.getByRole('region', { name: 'Tattoo 1' })).toBeVisible();
    for (const look of LOOKS) {
      await lookAt(page, look);
      for (const name of partsIn(look, ['Style', 'Marks'])) {
        await tab(page, name);
        await expectNoBarriers(page, `${name}, ${look.device}`);
      }
    }
  });

  test('a face that rests is drawn with everything', async () => {
    const fine = page.locator('#fine');
    await expect(fine).toBeHidden();
    await page.locator('raconteur-composite').evaluate((e) => e.setAttribute('quality', 'auto'));
    await press(page, 'weight: more');
    await expect(fine).toBeVisible({ timeout: 60_000 });
    // It is hidden for only a second or two, and a busy page may be queried too late.
    const seen = await fine.evaluateHandle((canvas: HTMLElement) => {
      const seen = { hidden: false };
      new MutationObserver(() => {
        seen.hidden ||= canvas.hidden !== false;
      }).observe(canvas, { attributeFilter: ['hidden'] });
      return seen;
    });
    await press(page, 'weight: more');
    await expect.poll(() => seen.evaluate(({ hidden }) => hidden)).toBe(true);
    await drawSimply(page);
  });

  test('a browser whose storage is full says so, and goes on', async () => {
    await page.evaluate(() => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException('no room', 'QuotaExceededError');
      };
    });
    await page.getByLabel('weight, exactly').fill('0.5');
    await page.getByLabel('weight, exactly').blur();
    await expect(page.locator('#trouble')).toContainText('its storage is full. Save it as a file');
    await page.getByLabel('weight, exactly').fill('0.7');
    await page.getByLabel('weight, exactly').blur();
    await tab(page, 'History');
    await expect(page.getByRole('list', { name: 'Steps' }).getByRole('listitem')).toHaveCount(3);
  });
});
