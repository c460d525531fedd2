/** Tests of guarantees for a page that embeds a player. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { sized } from '../../web/test/tier.js';
import { serveElsewhere } from './elsewhere.js';
import { story, voiceFiles } from './fixture.js';
import { expect, ready, test, type Stage } from './stage.js';

declare global {
  interface Window {
    away: RaconteurPlayer;
  }
}

/** Number of times that a player is removed from its page. */
const TIMES = sized(8, 20);

/** Minimum width and height of a pointer target (WCAG 2.2, 2.5.8). */
const MIN_TARGET = 24;

const SECS = 3;
const made = [{ text: 'One two three', msec: 1000 * SECS }];
const files = { 'story.eml': story("<voice-text time='0'>One two three</voice-text>"), ...voiceFiles(made) };
const player = (attributes = '') => `<raconteur-player src="story.eml" quality="lowest" loading="eager" label="Counting" ${attributes}></raconteur-player>`;

test('in a sandboxed frame of another server it plays, and asks nobody else', async ({ stage, page }) => {
  const frame = `<!doctype html><html lang="en"><meta charset="utf-8"><title>Frame</title><script type="module" src="/player/raconteur-player.js"></script>
    <body><raconteur-player src="/story.eml" backend="${stage.backend}" speech="browser" quality="lowest" loading="eager" controls></raconteur-player></body></html>`;
  const { origin, close } = await serveElsewhere({ '/frame.html': frame, '/story.eml': story("<null time='1.5'/>") });
  const asked = new Set<string>();
  page.on('request', (request) => asked.add(new URL(request.url()).origin));
  try {
    await page.context().grantPermissions(['local-network-access']);
    await stage.open(`<iframe sandbox="allow-scripts" allow="autoplay" src="${origin}/frame.html" width="400" height="300" title="Frame"></iframe>`, files, '', false);
    const inside = page.frameLocator('iframe').locator('raconteur-player');
    await ready(inside);
    // The frame has an opaque origin, so nothing can be stored: cookies and databases are
    // unavailable.
    expect(await inside.evaluate(() => self.origin)).toBe('null');
    await page.frameLocator('iframe').getByRole('button', { name: 'Play the story' }).click();
    await expect.poll(() => inside.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
    expect((await stage.picture(inside)).spread).toBeGreaterThan(4);
    // URLs that scripts create do not belong to a server.
    asked.delete('null');
    expect([...asked].sort()).toEqual([origin, new URL(page.url()).origin].sort());
  } finally {
    close();
  }
});

test('320 pixels have room for every control', async ({ stage, page }) => {
  await page.setViewportSize({ width: 320, height: 480 });
  const css = 'raconteur-player { width: 100% } body { margin: 0 }';
  await stage.open(`<main><h1>A page</h1>${player('controls captions')}</main>`, { ...files, 'test.css': css });
  await stage.ready();
  await stage.play();
  const boxes = await stage.player.evaluate((p: RaconteurPlayer) => {
    const box = (element: Element) => {
      const { left, right, width, height } = element.getBoundingClientRect();
      return { name: element.getAttribute('part'), left, right, width, height };
    };
    return [...(p.shadowRoot?.querySelectorAll('.bar :is(button, input, select)') ?? [])].map(box).filter(({ width }) => width > 0);
  });
  expect(boxes.length).toBeGreaterThanOrEqual(5);
  expect(boxes.filter(({ left, right, height }) => left < 0 || right > 320 || height < MIN_TARGET)).toEqual([]);
  expect(boxes.filter(({ width }) => width < MIN_TARGET)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(320);
});

/** Stops or resumes the browser's rendering. */
const hide = (page: Page, hidden: boolean) =>
  page.evaluate((is) => {
    Object.defineProperty(document, 'hidden', { value: is, configurable: true });
    Object.defineProperty(document, 'visibilityState', { value: is ? 'hidden' : 'visible', configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  }, hidden);

test('in a hidden tab the story goes on to its end', async ({ stage, page }) => {
  await page.addInitScript(() => {
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => request((ms) => (document.hidden ? void window.requestAnimationFrame(callback) : callback(ms)));
  });
  await stage.open(player('controls'), files);
  await stage.ready();
  await stage.play();
  await hide(page, true);
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
  const words = await page.evaluate(() => window.record.events.filter(({ type }) => type === 'word').map(({ detail }) => (detail as { word: { text: string } }).word.text));
  expect(words).toEqual(['One', 'two', 'three']);
  await hide(page, false);
  await stage.seek(0);
  await stage.play();
  await stage.until(0.5);
});

test('it is printed with its picture, and without what nobody can press on paper', async ({ stage, page }) => {
  await stage.open(player('controls captions'), files);
  await stage.ready();
  await stage.play();
  await stage.until(0.3);
  await stage.pause();
  await page.emulateMedia({ media: 'print' });
  expect((await stage.picture()).spread).toBeGreaterThan(4);
  await expect(stage.player.locator('[part~=controls]')).toBeHidden();
  await expect(stage.player.locator('[part~=big-play]')).toBeHidden();
  await expect(stage.player.locator('[part~=captions]')).toBeVisible();
  await page.emulateMedia({ media: 'screen' });
  await expect(stage.player.locator('[part~=controls]')).toBeVisible();
});

test(`it is taken out and put back ${TIMES} times, in play and at rest`, { tag: '@draws' }, async ({ stage }) => {
  test.setTimeout(300_000);
  await stage.open(`<main>${player()}</main>`, files);
  await stage.ready();
  const told = await stage.player.evaluate(async (p: RaconteurPlayer, times) => {
    const main = p.parentElement;
    const all: { paused: boolean; error: unknown; ready: number; moved: number; awaySecs: number }[] = [];
    for (let i = 0; i < times; i++) {
      if (i % 2 === 0) await p.play();
      else p.currentTime = 0.2 + (i % 7) * 0.1;
      const before = p.currentTime;
      const beganMs = performance.now();
      p.remove();
      // Some return within the same script, as when a list is sorted, some much later.
      if (i % 3 > 0) await new Promise((done) => setTimeout(done, 20 * (i % 3)));
      const { readyState } = p;
      const moved = Math.abs(p.currentTime - before);
      const awaySecs = (performance.now() - beganMs) / 1000;
      main?.append(p);
      if (p.readyState < 4) await new Promise((done) => p.addEventListener('canplaythrough', done, { once: true }));
      all.push({ paused: p.paused, error: p.error, ready: readyState, moved, awaySecs });
    }
    return all;
  }, TIMES);
  expect(told.filter(({ error }) => error !== null)).toEqual([]);
  // Like a video, the player keeps its story and its position, and pauses if it was detached for
  // longer than a script runs.
  for (const [i, { ready, moved, paused, awaySecs }] of told.entries()) {
    expect(ready, `${i}`).toBe(4);
    // It continues for a moment, which is longer if frames take long.
    expect(moved, `${i}`).toBeLessThan(awaySecs + 0.1);
    if (i % 3 > 0) expect(paused, `${i}`).toBe(true);
  }
  await stage.play();
  await stage.until(0.5);
  expect((await stage.picture()).spread).toBeGreaterThan(4);
});

test('out of its page for longer it gives back what it holds, and goes on where it was when it is put back', async ({ stage, page }) => {
  await stage.open(`<main>${player()}</main>`, files);
  await stage.ready();
  await stage.play();
  await stage.until(0.5);
  const at = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    window.away = p;
    p.remove();
    await new Promise((done) => p.addEventListener('emptied', done, { once: true }));
    return [p.currentTime, p.readyState];
  });
  expect(at[0]).toBeGreaterThan(0.5);
  expect(at[1]).toBe(0);
  await page.evaluate(() => document.querySelector('main')?.append(window.away));
  await stage.ready();
  expect(await stage.time()).toBe(at[0]);
  await stage.play();
  await stage.until((at[0] ?? 0) + 0.2);
});

/** States of a player, with the steps that produce them. */
const STATES: { readonly [name: string]: (stage: Stage, page: Page) => Promise<void> } = {
  'without a story': async (stage) => {
    await stage.open('<main><h1>A page</h1><raconteur-player controls label="None"></raconteur-player></main>', files);
  },
  'before it is fetched': async (stage) => {
    await stage.open(`<main><h1>A page</h1>${player('controls preload="none"')}</main>`, files);
    await expect(stage.player.getByRole('button', { name: 'Play the story' })).toBeVisible();
  },
  'being fetched': async (stage, page) => {
    await page.route('**/slow.eml', () => undefined);
    await stage.open(`<main><h1>A page</h1>${player('controls').replace('story.eml', '/slow.eml')}</main>`, files);
    await expect(stage.player.getByRole('progressbar')).toBeVisible();
  },
  ready: async (stage) => {
    await stage.open(`<main><h1>A page</h1>${player('controls captions')}</main>`, files);
    await stage.ready();
  },
  'in play': async (stage) => {
    await STATES['ready']?.(stage, stage.page);
    await stage.play();
    await stage.until(0.5);
    await expect(stage.player.locator('[part~=captions]')).toBeVisible();
  },
  ended: async (stage) => {
    await STATES['ready']?.(stage, stage.page);
    await stage.seek(SECS - 0.1);
    await stage.play();
    await expect(stage.player.getByRole('button', { name: 'Play the story again' })).toBeVisible();
  },
  'with remarks': async (stage) => {
    await stage.open(`<main><h1>A page</h1>${player('controls remarks')}</main>`, { 'story.eml': story("<nonsense time='1'/><null time='3'/>") });
    await stage.ready();
    await stage.player.locator('[part~=diagnostics] summary').click();
  },
  'that cannot be had': async (stage) => {
    await stage.open(`<main><h1>A page</h1>${player('controls')}</main>`, { 'story.eml.gone': '' });
    await expect(stage.player.getByRole('alert')).toBeVisible({ timeout: 60_000 });
  },
  'whose picture is lost': async (stage, page) => {
    await page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
    await STATES['ready']?.(stage, page);
    await expect(stage.player.locator('[part~=picture-lost]')).toBeVisible({ timeout: 60_000 });
  },
};

for (const [name, reach] of Object.entries(STATES)) {
  test(`a story ${name} has no barriers`, async ({ stage, page }) => {
    await reach(stage, page);
    // Axe puts scripts into the page, which its policy forbids.
    const { violations } = await new AxeBuilder({ page }).analyze();
    expect(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ')).join('; ')}`)).toEqual([]);
  });
}
