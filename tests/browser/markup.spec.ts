/** Tests that the element leaves the page's markup as written, and stays the same for keyboards and screen readers. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story, voiceFiles } from './fixture.js';
import { expect, test } from './stage.js';

const made = [{ text: 'One two three', msec: 3000 }];
const files = { 'story.eml': story("<voice-text time='0'>One two three</voice-text>"), ...voiceFiles(made) };
const player = (attributes = '') => `<raconteur-player src="story.eml" quality="lowest" loading="eager" ${attributes}></raconteur-player>`;

/** The markup of the player as the server sent it. */
const served = (page: Page) =>
  page.evaluate(async () => {
    const text = await (await fetch(location.href)).text();
    return /<raconteur-player.*<\/raconteur-player>/.exec(text)?.[0];
  });

/** Returns the player's accessibility tree: the roles and names of all named nodes, in order. */
async function tree(page: Page): Promise<string[]> {
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  await session.detach();
  return nodes.filter(({ ignored }) => !ignored).map(({ role, name }) => `${role?.value} ${name?.value ?? ''}`.trim());
}

test('loaded, played and set, the player has the markup that the server sent, and so has its clone', async ({ stage, page }) => {
  await stage.open(player('controls="" captions="" label="Counting" playback-rate="1.5"'), files);
  const markup = await served(page);
  await stage.ready();
  await stage.play();
  await stage.until(0.3);
  const clones = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    Object.assign(p, {
      volume: 0.5,
      playbackRate: 2,
      captions: false,
      remarks: true,
      quality: 'low',
      label: 'Other',
      handedness: 'left',
      speech: 'here',
      poster: 'poster.png',
      mind: undefined,
    });
    p.muted = true;
    p.focus();
    await p.updateComplete;
    return [p, p.cloneNode(true), p.cloneNode(false)].map((node) => (node as Element).outerHTML);
  });
  expect(clones).toEqual([markup, markup, markup]);
});

test('a player that a script makes has no attribute but those that a media element writes', async ({ stage, page }) => {
  await stage.open('<main></main>', files);
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  const written = await page.evaluate(async () => {
    const p = document.createElement('raconteur-player');
    const first = p.outerHTML;
    document.querySelector('main')?.append(p);
    await p.updateComplete;
    const placed = p.outerHTML;
    Object.assign(p, { src: 'story.eml', preload: 'none', crossOrigin: 'anonymous', autoplay: true, controls: true, loop: true, defaultMuted: true, figure: 'sofia' });
    await p.updateComplete;
    const names = p.getAttributeNames().sort();
    p.remove();
    return [first, placed, names];
  });
  const bare = '<raconteur-player></raconteur-player>';
  expect(written).toEqual([bare, bare, ['autoplay', 'controls', 'crossorigin', 'loop', 'muted', 'preload', 'src']]);
});

test('screen readers are told that it is a region of its label, or what the author says', async ({ stage, page }) => {
  await stage.open(`<main>${player('label="Counting"')}</main>`, files);
  await expect.poll(() => tree(page)).toContain('region Counting');
  await stage.player.evaluate((p: RaconteurPlayer) => (p.label = 'Counting again'));
  await expect.poll(() => tree(page)).toContain('region Counting again');
  await stage.player.evaluate((p) => {
    p.setAttribute('role', 'figure');
    p.setAttribute('aria-label', 'An abacus');
  });
  await expect.poll(() => tree(page)).toContain('figure An abacus');
  expect(await tree(page)).not.toContain('region Counting again');
});

test('tab, click and focus() lead to what takes the keys', async ({ stage, page }) => {
  await stage.open(`<button>Before</button>${player('controls')}<button>After</button>`, files);
  await stage.ready();
  const focused = () => page.evaluate(() => [document.activeElement?.localName ?? '', document.activeElement?.shadowRoot?.activeElement?.className ?? '']);
  const frame = ['raconteur-player', 'frame'];
  await stage.player.focus();
  expect(await focused()).toEqual(frame);
  const muted = () => stage.player.evaluate((p: RaconteurPlayer) => p.muted);
  await page.keyboard.press('m');
  expect(await muted()).toBe(true);
  await page.getByRole('button', { name: 'Before' }).focus();
  await page.keyboard.press('Tab');
  expect(await focused()).toEqual(frame);
  // The focus ring is visible, because nothing else shows the keyboard focus.
  expect(await stage.player.locator('.frame').evaluate((e) => getComputedStyle(e, '::after').borderTopWidth)).toBe('3px');
  await page.keyboard.press('Shift+Tab');
  expect((await focused())[0]).toBe('button');
  await stage.play();
  await stage.pause();
  await stage.player.click({ position: { x: 20, y: 40 } });
  expect(await focused()).toEqual(frame);
  await page.keyboard.press('m');
  expect(await muted()).toBe(false);
  // Also in the script that puts it into the page.
  const made = await page.evaluate(() => {
    const p = document.createElement('raconteur-player');
    document.body.append(p);
    p.focus();
    return document.activeElement === p;
  });
  expect(made).toBe(true);
});

test('a tabindex of the author stays: a negative one takes the player out of the order of tabs', async ({ stage, page }) => {
  await stage.open(`<button>Before</button>${player('tabindex="-1"')}<button>After</button>`, files);
  await stage.ready();
  await page.getByRole('button', { name: 'Before' }).focus();
  await page.keyboard.press('Tab');
  await expect(page.getByRole('button', { name: 'After' })).toBeFocused();
  await stage.player.focus();
  expect(await page.evaluate(() => document.activeElement?.localName)).toBe('raconteur-player');
  await expect(stage.player).toHaveAttribute('tabindex', '-1');
});
