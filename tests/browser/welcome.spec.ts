/** Tests before playback: the waiting figure is animated, and the story selects it. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, ready, test, type Stage } from './stage.js';

const current = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.currentFigure);
const told = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => d.code === 'figure-unusable').map((d) => d.severity));
const shown = (stage: Stage) => expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.statistics?.firstFrameMs ?? 0), { timeout: 60_000 }).toBeGreaterThan(0);

/** Returns the canvas only, without transient overlays. */
async function look(stage: Stage): Promise<Buffer> {
  await stage.player.evaluate((p: RaconteurPlayer) => {
    const canvas = p.shadowRoot?.querySelector('canvas') ?? null;
    for (const e of p.shadowRoot?.querySelectorAll<HTMLElement>('*') ?? []) if (!e.contains(canvas)) e.style.opacity = '0';
  });
  return (await stage.picture()).png;
}

const story = (performer: string) => `<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer ${performer}/></head><body><null time='9'/></body></eml>`;

test('before play the figure moves, and the story does not', async ({ stage, page }) => {
  await stage.load('hello-world');
  await shown(stage);
  const first = await look(stage);
  await expect.poll(async () => await stage.difference(first, await look(stage)), { timeout: 60_000 }).toBeGreaterThan(0.05);
  expect(await stage.time()).toBe(0);
  expect(await page.evaluate(() => window.record.events.filter(({ type }) => ['word', 'clause', 'timeupdate', 'play'].includes(type)))).toEqual([]);
  // The frame of a seek is shown and stays.
  await stage.seek(0);
  const sought = await look(stage);
  await page.waitForTimeout(1500);
  expect(await stage.difference(sought, await look(stage))).toBeLessThan(0.01);
  await stage.play();
  await stage.until(0.5);
});

test('with reduced motion it stands still', async ({ stage, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await stage.load('hello-world');
  await shown(stage);
  const first = await look(stage);
  await page.waitForTimeout(2500);
  expect(await stage.difference(first, await look(stage))).toBeLessThan(0.01);
});

test('the story chooses its figure, and the page has the last word', async ({ stage }) => {
  await stage.open('<raconteur-player src="story.eml"></raconteur-player>', {
    'story.eml': story("figure='papous'"),
    'other.eml': story("figure='nuno'"),
    'plain.eml': story("gaze='1'"),
  });
  await ready(stage.player);
  expect(await current(stage)).toBe('papous');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.figure)).toBeUndefined();
  for (const [src, figure] of [
    ['other.eml', 'nuno'],
    ['plain.eml', 'sofia'],
  ] as const) {
    await stage.player.evaluate((p: RaconteurPlayer, address) => void (p.src = address), src);
    await expect.poll(() => current(stage), { timeout: 60_000 }).toBe(figure);
  }
  await stage.player.evaluate((p: RaconteurPlayer) => p.setAttribute('figure', 'papous'));
  await expect.poll(() => current(stage), { timeout: 60_000 }).toBe('papous');
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.src = 'other.eml'));
  await ready(stage.player);
  expect(await current(stage)).toBe('papous');
  await stage.player.evaluate((p: RaconteurPlayer) => p.removeAttribute('figure'));
  await expect.poll(() => current(stage), { timeout: 60_000 }).toBe('nuno');
  // A text on the stage chooses, too.
  await stage.player.evaluate((p: RaconteurPlayer, text) => p.rehearse(text), story("figure='papous'"));
  await expect.poll(() => current(stage), { timeout: 60_000 }).toBe('papous');
  expect(await told(stage)).toEqual([]);
});

test('where the choice cannot be had, the usual figure performs', async ({ stage }) => {
  const files = { 'a.eml': story("figure='nobody'"), 'b.eml': story("figure='bad.glb'"), 'bad.glb': 'no figure' };
  await stage.open('<raconteur-player src="a.eml"></raconteur-player>', files);
  for (const src of ['a.eml', 'b.eml']) {
    await stage.player.evaluate((p: RaconteurPlayer, address) => void (p.src = address), src);
    await expect.poll(() => told(stage), { timeout: 60_000 }).toEqual(['warning']);
    await ready(stage.player);
    expect(await current(stage)).toBe('sofia');
    expect(await stage.player.evaluate((p: RaconteurPlayer) => p.error)).toBeNull();
  }
});
