/** Tests that no task blocks a page during playback: the player's computations are short, compared with rendering and driver compilation. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test } from './stage.js';

/** Duration from which a task is long (Long Tasks API), and perceptible, milliseconds. */
const LONG_MS = 50;

test('no task in play is longer than 50 ms, with drawing and drivers taken out', async ({ stage, page }) => {
  test.setTimeout(180_000);
  await page.addInitScript(() => {
    // A processor that renders instead of a graphics card blocks all else, so the test omits draw
    // calls and runs the rest.
    for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced', 'clear', 'clearBufferfv', 'blitFramebuffer', 'generateMipmap'] as const) {
      Object.defineProperty(WebGL2RenderingContext.prototype, name, { value: () => undefined });
    }
    // A driver compiles a program faster if it has compiled it before, which a test cannot know, so
    // the player's waiting is not counted. The player's own part is to request one program at a
    // time.
    const waits: { from: number; to: number }[] = [];
    const links: number[] = [];
    for (const name of ['getShaderParameter', 'getProgramParameter', 'getShaderInfoLog', 'getProgramInfoLog', 'getUniformBlockIndex'] as const) {
      const asked: (this: WebGL2RenderingContext, ...of: never[]) => unknown = WebGL2RenderingContext.prototype[name];
      Object.defineProperty(WebGL2RenderingContext.prototype, name, {
        value(this: WebGL2RenderingContext, ...of: never[]) {
          const from = performance.now();
          const answer = asked.apply(this, of);
          waits.push({ from, to: performance.now() });
          return answer;
        },
      });
    }
    const link = WebGL2RenderingContext.prototype.linkProgram;
    Object.defineProperty(WebGL2RenderingContext.prototype, 'linkProgram', {
      value(this: WebGL2RenderingContext, program: WebGLProgram) {
        links.push(performance.now());
        link.call(this, program);
      },
    });
    const tasks: { startTime: number; duration: number }[] = [];
    new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({ startTime, duration }) => ({ startTime, duration })))).observe({ type: 'longtask', buffered: true });
    Object.assign(window, { tasks, waits, links });
  });
  await stage.open(
    '<main><h1>A page</h1><raconteur-player src="/assets/stories/white-rabbit/story.eml" loading="eager" label="The rabbit" controls captions></raconteur-player></main>',
  );
  await stage.ready();
  const found = await stage.player.evaluate(async (player: RaconteurPlayer) => {
    player.muted = true;
    await player.play();
    // Everything that comes with the first moving frame has loaded.
    await new Promise((done) => setTimeout(done, 1500));
    const from = performance.now();
    await new Promise((done) => setTimeout(done, 20_000));
    player.pause();
    const to = performance.now();
    // The observer detects a long task.
    while (performance.now() < to + 80);
    await new Promise((done) => setTimeout(done, 500));
    const { tasks, waits, links } = window as unknown as {
      tasks: { startTime: number; duration: number }[];
      waits: { from: number; to: number }[];
      links: number[];
    };
    const { totalVideoFrames } = player.getVideoPlaybackQuality();
    const isOwn = ({ startTime, duration }: { startTime: number; duration: number }) => startTime + duration > to + 10;
    const split = ({ startTime, duration }: { startTime: number; duration: number }) => {
      const isIn = (time: number) => time >= startTime && time <= startTime + duration;
      const waited = waits.filter((wait) => isIn(wait.from)).reduce((sum, wait) => sum + wait.to - wait.from, 0);
      return { startTime, duration, own: duration - waited, programs: links.filter(isIn).length };
    };
    return {
      tasks: tasks.filter((task) => task.startTime > from && !isOwn(task)).map(split),
      own: tasks.filter(isOwn),
      programs: links.filter((time) => time > from).length,
      pictures: totalVideoFrames,
    };
  });
  // It was looked at, and the story was performed.
  expect(found.pictures).toBeGreaterThan(100);
  expect(found.own.length).toBeGreaterThan(0);
  expect(found.programs).toBeGreaterThan(10);
  expect(found.tasks.filter(({ own, programs }) => own > LONG_MS || programs > 1)).toEqual([]);
});
