/** No task keeps a page from answering while a story plays: what the player computes is short, beside what is drawn. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test } from './stage.js';

/** More of a task is long (Long Tasks API), and is felt. */
const LONG_MS = 50;

test('no task in play is longer than 50 ms, with drawing taken out', async ({ stage, page }) => {
  test.setTimeout(180_000);
  await page.addInitScript(() => {
    // A processor that draws instead of a graphics card keeps all else waiting: nothing is drawn, all else is done.
    for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced', 'clear', 'clearBufferfv', 'blitFramebuffer', 'generateMipmap'] as const) {
      Object.defineProperty(WebGL2RenderingContext.prototype, name, { value: () => undefined });
    }
    const tasks: { startTime: number; duration: number }[] = [];
    new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({ startTime, duration }) => ({ startTime, duration })))).observe({ type: 'longtask', buffered: true });
    Object.assign(window, { tasks });
  });
  await stage.open(
    '<main><h1>A page</h1><raconteur-player src="/assets/stories/white-rabbit/story.eml" loading="eager" label="The rabbit" controls captions></raconteur-player></main>',
  );
  await stage.ready();
  const found = await stage.player.evaluate(async (player: RaconteurPlayer) => {
    player.muted = true;
    await player.play();
    // What comes with the first picture of all that moves is there.
    await new Promise((done) => setTimeout(done, 1500));
    const from = performance.now();
    await new Promise((done) => setTimeout(done, 20_000));
    player.pause();
    const to = performance.now();
    // A long one is seen.
    while (performance.now() < to + 80);
    await new Promise((done) => setTimeout(done, 500));
    const { tasks } = window as unknown as { tasks: { startTime: number; duration: number }[] };
    const { totalVideoFrames } = player.getVideoPlaybackQuality();
    const isOwn = ({ startTime, duration }: { startTime: number; duration: number }) => startTime + duration > to + 10;
    return { tasks: tasks.filter((task) => task.startTime > from && !isOwn(task)), own: tasks.filter(isOwn), pictures: totalVideoFrames };
  });
  // It was looked at, and the story was performed.
  expect(found.pictures).toBeGreaterThan(100);
  expect(found.own.length).toBeGreaterThan(0);
  expect(found.tasks.filter(({ duration }) => duration > LONG_MS)).toEqual([]);
});
