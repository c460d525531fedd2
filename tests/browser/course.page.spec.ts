/** Packages of `raconteur export` in a learning management system: scorm-again, which others have made. */

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import type { Page } from '@playwright/test';
import { unzipSync } from 'fflate';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { kind } from '../../web/test/tier.js';
import { expectNoBarriers, LOOKS } from './access.js';
import { expect, ready, test } from './stage.js';

const root = join(import.meta.dirname, '../..');
const program = join(process.env['CARGO_TARGET_DIR'] ?? join(root, 'target'), 'debug/raconteur');
const TYPES: { [ending: string]: string } = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

/** The files of a package. */
function exported(standard: string): { readonly [path: string]: Uint8Array } {
  const file = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'course.zip');
  const story = join(root, 'assets/stories/hello-world');
  execFileSync(program, ['export', story, `--${standard}`, '--player', join(root, kind.site), '--title', 'Hello & welcome', '--output', file]);
  return unzipSync(readFileSync(file));
}

/** The systems, and where each has the status. */
const SYSTEMS = {
  scorm12: { object: 'API', made: 'Scorm12API', commit: 'LMSCommit', status: ['core', 'lesson_status'], memory: 'suspend_data' },
  scorm2004: { object: 'API_1484_11', made: 'Scorm2004API', commit: 'Commit', status: ['completion_status'], memory: 'suspend_data' },
} as const;

/** The page of the system: it keeps what is committed, and gives it to the next session. */
const pageOf = ({ object, made, commit }: (typeof SYSTEMS)[keyof typeof SYSTEMS]) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>A system</title>
  <script src="system.js"></script>
  <script>
    const api = (window.${object} = new ${made}({ autocommit: false }));
    const kept = localStorage.getItem('kept');
    if (kept !== null) api.loadFromJSON(JSON.parse(kept), '');
    api.on('${commit}', () => localStorage.setItem('kept', JSON.stringify(api.renderCMIToJSONObject())));
  </script>
  <iframe src="course/index.html" title="The course" width="460" height="340" allow="autoplay"></iframe></html>`;

/** Serves a system with a package, and tells what was asked for in vain. */
async function serve(page: Page, standard: keyof typeof SYSTEMS): Promise<string[]> {
  const files = exported(standard);
  const system = SYSTEMS[standard];
  const missing: string[] = [];
  await page.route('**/lms/**', (route) => {
    const path = new URL(route.request().url()).pathname.replace(/^\/lms\//, '');
    if (path === '') return route.fulfill({ contentType: 'text/html', body: pageOf(system) });
    if (path === 'system.js') return route.fulfill({ path: join(root, `node_modules/scorm-again/dist/${standard}.js`) });
    const file = files[path.replace(/^course\//, '')];
    if (file === undefined) {
      missing.push(path);
      return route.fulfill({ status: 404 });
    }
    return route.fulfill({ contentType: TYPES[extname(path)] ?? 'application/octet-stream', body: Buffer.from(file) });
  });
  await page.goto('/lms/');
  return missing;
}

const playerIn = (page: Page) => page.frameLocator('iframe').locator('raconteur-player');

/** What the system has kept at a place of its data. */
const kept = (page: Page, at: readonly string[]) =>
  page.evaluate(
    (path) =>
      path.reduce<unknown>((data, name) => (data as { [name: string]: unknown } | undefined)?.[name], (JSON.parse(localStorage.getItem('kept') ?? '{}') as { cmi?: unknown }).cmi),
    at,
  );

for (const [standard, system] of Object.entries(SYSTEMS) as [keyof typeof SYSTEMS, (typeof SYSTEMS)[keyof typeof SYSTEMS]][]) {
  test(`a course with ${standard} is left in the middle, gone on with, and completed`, async ({ page }) => {
    const missing = await serve(page, standard);
    const player = playerIn(page);
    await ready(player);
    await page.frameLocator('iframe').getByRole('button', { name: 'Play the story' }).click();
    await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBeGreaterThan(0.5);
    // The tab is closed.
    await page.goto('/lms/');
    await ready(player);
    expect(await kept(page, system.status)).toBe('incomplete');
    const { at } = JSON.parse(String(await kept(page, [system.memory]))) as { at: number };
    expect(at).toBeGreaterThan(0.4);
    expect(await player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBeCloseTo(at, 1);
    await page.frameLocator('iframe').getByRole('button', { name: 'Play' }).first().click();
    await expect.poll(() => kept(page, system.status), { timeout: 60_000 }).toBe('completed');
    // Two pictures are looked for by the browser itself.
    expect(missing.filter((path) => path !== 'favicon.ico')).toEqual([]);
  });
}

test('the page of a course has no barriers, and no sideways scroll', async ({ page }) => {
  const files = exported('html');
  await page.route('**/site/**', (route) => {
    const path = new URL(route.request().url()).pathname.replace(/^\/site\//, '') || 'index.html';
    const file = files[path];
    return file === undefined ? route.fulfill({ status: 404 }) : route.fulfill({ contentType: TYPES[extname(path)] ?? 'application/octet-stream', body: Buffer.from(file) });
  });
  for (const { colorScheme, width, height } of LOOKS) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height });
    await page.goto('/site/');
    await ready(page.locator('raconteur-player'));
    await expect(page.getByRole('heading', { name: 'Hello & welcome' })).toBeVisible();
    await expectNoBarriers(page, `${colorScheme}, ${width} px`);
  }
});
