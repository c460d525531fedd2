/** Tests of the performing figure: changing it, and errors of unusable ones. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test, type Stage } from './stage.js';

const figures = join(import.meta.dirname, '../../assets/figures');
const sofia = readFileSync(join(figures, 'sofia.glb'));

/** Returns the image without the fade-in of a new one; the first arrives some time after the story is ready. */
async function look(stage: Stage): Promise<Buffer> {
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.statistics?.firstFrameMs ?? 0), { timeout: 60_000 }).toBeGreaterThan(0);
  // Only the canvas counts, because notices and controls appear and disappear over it.
  await stage.player.evaluate((p: RaconteurPlayer) => {
    const canvas = p.shadowRoot?.querySelector('canvas') ?? null;
    for (const e of p.shadowRoot?.querySelectorAll<HTMLElement>('*') ?? []) {
      if (!e.contains(canvas)) e.style.opacity = '0';
    }
  });
  // A frame that stays still is rendered again at full resolution.
  let png = (await stage.picture()).png;
  await expect
    .poll(
      async () => {
        const last = png;
        png = (await stage.picture()).png;
        return await stage.difference(last, png);
      },
      { timeout: 20_000, intervals: [700] },
    )
    .toBeLessThan(0.01);
  return png;
}

const set = (stage: Stage, figure: string) => stage.player.evaluate((p: RaconteurPlayer, f) => void (p.figure = f), figure);
const current = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.currentFigure);
const trouble = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => d.code === 'figure-unusable').map((d) => d.message));

async function open(stage: Stage, files: { [path: string]: string | Buffer }): Promise<void> {
  await stage.open('<raconteur-player src="/assets/stories/hello-world/story.eml" controls captions></raconteur-player>', files);
  await stage.ready();
  // The figure moves before anybody has played or sought.
  await stage.seek(0);
}

/** Returns a GLB with a given JSON chunk. */
function glb(json: object): Buffer {
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const head = Buffer.alloc(20);
  head.write('glTF');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + padded.length, 8);
  head.writeUInt32LE(padded.length, 12);
  head.write('JSON', 16);
  return Buffer.concat([head, padded]);
}

test('another figure takes the stage while the story goes on', { tag: '@draws' }, async ({ stage }) => {
  await stage.load('white-rabbit');
  await stage.seek(6);
  const before = await look(stage);
  await set(stage, 'papous');
  // The one before stays until the next is ready.
  expect(['sofia', 'papous']).toContain(await current(stage));
  await expect.poll(() => current(stage), { timeout: 60_000 }).toBe('papous');
  expect(await stage.time()).toBe(6);
  expect(await stage.difference(before, await look(stage))).toBeGreaterThan(1);
  await set(stage, 'sofia');
  await expect.poll(() => current(stage), { timeout: 60_000 }).toBe('sofia');
  expect(await stage.difference(before, await look(stage))).toBeLessThan(0.05);
  expect(await trouble(stage)).toEqual([]);
});

test('a broken figure is named with its fault, and the one before stays', async ({ stage }) => {
  const broken: { [path: string]: string | Buffer } = {
    'magic.glb': 'Dear diary, this is no figure.',
    'cut.glb': sofia.subarray(0, Math.floor(sofia.length / 2)),
    'json.glb': Buffer.concat([sofia.subarray(0, 20), Buffer.from('{'.repeat(40)), sofia.subarray(60)]),
    'empty.glb': glb({ asset: { version: '2.0' } }),
    'draco.glb': glb({
      asset: { version: '2.0' },
      extensionsUsed: ['KHR_draco_mesh_compression'],
      extensionsRequired: ['KHR_draco_mesh_compression'],
    }),
  };
  await open(stage, broken);
  const before = await look(stage);
  for (const name of [...Object.keys(broken), 'absent.glb']) {
    await set(stage, name);
    await expect.poll(async () => (await trouble(stage)).at(-1) ?? '', { timeout: 60_000 }).toContain(name);
    expect(await current(stage)).toBe('sofia');
  }
  const messages = await trouble(stage);
  expect(messages).toHaveLength(6);
  expect(new Set(messages).size).toBe(6);
  expect(messages.find((m) => m.includes('draco.glb'))).toMatch(/draco/i);
  expect(messages.at(-1)).toContain('not found');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.error)).toBeNull();
  expect(await stage.difference(before, await look(stage))).toBeLessThan(0.05);
  await expect(stage.player.getByRole('status')).toContainText('absent.glb');
  // The story plays on with the figure that is left.
  await stage.play();
  await stage.until(0.5);
});

test('the first picture is measured', { tag: '@draws' }, async ({ stage, page }) => {
  // A visit before has warmed the server and the cache.
  await stage.load('white-rabbit');
  await stage.load('white-rabbit');
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.statistics?.firstFrameMs ?? 0), { timeout: 60_000 }).toBeGreaterThan(0);
  const statistics = await stage.player.evaluate((p: RaconteurPlayer) => p.statistics);
  const fetched = await page.evaluate(() =>
    performance.getEntriesByType('resource').map((e) => {
      const { name, decodedBodySize } = e as PerformanceResourceTiming;
      return { file: name.split('/').at(-1), bytes: decodedBodySize };
    }),
  );
  console.log(stage.backend, JSON.stringify({ ...statistics, fetched }, null, 1));
  expect(statistics?.drawCalls).toBeGreaterThan(0);
  expect(statistics?.bytes.figure).toBe(sofia.length);
});
