/** Tests of the messages that a visitor sees after errors. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test, type Stage } from './stage.js';

const story = (inside: string) => `<eml>\n<body>\n${inside}\n</body>\n</eml>`;

const BROKEN = story(`<voice-text id="v">Hello <wobble/> good people of the garden.</voice-text>
<gesture-is-on id="g" hand="right"><hand-shapes values="9999"/></gesture-is-on>
<unknown-thing/>`);

async function open(stage: Stage, files: { [path: string]: string }, attributes = 'controls captions'): Promise<void> {
  await stage.open(`<raconteur-player src="story.eml" ${attributes}></raconteur-player>`, files);
}

test('a broken story says where, and the rest of it plays without a voice', async ({ stage }) => {
  await open(stage, { 'story.eml': BROKEN }, 'controls captions remarks');
  await stage.ready();
  const list = stage.player.locator('details');
  await expect(list).not.toHaveAttribute('open');
  await list.locator('summary').click();
  await expect(list.locator('li').first()).toContainText(/Line \d+, column \d+:/);
  await expect(list).toContainText('unknown-thing');
  const diagnostics = await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics);
  const found = diagnostics.find((d) => d.message.includes('unknown-thing'));
  expect(found?.start).toMatchObject({ line: 5 });
  expect(diagnostics.some((d) => d.code === 'voice-missing')).toBe(true);
  // Escape folds the list away.
  await stage.page.keyboard.press('Escape');
  await expect(list).not.toHaveAttribute('open');

  await stage.play();
  await stage.page.waitForFunction(() => window.record.events.filter((e) => e.type === 'word').length >= 2);
  await expect(stage.player.locator('.captions')).toContainText('good people');
  expect(await stage.events()).toContain('diagnostic');
});

test('what is wrong with a story is shown to those who ask for it alone', async ({ stage }) => {
  await open(stage, { 'story.eml': BROKEN });
  await stage.ready();
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.length)).toBeGreaterThan(2);
  await expect(stage.player.locator('details')).toHaveCount(0);
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.remarks = true));
  await expect(stage.player.locator('details summary')).toContainText('warning');
});

test('bytes that are not UTF-8 are told, and a replacement character that was written is not', async ({ stage }) => {
  const text = story("<voice-text time='0'>a \ufffd caf?</voice-text>");
  const bytes = Buffer.from(text);
  await stage.open('<raconteur-player src="story.eml"></raconteur-player>', { 'story.eml': bytes });
  await stage.ready();
  const told = () => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => d.code === 'eml::not-utf8').map((d) => d.message));
  expect(await told()).toEqual([]);
  const broken = Buffer.from(bytes);
  broken[bytes.indexOf('?', bytes.indexOf('caf'))] = 0xe9;
  await stage.page.unroute('**/test/**');
  await stage.open('<raconteur-player src="story.eml"></raconteur-player>', { 'story.eml': broken });
  await stage.ready();
  expect(await told()).toEqual([expect.stringContaining(`byte ${broken.indexOf(0xe9, bytes.indexOf('caf'))} is not UTF-8`)]);
});

test('a text that is not a story gives diagnostics, not a crash', async ({ stage }) => {
  await open(stage, { 'story.eml': 'Dear diary, today I did not write any markup.' });
  await stage.ready();
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.length)).toBeGreaterThan(0);
  expect((await stage.picture()).spread).toBeGreaterThan(8);
});

test('a story that is not there says so, and can be tried again', async ({ stage }) => {
  await open(stage, {});
  await expect(stage.player.getByRole('alert')).toContainText('The story was not found at /test/story.eml.');
  expect(await stage.events()).toContain('error');
  const message = await stage.player.evaluate((p: RaconteurPlayer) =>
    p.play().then(
      () => '',
      (e: Error) => e.message,
    ),
  );
  expect(message).toContain('not found');
  await stage.page.route('**/test/story.eml', (route) => route.fulfill({ body: story('<voice-text id="v">Here I am.</voice-text>') }));
  await stage.player.getByRole('button', { name: 'Try again' }).click();
  await stage.ready();
  await expect(stage.player.getByRole('alert')).toHaveCount(0);
});

test('a figure that is not a figure says so', async ({ stage }) => {
  await open(stage, { 'story.eml': BROKEN, 'bad.glb': 'not a figure' }, 'controls figure="bad.glb"');
  await expect(stage.player.getByRole('alert')).toBeVisible({ timeout: 60_000 });
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.error?.name)).toBe('PlayerError');
});

test('a recording that cannot be played leaves the captions', async ({ stage, page }) => {
  await page.route('**/hello-world/voice/*.{opus,mp3,ogg}', (route) => route.fulfill({ status: 404 }));
  await stage.load('hello-world');
  await stage.play();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('sound-missing');
  await stage.until(0.3);
  await page.waitForFunction(() => window.record.events.some((e) => e.type === 'word'));
});

test('nothing is fetched from outside the story and the library', async ({ stage, page }) => {
  const asked: string[] = [];
  page.on('request', (request) => asked.push(new URL(request.url()).pathname));
  const speech = JSON.parse(readFileSync(join(import.meta.dirname, '../../assets/stories/hello-world/voice/speech.json'), 'utf8')) as {
    utterances: { audio: { file: string; mime: string }[] }[];
  };
  for (const utterance of speech.utterances) utterance.audio = [{ file: '../../secret.opus', mime: 'audio/ogg' }];
  const eml = readFileSync(join(import.meta.dirname, '../../assets/stories/hello-world/story.eml'), 'utf8');
  const entity = `<!DOCTYPE eml [<!ENTITY x SYSTEM "/test/secret.txt">]>\n${eml.replace(/<\?xml[^>]*\?>/, '')}`;
  await open(stage, { 'story.eml': entity, 'voice/speech.json': JSON.stringify(speech), 'secret.txt': 'no', 'secret.opus': 'no' });
  await stage.ready();
  await stage.play();
  await stage.until(0.5);
  expect(asked.filter((path) => path.includes('secret'))).toEqual([]);
});

/** Activities that an instance reports for a trap, with the text that the error must contain. */
const TRAPS: readonly (readonly [doing: number, named: RegExp])[] = [
  [1, /reading the figure \/assets\/figures\/sofia\.glb: unreachable/],
  [2, /reading the story \/assets\/stories\/hello-world\/story\.eml: unreachable/],
  [3, /reading the speech \/assets\/stories\/hello-world\/voice\/speech\.json: unreachable/],
  [4, /planning the performance of the story \/assets\/stories\/hello-world\/story\.eml: unreachable/],
];

test('a trap names what was being read, and its file', async ({ stage, page }) => {
  await page.addInitScript(() => {
    // No code is known to trap, so this test makes loading a story trap.
    const { instantiate } = WebAssembly;
    WebAssembly.instantiate = (async (source: WebAssembly.Module, imports?: WebAssembly.Imports) => {
      const made = (await instantiate.call(WebAssembly, source, imports)) as unknown as WebAssembly.Instance;
      if (made.exports['player_load'] === undefined) return made;
      const trap = () => {
        throw new WebAssembly.RuntimeError('unreachable');
      };
      const doing = () => Number(new URLSearchParams(document.querySelector('raconteur-player')?.getAttribute('src')?.split('?')[1]).get('doing'));
      return Object.create(WebAssembly.Instance.prototype, { exports: { value: { ...made.exports, player_load: trap, doing } } }) as WebAssembly.Instance;
    }) as typeof WebAssembly.instantiate;
    // Nothing is rendered before the trap.
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await stage.open('<raconteur-player assets="/assets/"></raconteur-player>');
  for (const [doing, named] of TRAPS) {
    await stage.player.evaluate((p: RaconteurPlayer, n) => void (p.src = `/assets/stories/hello-world/story.eml?doing=${n}`), doing);
    await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.error?.message ?? '')).toMatch(named);
  }
});

/** Loses the graphics context, like a driver reset. */
async function loseThePicture(stage: Stage): Promise<void> {
  await stage.player.evaluate((p) => {
    const canvas = p.shadowRoot?.querySelector('canvas');
    const gl = p.getAttribute('backend') === 'webgl' ? canvas?.getContext('webgl2') : null;
    gl?.getExtension('WEBGL_lose_context')?.loseContext();
    if (gl == null) for (const device of window.record.devices) device.destroy();
  });
}

test('a lost picture comes back while the story goes on', { tag: '@draws' }, async ({ stage, page }) => {
  await stage.load('white-rabbit');
  await stage.play();
  await stage.until(1);
  const old = await stage.player.locator('canvas').elementHandle();
  await loseThePicture(stage);
  await expect(stage.player.locator('[part~=picture-lost]')).toBeVisible();
  const at = await stage.time();
  await stage.until(at + 0.3);
  await expect(stage.player.locator('[part~=picture-lost]')).toHaveCount(0, { timeout: 60_000 });
  const now = await stage.player.locator('canvas').elementHandle();
  expect(await page.evaluate(([a, b]) => a === b, [old, now])).toBe(false);
  expect((await stage.picture()).spread).toBeGreaterThan(8);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(false);
  // No word was spoken twice.
  const words = await page.evaluate(() => window.record.events.filter((e) => e.type === 'word').map((e) => e.detail as { index: number; utterance: number }));
  expect(new Set(words.map((w) => `${w.utterance}.${w.index}`)).size).toBe(words.length);
});

test('without any picture the story is heard and captioned, and the user may ask again', { tag: '@draws' }, async ({ stage, page }) => {
  await page.addInitScript(() => {
    const context = HTMLCanvasElement.prototype.getContext;
    const fake = { broken: true };
    Object.assign(window, { fake });
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: Parameters<typeof context>) {
      return fake.broken ? null : context.apply(this, args);
    } as typeof context;
  });
  await stage.load('hello-world');
  const note = stage.player.locator('[part~=picture-lost]');
  await expect(note).toContainText('sound and captions');
  await stage.play();
  await page.waitForFunction(() => window.record.events.some((e) => e.type === 'word'));
  expect(await page.evaluate(() => window.record.contexts.map((c) => c.state))).toEqual(['running']);
  await page.evaluate(() => void ((window as unknown as { fake: { broken: boolean } }).fake.broken = false));
  await note.getByRole('button', { name: 'Restore it' }).click();
  await expect(note).toHaveCount(0, { timeout: 60_000 });
  expect((await stage.picture()).spread).toBeGreaterThan(8);
});
