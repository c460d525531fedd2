/** Tests that a player can exist, without function, in documents that lack browser features, like those of jsdom and happy-dom. */

import { expect, test } from './stage.js';

/** Features missing there, and others that an older browser may lack. */
const LACKING = ['ResizeObserver', 'IntersectionObserver', 'matchMedia', 'Worker', 'AudioContext', 'MessageChannel', 'OffscreenCanvas'];

test('imported, made, put into the page, changed and taken out, it throws nothing', async ({ stage, page }) => {
  const told: string[] = [];
  page.on('console', (message) => message.type() === 'error' && told.push(message.text()));
  await page.addInitScript((names) => {
    for (const name of names) delete (window as unknown as Record<string, unknown>)[name];
    for (const [of, name] of [
      [HTMLElement, 'attachInternals'],
      [Document, 'adoptedStyleSheets'],
      [ShadowRoot, 'adoptedStyleSheets'],
      [CSSStyleSheet, 'replaceSync'],
      [HTMLCanvasElement, 'captureStream'],
    ] as const) {
      delete (of.prototype as unknown as Record<string, unknown>)[name];
    }
    Object.defineProperty(HTMLCanvasElement.prototype, 'getContext', { value: () => null });
  }, LACKING);
  // The styles are between the tags, which the policy of the real page forbids.
  await stage.open('<main></main>', {}, '', false);
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  const states = await page.evaluate(async () => {
    const p = document.createElement('raconteur-player');
    p.setAttribute('figure', 'sofia');
    document.querySelector('main')?.append(p);
    await p.updateComplete;
    p.setAttribute('controls', '');
    p.setAttribute('autoplay', '');
    p.setAttribute('src', 'absent.eml');
    p.textContent = 'A text';
    p.label = 'Other';
    p.focus();
    await p.updateComplete;
    p.currentTime = 1;
    p.pause();
    p.remove();
    p.removeAttribute('src');
    document.querySelector('main')?.append(p);
    await p.updateComplete;
    await new Promise((done) => setTimeout(done, 100));
    p.remove();
    await new Promise((done) => setTimeout(done, 100));
    return [p.paused, p.readyState, p.buffered.length];
  });
  expect(states).toEqual([true, 0, 0]);
  expect(told).toEqual([]);
});
