/** Tests of a player with its story between its tags, or without a story. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { story, voiceFiles } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const ATTRIBUTES = 'quality="lowest" loading="eager"';

/** Hides the stage: no test here needs an image, and rendering one takes longer than all the rest. */
async function unseen(stage: Stage): Promise<void> {
  await stage.page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
}

const codes = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code));
/** Returns the words reported up to now, each once. */
const words = (stage: Stage) => stage.page.evaluate(() => window.record.events.filter((e) => e.type === 'word').map((e) => (e.detail as { word: { text: string } }).word.text));

test('an empty story with `loop`, and none at all, end quietly', async ({ stage, page }) => {
  await unseen(stage);
  await stage.open(`<raconteur-player src="story.eml" loop ${ATTRIBUTES}></raconteur-player><raconteur-player loop loading="eager"></raconteur-player>`, {
    'story.eml': '<eml><body/></eml>',
  });
  await stage.ready();
  // An error thrown in a listener fails this test automatically.
  await stage.player.evaluate((p: RaconteurPlayer) => p.play());
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => [p.paused, p.ended])).toEqual([true, true]);
  const second = page.locator('raconteur-player').nth(1);
  expect(await second.evaluate((p: RaconteurPlayer) => p.play().catch((error: Error) => error.name))).toBe('NotSupportedError');
  await second.evaluate((p: RaconteurPlayer) => p.rehearse(''));
  await second.evaluate((p: RaconteurPlayer) => p.play());
  await page.waitForTimeout(500);
  const seeks = await page.evaluate(() => window.record.events.filter((e) => e.type === 'seeking').length);
  // Playing an ended story seeks to its beginning once.
  expect(seeks).toBeLessThan(3);
});

test('plain text between the tags is told, sentence by sentence, and is hidden', async ({ stage, page }) => {
  await unseen(stage);
  await stage.open(`<p lang="de"><raconteur-player captions ${ATTRIBUTES}>
    Es war einmal
    ein <em>Frosch</em>, der sang.<br>Dann kam   der Storch.
    <noscript>Ohne Skripte.</noscript>
  </raconteur-player></p>`);
  await stage.ready();
  await expect(page.getByText('Frosch', { exact: true })).toBeHidden();
  await stage.play();
  const all = 'Es war einmal ein Frosch, der sang. Dann kam der Storch.'.split(' ');
  await expect.poll(() => words(stage), { timeout: 60_000 }).toEqual(all);
  const told = await stage.player.evaluate((p: RaconteurPlayer) => p.duration);
  expect(told).toBeGreaterThan(3);
  // Another text replaces it.
  await stage.player.evaluate((p) => void (p.textContent = 'Ende.'));
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.duration)).toBeLessThan(told - 1);
});

test('EML between the tags is carried by a script, or escaped', async ({ stage, page }) => {
  await unseen(stage);
  const eml = story("<voice-text time='0'>Hello <emph>garden</emph></voice-text>");
  const escaped = eml.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
  await stage.open(
    `<raconteur-player ${ATTRIBUTES}><script type="application/eml+xml">${eml}</script><p>Hello garden, without scripts</p></raconteur-player>
     <raconteur-player ${ATTRIBUTES}>${escaped}</raconteur-player>
     <raconteur-player ${ATTRIBUTES}>${eml}</raconteur-player>`,
  );
  for (const i of [0, 1]) {
    const player = page.locator('raconteur-player').nth(i);
    await stage.ready(player);
    await stage.play(player);
    await expect.poll(() => words(stage), { timeout: 60_000 }).toEqual(['Hello', 'garden']);
    await page.evaluate(() => void (window.record.events.length = 0));
    await stage.pause(player);
  }
  // Markup that the HTML parser has changed is no longer valid EML: the element speaks its words
  // and reports a diagnostic to the page's author.
  const mangled = page.locator('raconteur-player').nth(2);
  await stage.ready(mangled);
  expect(await mangled.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('text-as-html');
});

test('the attribute src has the last word', async ({ stage }) => {
  await unseen(stage);
  const text = 'From the file';
  await stage.open(`<raconteur-player src="story.eml" ${ATTRIBUTES}>The story of the frog, to be read.</raconteur-player>`, {
    'story.eml': story(`<voice-text time='0'>${text}</voice-text>`),
    ...voiceFiles([{ text, msec: 600 }]),
  });
  await stage.ready();
  await stage.play();
  await expect.poll(() => words(stage)).toEqual(text.split(' '));
  // Without it the text is the story that is loaded next.
  await stage.player.evaluate((p: RaconteurPlayer) => {
    p.removeAttribute('src');
    return p.load();
  });
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.readyState)).toBe(4);
  await stage.play();
  await expect.poll(async () => (await words(stage)).join(' '), { timeout: 60_000 }).toContain('The story of the frog');
});

test('what stands between the tags is shown where there are no scripts', async ({ browser, baseURL }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.route('**/test/', (route) =>
    route.fulfill({
      contentType: 'text/html',
      body: `<!doctype html><title>Test</title><script type="module" src="/raconteur-player.js"></script>
        <raconteur-player><script type="application/eml+xml"><eml><body/></eml></script><p>The frog sang.</p><noscript>No scripts here.</noscript></raconteur-player>`,
    }),
  );
  await page.goto(`${baseURL}/test/`);
  await expect(page.getByText('The frog sang.')).toBeVisible();
  await expect(page.locator('noscript')).toBeVisible();
  await expect(page.locator('raconteur-player > script')).toBeHidden();
  await context.close();
});

test('lines are performed without a story, one after another, and time goes on', async ({ stage }) => {
  await unseen(stage);
  await stage.open('<raconteur-player quality="lowest"></raconteur-player>');
  const perform = (line: string) =>
    stage.player.evaluate(async (p: RaconteurPlayer, said) => (await p.perform(`<voice-text time='0'>${said}</voice-text>`)).map((a) => a.kind), line);
  expect(await perform('Here I am')).toContain('accepted');
  await stage.play();
  await expect.poll(() => words(stage), { timeout: 60_000 }).toEqual(['Here', 'I', 'am']);
  // The stage stays open.
  await stage.until((await stage.time()) + 1.5);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.paused, p.ended, p.duration, p.error])).toEqual([false, false, Infinity, null]);
  await perform('Still here');
  await expect.poll(() => words(stage), { timeout: 60_000 }).toEqual(['Here', 'I', 'am', 'Still', 'here']);
  // The empty stage has no diagnostics.
  expect((await codes(stage)).filter((code) => code.startsWith('eml::'))).toEqual([]);
});

test('one who has asked in vain to play may have lines performed', async ({ stage }) => {
  await unseen(stage);
  await stage.open('<raconteur-player quality="lowest"></raconteur-player>');
  const refused = await stage.player.evaluate((p: RaconteurPlayer) => p.play().catch((error: Error) => error.message));
  expect(refused).toContain('between the tags');
  await stage.player.evaluate(async (p: RaconteurPlayer) => {
    await p.perform("<voice-text time='0'>Now</voice-text>");
    await p.play();
  });
  await expect.poll(() => words(stage), { timeout: 60_000 }).toEqual(['Now']);
});

test('a mind needs no story', async ({ stage }) => {
  await unseen(stage);
  await stage.open('<raconteur-player quality="lowest"></raconteur-player>');
  await stage.player.evaluate((p: RaconteurPlayer) => p.play().catch(() => undefined));
  // No mind exists at such an address; the stage loads nevertheless.
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.mind = 'javascript:alert(1)'));
  await stage.ready();
  await expect.poll(() => codes(stage)).toEqual(['mind-address']);
});

test('what nobody says is read: captions are shown unasked, until they are refused', async ({ stage }) => {
  await unseen(stage);
  // No speech is available: neither an engine of the page nor a voice of the browser.
  await stage.page.addInitScript(() => Object.defineProperty(window, 'speechSynthesis', { value: undefined }));
  await stage.open(
    `<raconteur-player controls speech="browser" ${ATTRIBUTES}>One two three four five six seven eight nine ten. Eleven twelve thirteen fourteen.</raconteur-player>`,
  );
  await stage.ready();
  await stage.play();
  const captions = stage.player.locator('.captions');
  await expect(captions).toContainText('three four');
  const button = stage.player.getByRole('button', { name: 'Captions' });
  await expect(button).toHaveAttribute('aria-pressed', 'true');
  await stage.player.press('c');
  await expect(captions).toHaveCount(0);
  await stage.player.press('c');
  await expect(captions).toBeVisible();
});

test('without a voice the lips follow the text, by the rules of its language', async ({ stage }) => {
  await unseen(stage);
  const player = (lang: string) => `<div lang="${lang}"><raconteur-player speech="browser" ${ATTRIBUTES}>Mama Schule</raconteur-player></div>`;
  await stage.open(player('en') + player('de'));
  const names = async (i: number): Promise<string> => {
    const told = stage.page.locator('raconteur-player').nth(i);
    await stage.ready(told);
    return await told.evaluate((p: RaconteurPlayer) => p.course(0, p.duration, 2)?.names.join(' ') ?? '');
  };
  const [english, german] = [await names(0), await names(1)];
  for (const phones of [english, german]) expect(phones).toMatch(/m \S+ m /);
  expect(english).toMatch(/ s k /);
  expect(german).toMatch(/ sh /);
});
