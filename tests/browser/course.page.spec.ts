/** Packages of `raconteur export` in a learning management system. */

import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { validateXML } from 'xmllint-wasm';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, LOOKS } from './access.js';
import { exported, HELLO, kept, playerIn, root, serve, SYSTEMS, TYPES } from './lms.js';
import { expect, ready, test } from './stage.js';

/** A story with a question. */
const ASKING = `<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><null time='1'/>
  <r:ask time='0' name='who' prompt='Who sang?' points='2' tries='2'><r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone'/>
  <r:answer to='right'><null time='0.5'/></r:answer><r:answer to='wrong'><null time='5'/></r:answer></r:ask><null time='1'/></seq></body></eml>`;

/** Returns the schemas of a standard's manifests, as `web/tools/setup.mjs` fetches them. */
function schemasOf(standard: keyof typeof SYSTEMS): { readonly [name: string]: string } {
  const folder = join(root, '.setup/schemas/package/lib/schemas/definitionFiles', standard === 'scorm12' ? 'scorm12edition' : 'scorm20044thedition');
  return Object.fromEntries(readdirSync(folder).map((name) => [name, readFileSync(join(folder, name), 'utf8')]));
}

for (const [standard, first] of [
  ['scorm12', 'imscp_rootv1p1p2.xsd'],
  ['scorm2004', 'imscp_v1p1.xsd'],
] as const) {
  test(`the manifests of ${standard}, of one lesson and of several, are some by the schemas of the standard`, async () => {
    const manifestOf = (...more: readonly string[]) => new TextDecoder().decode(exported(standard, HELLO, ...more)['imsmanifest.xml']);
    const manifest = manifestOf();
    const several = manifestOf(HELLO, HELLO);
    const all = schemasOf(standard);
    // One schema imports the names of all namespaces, so that all elements and attributes are
    // validated.
    const spaces = [...manifest.matchAll(/xmlns(?::\w+)?="([^"]+)"/g)].map(([, space]) => space ?? '');
    const imports = Object.entries(all).flatMap(([name, text]) => {
      const space = /targetNamespace\s*=\s*"([^"]+)"/.exec(text)?.[1] ?? '';
      const isOwn = name === first || (spaces.includes(space) && !/imscp|imsss_v1p0\w/.test(name));
      return isOwn ? [`<xs:import namespace="${space}" schemaLocation="${name}"/>`] : [];
    });
    const schema = `<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">${imports.join('')}</xs:schema>`;
    const preload = Object.entries(all).map(([fileName, contents]) => ({ fileName, contents }));
    const check = (contents: string) => validateXML({ xml: [{ fileName: 'imsmanifest.xml', contents }], schema: [{ fileName: 'all.xsd', contents: schema }], preload });
    expect((await check(manifest)).errors).toEqual([]);
    expect([several.match(/<item /g)?.length, (await check(several)).errors]).toEqual([3, []]);
    // The check detects a deliberate error.
    expect((await check(manifest.replace('<organizations', '<organisations').replace('</organizations', '</organisations'))).valid).toBe(false);
    expect((await check(manifest.replace(/adlcp:scorm[tT]ype="sco"/, (found) => found.replace('"sco"', '"lesson"')))).valid).toBe(false);
  });
}

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
    // The browser itself requests two icons.
    expect(missing.filter((path) => path !== 'favicon.ico')).toEqual([]);
  });
}

test('answers are kept at once, and a learner who comes back in the middle of a question is asked it again', async ({ page }) => {
  const story = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'story.eml');
  writeFileSync(story, ASKING);
  await serve(page, 'scorm2004', story);
  const form = page.frameLocator('iframe').locator('[part~=question]');
  const answer = async (text: string) => {
    await form.getByLabel(text).check();
    await form.getByRole('button', { name: 'Answer' }).click();
  };
  await ready(playerIn(page));
  await page.frameLocator('iframe').getByRole('button', { name: 'Play the story' }).click();
  await expect(form).toBeVisible();
  await answer('A stone');
  const replies = async () =>
    Object.values((await kept(page, ['interactions'])) as { [n: string]: { learner_response: string; result: string } }).map((it) => [it.learner_response, it.result]);
  await expect.poll(replies).toEqual([['stone', 'incorrect']]);
  // The tab is closed while the question is open.
  await page.goto('/lms/');
  await ready(playerIn(page));
  await expect(form).toBeVisible();
  await answer('A frog');
  await expect.poll(replies).toEqual([
    ['stone', 'incorrect'],
    ['frog', 'correct'],
  ]);
  await expect.poll(() => kept(page, ['completion_status']), { timeout: 60_000 }).toBe('completed');
  expect([await kept(page, ['success_status']), Number(await kept(page, ['score', 'raw'])), Number(await kept(page, ['score', 'scaled']))]).toEqual(['passed', 2, 1]);
});

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
