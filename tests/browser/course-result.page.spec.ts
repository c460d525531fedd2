/** Tests of the course shell: chapters, exit, saved data, and result; by keyboard, on a phone. */

import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers } from './access.js';
import { exported, TYPES } from './lms.js';
import { Lrs } from './lrs.js';
import { expect, ready, test } from './stage.js';

const story = (language: string): string => `<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer language='${language}'/></head><body><seq time='0'>
  <r:part time='0' name='one' title='Um'><seq time='0'><null time='1'/>
  <r:ask time='0' name='who' prompt='Quem cantou?' points='2'><r:option name='frog' text='Uma rã' right='true'/><r:option name='stone' text='Uma pedra'/></r:ask></seq></r:part>
  <r:part time='0' name='two' title='Dois'><seq time='0'><null time='1'/><r:ask time='0' name='like' prompt='Gostou?' graded='false'><r:option name='yes' text='Sim'/><r:option name='no' text='Não'/></r:ask><null time='1'/></seq></r:part></seq></body></eml>`;

/** Serves a package below `/site/`. */
async function serve(page: Page, standard: string, language: string): Promise<void> {
  const file = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'story.eml');
  writeFileSync(file, story(language));
  const files = exported(standard, file);
  await page.route('**/site/**', (route) => {
    const path = new URL(route.request().url()).pathname.replace(/^\/site\//, '') || 'index.html';
    const found = files[path];
    return found === undefined ? route.fulfill({ status: 404 }) : route.fulfill({ contentType: TYPES[extname(path)] ?? 'application/octet-stream', body: Buffer.from(found) });
  });
}

const question = (page: Page) => page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => p.question?.name);

/** Presses Tab until the element called `name` has the focus, 30 times at most. */
async function tabTo(page: Page, name: string): Promise<void> {
  for (let i = 0; i < 30; i++) {
    await page.keyboard.press('Tab');
    const reached = await page.evaluate(() => {
      let at: Element | null = document.activeElement;
      while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
      return at?.getAttribute('aria-label') ?? at?.textContent?.trim() ?? '';
    });
    if (reached === name) return;
  }
  throw new Error(`Tab does not come to ${name}.`);
}

test('a course is taken by the keyboard on a phone, in its language, to its result and once more', async ({ page }) => {
  await page.setViewportSize({ width: 360, height: 640 });
  await serve(page, 'html', 'pt');
  await page.goto('/site/');
  const player = page.locator('raconteur-player');
  await ready(player);
  await tabTo(page, 'Capítulos');
  await page.keyboard.press('Enter');
  await expect(page.getByRole('button', { name: 'Dois' })).toBeVisible();
  await expectNoBarriers(page, 'chapters');
  await page.keyboard.press('Enter');
  await tabTo(page, 'Ouvir a história');
  await page.keyboard.press('Enter');
  await expect.poll(() => question(page)).toBe('who');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await expect.poll(() => question(page)).toBe('like');
  await page.keyboard.press('Space');
  await page.keyboard.press('Enter');
  const result = page.locator('section');
  await expect(result.getByRole('heading', { name: 'O seu resultado' })).toBeFocused();
  await expect(result.getByText('Não aprovado')).toBeVisible();
  await expect(result.locator('.score')).toHaveText('0 de 2 pontos');
  expect(await result.locator('.mark').allInnerTexts()).toEqual(['Não está certo · 0 de 2 pontos', 'Respondido']);
  await expect(result.getByText('A sua resposta: Uma pedra')).toBeVisible();
  await expect(result.getByText('Certo: Uma rã')).toBeVisible();
  await expectNoBarriers(page, 'the result');
  await tabTo(page, 'Tentar outra vez');
  await page.keyboard.press('Enter');
  await expect(result).toBeHidden();
  await expect.poll(() => question(page)).toBe('who');
  await page.keyboard.press('Space');
  await page.keyboard.press('Enter');
  await expect.poll(() => question(page)).toBe('like');
  await page.keyboard.press('Space');
  await page.keyboard.press('Enter');
  await expect(result.getByText('Aprovado', { exact: true })).toBeVisible();
  // Learners who return find the stored data.
  await page.reload();
  await ready(player);
  expect(await player.evaluate((p: RaconteurPlayer) => p.score)).toEqual({ points: 2, most: 2 });
});

test('what cannot be saved is said until it is, and the way out leads back', async ({ page }) => {
  const lrs = new Lrs({ contextTemplate: {}, launchMode: 'Normal', moveOn: 'Completed', returnURL: 'http://localhost/back' });
  await lrs.serve(page.context());
  await serve(page, 'cmi5', 'de');
  await page.context().route('http://localhost/back', (route) => route.fulfill({ contentType: 'text/html', body: '<title>Back</title>' }));
  lrs.fault = 'away';
  await page.goto(lrs.launch('/site/', true));
  await ready(page.locator('raconteur-player'));
  const status = page.locator('output');
  await expect(status).toHaveText(/^Noch nicht gespeichert/);
  await page.getByRole('button', { name: 'Die Geschichte abspielen' }).click();
  await expect.poll(() => question(page)).toBe('who');
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void p.answer('frog'));
  lrs.fault = undefined;
  await expect(status).toHaveText('Alles ist gespeichert.', { timeout: 60_000 });
  await expect.poll(() => lrs.statements.map(({ verb }) => verb.id.split('/').at(-1))).toContain('answered');
  lrs.fault = 401;
  await page.locator('raconteur-player').evaluate((p: RaconteurPlayer) => void p.answer('yes'));
  await expect(status).toHaveText(/^Nicht gespeichert/, { timeout: 30_000 });
  await expectNoBarriers(page, 'a course that is not saved');
  lrs.fault = undefined;
  await page.getByRole('button', { name: 'Kurs verlassen' }).click();
  await expect(page).toHaveTitle('Back');
  await expect.poll(() => lrs.statements.map(({ verb }) => verb.id.split('/').at(-1)).at(-1)).toBe('terminated');
});
