/** Tests of hundreds of stories on one page: the graphics resources of each are released. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { sized } from '../../web/test/tier.js';
import { story } from './fixture.js';
import { expect, test } from './stage.js';

const CHANGES = sized(16, 300);
const PLAYERS = sized(6, 50);

declare global {
  interface Window {
    /** Contexts of WebGL. */
    contexts: WebGL2RenderingContext[];
  }
}

/** Runs before the page's own scripts: notes each context of WebGL, of which a browser has only some. */
function listen(): void {
  window.contexts = [];
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: Parameters<typeof get>) {
    const context = get.apply(this, args);
    if (context instanceof WebGL2RenderingContext && !window.contexts.includes(context)) window.contexts.push(context);
    return context;
  } as typeof get;
}

/** Returns the number of devices and contexts created up to now, and the number still in existence. */
function graphics(page: Page): Promise<{ made: number; held: number }> {
  return page.evaluate(async () => {
    const gone = await Promise.all(
      window.record.devices.map((d) => Promise.race([(d as unknown as { lost: Promise<unknown> }).lost.then(() => true), new Promise((done) => setTimeout(done, 50, false))])),
    );
    const lost = [...gone, ...window.contexts.map((context) => context.isContextLost())];
    return { made: lost.length, held: lost.filter((is) => !is).length };
  });
}

/** Runs before the page's own scripts: provides the stories immediately, since fetching is not tested here. */
function serve(files: { [path: string]: string }): void {
  const own = window.fetch;
  window.fetch = (input, init) => {
    const { pathname } = new URL(input instanceof Request ? input.url : input, document.baseURI);
    if (!pathname.startsWith('/test/s')) return own(input, init);
    const file = files[pathname.replace('/test/', '')];
    return Promise.resolve(file === undefined ? new Response('', { status: 404 }) : new Response(file));
  };
}

const files = Object.fromEntries(
  Array.from({ length: 7 }, (_, i) => [`s${i}/story.eml`, story(`<voice-text time='0'>This is story number ${i} of seven.</voice-text><null time='${4 + i}'/>`)]),
);
const small = { 'test.css': 'raconteur-player { width: 64px; height: 48px; aspect-ratio: auto }' };

test(`${CHANGES} changes of story, with seeks at rest and in play, need one device`, { tag: '@draws' }, async ({ stage, page }) => {
  test.setTimeout(600_000);
  await page.addInitScript(listen);
  await page.addInitScript(serve, files);
  await stage.open('<raconteur-player src="s0/story.eml" quality="lowest" loading="eager"></raconteur-player>', small);
  await stage.ready();
  for (let from = 0; from < CHANGES; from += 10) {
    const durations = await stage.player.evaluate(async (p: RaconteurPlayer, first) => {
      const frame = () => new Promise(requestAnimationFrame);
      const durations: number[] = [];
      for (let i = first; i < first + 10; i++) {
        await new Promise((done, fail) => {
          p.addEventListener('canplay', done, { once: true });
          p.addEventListener('error', () => fail(p.error ?? new Error('failed')), { once: true });
          p.src = `s${i % 7}/story.eml?${i}`;
        });
        p.currentTime = (i % 5) * 0.7;
        if (i % 10 === 3) {
          await p.play();
          p.currentTime = 2.5;
          await frame();
        }
        durations.push(Math.round(p.duration));
      }
      return durations;
    }, from);
    expect(durations).toEqual(Array.from({ length: 10 }, (_, i) => 4 + ((from + i) % 7)));
    // One that is not used again would be a second one by now.
    expect(await graphics(page)).toEqual({ made: 1, held: 1 });
  }
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.statistics?.drawCalls ?? 0)).toBeGreaterThan(0);
});

test(`${PLAYERS} players that come and go, at any moment of their loading, leave nothing behind`, { tag: '@draws' }, async ({ stage, page }) => {
  test.setTimeout(600_000);
  await page.addInitScript(listen);
  await page.addInitScript(serve, files);
  await stage.open('<main></main><raconteur-player id="model" src="s0/story.eml" quality="lowest"></raconteur-player>', {
    'test.css': `${small['test.css']} #model { display: none }`,
  });
  for (let from = 0; from < PLAYERS; from += 10) {
    await page.evaluate(async (first) => {
      const model = document.querySelector('#model');
      const main = document.querySelector('main');
      for (let i = first; i < first + 10; i++) {
        const player = document.createElement('raconteur-player');
        for (const name of ['backend', 'assets', 'quality']) player.setAttribute(name, model?.getAttribute(name) ?? '');
        player.loading = 'eager';
        player.src = `s${i % 7}/story.eml`;
        main?.append(player);
        if (i % 10 === 9) {
          await new Promise((done) => player.addEventListener('canplay', done, { once: true }));
          await player.play();
        } else {
          await new Promise((done) => setTimeout(done, (i % 10) * 40));
        }
        player.remove();
      }
    }, from);
    await expect.poll(async () => (await graphics(page)).held, { timeout: 60_000 }).toBe(0);
  }
  expect((await graphics(page)).made).toBeGreaterThanOrEqual(PLAYERS / 10);
});
