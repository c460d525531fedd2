/** The page *Transcribe*: files, tracks, edges, the figure in step, and what is saved. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Locator, Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { expect, poseOf, ready, test } from './stage.js';

const SMALL = readFileSync(join(import.meta.dirname, '../../crate/annotate/tests/formats/files/small.anvil'));

const cells = (page: Page): Locator => page.getByRole('gridcell');
const cell = (page: Page, name: RegExp): Locator => page.getByRole('gridcell', { name });
const names = (page: Page): Promise<string[]> => cells(page).evaluateAll((all) => all.map((e) => e.getAttribute('aria-label') ?? ''));

async function open(page: Page): Promise<void> {
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.goto('/transcribe/');
  await ready(page.locator('raconteur-player'));
}

async function openExample(page: Page): Promise<void> {
  await open(page);
  await page.getByRole('button', { name: 'Try an example' }).click();
  await expect(cell(page, /^Words: grandfather, 0\.66 to 1\.22 s$/)).toBeVisible();
  await expect(page.locator('#counts')).toContainText('32 words, 5 utterances, 5 gestures');
}

async function openFile(page: Page, name: string, buffer: Buffer): Promise<void> {
  await page.locator('input[type=file]').first().setInputFiles({ name, mimeType: 'application/octet-stream', buffer });
}

/** Returns the target of the right hand, world, metres. */
async function hand(page: Page): Promise<readonly number[]> {
  const targets = (await poseOf(page.locator('raconteur-player')))?.targets ?? [];
  return targets.find(({ name }) => name === 'rightArm')?.position ?? [];
}

const distance = (a: readonly number[], b: readonly number[]): number => Math.hypot(...a.map((x, i) => x - (b[i] ?? NaN)));

/** Sets the time by the slider. */
const seek = (page: Page, secs: number): Promise<void> => page.getByRole('slider', { name: 'Time' }).fill(String(secs));

/** Presses Tab until a span has the focus. */
async function tabToSpans(page: Page): Promise<void> {
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press('Tab');
    if (await page.evaluate(() => document.activeElement?.getAttribute('role') === 'gridcell')) return;
  }
  throw new Error('Tab does not lead to a span');
}

test('an edge that is moved by keys moves the hand of the figure, and undo takes it back', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await openExample(page);
  await seek(page, 1.7);
  await expect.poll(async () => (await hand(page)).length).toBe(3);
  await page.waitForTimeout(500);
  const before = await hand(page);
  await tabToSpans(page);
  // From the words over utterances, discourse and gestures to the phases, and to the stroke.
  for (let i = 0; i < 4; i++) await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await expect(cell(page, /^Phases, layer1: stroke, 1\.46 to 2\.30 s$/)).toBeFocused();
  for (let i = 0; i < 40; i++) await page.keyboard.press('Alt+Shift+ArrowRight');
  await expect(cell(page, /^Phases, layer1: stroke, 1\.86 to 2\.30 s$/)).toBeFocused();
  await expect(cell(page, /^Phases, layer1: preparation, 0\.90 to 1\.86 s$/)).toBeVisible();
  await expect(page.getByRole('spinbutton', { name: 'Start, s' })).toHaveValue('1.86');
  await seek(page, 1.7);
  await expect.poll(async () => distance(await hand(page), before)).toBeGreaterThan(0.03);
  for (let i = 0; i < 40; i++) await page.keyboard.press('Control+z');
  await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  await expect(cell(page, /^Phases, layer1: stroke, 1\.46 to 2\.30 s$/)).toBeVisible();
  await seek(page, 1.7);
  await expect.poll(async () => distance(await hand(page), before)).toBeLessThan(0.005);
});

test('a dragged border moves for both spans and is one step of undo', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await openExample(page);
  const stroke = cell(page, /^Phases, layer1: stroke, 9\.04/);
  const box = await stroke.boundingBox();
  const [x, y] = [box!.x + box!.width, box!.y + box!.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y, { steps: 5 });
  await page.mouse.up();
  const moved = await stroke.getAttribute('aria-label');
  const [, end = ''] = /to (\d+\.\d\d) s$/.exec(moved ?? '') ?? [];
  expect(Number(end)).toBeGreaterThan(9.65);
  await expect(cell(page, new RegExp(`^Phases, layer1: retraction, ${end.replace('.', '\\.')} to 10\\.40 s$`))).toBeVisible();
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(cell(page, /^Phases, layer1: stroke, 9\.04 to 9\.60 s$/)).toBeVisible();
  await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
});

test('what is saved as ANVIL opens as the same annotation, and a reload keeps it', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await openExample(page);
  const before = await names(page);
  expect(before.length).toBeGreaterThan(60);
  const saved = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save ANVIL' }).click();
  const file = await saved;
  expect(file.suggestedFilename()).toBe('example.anvil');
  const text = readFileSync(await file.path());
  await page.getByRole('button', { name: 'Close' }).click();
  await expect(cells(page)).toHaveCount(0);
  await openFile(page, 'again.anvil', text);
  await expect(page.locator('#counts')).toContainText('again: 32 words');
  expect(await names(page)).toEqual(before);
  await page.reload();
  await expect(page.locator('#counts')).toContainText('again: 32 words');
  expect(await names(page)).toEqual(before);
  const script = page.waitForEvent('download');
  await page.getByText('Seconds', { exact: true }).click();
  await page.getByRole('button', { name: 'Save EML' }).click();
  const eml = readFileSync(await (await script).path(), 'utf8');
  expect(eml).toContain('<gesture-key');
  expect(eml).not.toContain('<tm ');
});

test('an error of a form is said at its field, and the list leads to it', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await openExample(page);
  await cell(page, /^Phases, layer1: stroke, 6\.82/).click();
  await page.keyboard.press('Enter');
  await expect(page.getByLabel('Kind')).toBeFocused();
  const motion = page.getByLabel('Motion');
  await motion.fill('[[-14;20;10];[-20;25]]');
  await expect(motion).toHaveAttribute('aria-invalid', 'true');
  await expect(motion).toHaveAccessibleDescription(/expected a position/);
  await cell(page, /^Words: boat/).click();
  await expect(page.getByLabel('Word', { exact: true })).toHaveValue('boat');
  await page.locator('#problems').getByRole('button', { name: 'stroke at 6.82 s' }).click();
  await expect(motion).toBeFocused();
  await page.keyboard.press('Escape');
  await expect(cell(page, /^Phases, layer1: stroke, 6\.82/)).toBeFocused();
});

test('a broken file says what is wrong, with the line', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await openFile(
    page,
    'broken.anvil',
    Buffer.from('<annotation>\n<body>\n<track name="words" type="primary">\n<el index="0" start="a" end="2"/>\n</track>\n</body>\n</annotation>'),
  );
  const alert = page.getByRole('alert');
  await expect(alert).toContainText('broken.anvil could not be opened.');
  await expect(alert).toContainText('Line 4, column 22');
  await openFile(page, 'fine.anvil', SMALL);
  await expect(page.locator('#counts')).toContainText('fine: 4 words');
  await expect(alert).toHaveCount(0);
});

/** Returns seconds of silence as a WAVE file. */
function silence(secs: number): Buffer {
  const [rate, header] = [8000, Buffer.alloc(44)];
  header.write('RIFF', 0);
  header.writeUInt32LE(36 + secs * rate, 4);
  header.write('WAVEfmt ', 8);
  header.writeUInt32LE(16, 16);
  header.writeUInt16LE(1, 20);
  header.writeUInt16LE(1, 22);
  header.writeUInt32LE(rate, 24);
  header.writeUInt32LE(rate, 28);
  header.writeUInt16LE(1, 32);
  header.writeUInt16LE(8, 34);
  header.write('data', 36);
  header.writeUInt32LE(secs * rate, 40);
  return Buffer.concat([header, Buffer.alloc(secs * rate, 128)]);
}

test('the figure follows the recording, though its hands need a run-up', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await openFile(page, 'small.anvil', SMALL);
  await expect(page.locator('#counts')).toContainText('4 words');
  const player = page.locator('raconteur-player');
  const figure = (): Promise<number> => player.evaluate((p: RaconteurPlayer) => p.currentTime);
  // The first gesture begins at 0.3 s, and a hand needs 0.9 s.
  await seek(page, 1);
  await expect.poll(figure).toBeCloseTo(1.6, 2);
  await page
    .locator('input[type=file]')
    .last()
    .setInputFiles({ name: 'voice.wav', mimeType: 'audio/wav', buffer: silence(12) });
  await expect(page.locator('.clock')).toContainText('/ 12.00 s');
  await expect.poll(figure).toBeCloseTo(1.6, 2);
  // Slowly, so that the script does not end in the meantime.
  await page.getByLabel('Speed').selectOption('0.25');
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  const recording = (): Promise<number> => page.locator('#media').evaluate((media: HTMLMediaElement) => media.currentTime);
  await expect.poll(recording).toBeGreaterThan(1.1);
  // Both clocks are read in one call.
  const apart = (): Promise<number> =>
    player.evaluate((p: RaconteurPlayer) => Math.abs(p.currentTime - 0.6 - (document.querySelector<HTMLMediaElement>('#media')?.currentTime ?? NaN)));
  await expect.poll(apart).toBeLessThan(0.05);
  expect(await player.evaluate((p: RaconteurPlayer) => p.muted)).toBe(true);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await seek(page, 1.25);
  await expect.poll(figure).toBeCloseTo(1.85, 2);
  expect(await player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
});

/** Returns an annotation of eight minutes with 300 gestures. */
function long(): Buffer {
  const kinds = ['preparation', 'stroke', 'retraction'];
  const phases = Array.from({ length: 900 }, (_, i) => {
    const start = 1.6 * Math.floor(i / 3) + 0.5 * (i % 3);
    return `<el index="${i}" start="${start}" end="${start + 0.5}"><attribute name="phase">${kinds[i % 3]}</attribute></el>`;
  });
  return Buffer.from(`<annotation><body><track name="gesticulation.phases.layer1" type="primary">${phases.join('')}</track></body></annotation>`);
}

test('of a long recording, only what is in view is drawn', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await openFile(page, 'long.anvil', long());
  await expect(page.locator('#counts')).toContainText('479.9 s');
  expect(await cells(page).count()).toBeLessThan(60);
  await cells(page).last().click();
  await page.keyboard.press('End');
  await expect(cell(page, /retraction, 7:59\.40 to 7:59\.90 s$/)).toBeFocused();
  expect(await cells(page).count()).toBeLessThan(60);
  await page.getByRole('button', { name: 'All', exact: true }).click();
  await expect.poll(() => cells(page).count()).toBeGreaterThan(400);
});

for (const look of LOOKS) {
  test(`nothing bars the way: ${look.colorScheme}, ${look.device}`, async ({ stage, page }) => {
    expect(stage.backend).toBe('page');
    await open(page);
    await lookAt(page, look);
    if (partsIn(look, ['file', 'example']).includes('file')) {
      await openFile(page, 'broken.anvil', Buffer.from('<annotation'));
      await expect(page.getByRole('alert')).toBeVisible();
    }
    await expectNoBarriers(page, 'empty');
    await page.getByRole('button', { name: 'Try an example' }).click();
    await expect(cells(page).first()).toBeVisible();
    await expectNoBarriers(page, 'opened');
    for (const track of ['Phases, layer1: stroke', 'Phrases, layer1: iconic', 'Gestures: gesticulation']) {
      await cell(page, new RegExp(`^${track}`))
        .first()
        .click();
      await expect(page.locator('#panel input').first()).toBeVisible();
      await expectNoBarriers(page, track);
    }
  });
}
