/** Clock of a waiting figure: it runs slowly, only while visible, and spares slow devices. */

import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { IdleClock } from '../element/story/idle-clock.js';

let callbacks = new Map<number, FrameRequestCallback>();
let last = 0;
let now = 0;
let reduced = false;
let drawn: number[] = [];
/** Cost of a frame, milliseconds. */
let cost = 0;
let welcome: IdleClock;

beforeEach(() => {
  [callbacks, last, now, reduced, drawn, cost] = [new Map(), 0, 0, false, [], 0];
  vi.stubGlobal('matchMedia', () => ({ matches: reduced }));
  vi.stubGlobal('requestAnimationFrame', (callback: FrameRequestCallback) => {
    callbacks.set(++last, callback);
    return last;
  });
  vi.stubGlobal('cancelAnimationFrame', (id: number) => callbacks.delete(id));
  welcome = new IdleClock(() => {
    drawn.push(welcome.secs);
    now += cost;
  });
});

afterEach(() => vi.unstubAllGlobals());

/** Simulates a 60 Hz screen. */
function run(ms: number): void {
  const end = now + ms;
  while (now < end && callbacks.size > 0) {
    now += 1000 / 60;
    const due = [...callbacks.values()];
    callbacks.clear();
    const at = now;
    for (const callback of due) callback(at);
  }
}

test('it breathes at no more than fifteen pictures a second, in real time', () => {
  welcome.keep(true);
  run(10_000);
  expect(drawn.length).toBeGreaterThan(100);
  expect(drawn.length).toBeLessThanOrEqual(151);
  expect(welcome.secs).toBeGreaterThan(9.5);
  expect(welcome.secs).toBeLessThanOrEqual(10);
  expect([...drawn].sort((a, b) => a - b)).toEqual(drawn);
});

test('a device that draws slowly draws less often, and keeps most of its time', () => {
  cost = 150;
  welcome.keep(true);
  run(30_000);
  expect((drawn.length * cost) / 30_000).toBeLessThan(0.3);
  expect(drawn.length).toBeGreaterThan(25);
});

test('nothing runs where nobody sees it, and it goes on where it was', () => {
  welcome.keep(true);
  run(2000);
  const before = welcome.secs;
  welcome.keep(false);
  expect(callbacks.size).toBe(0);
  now += 60_000;
  welcome.keep(true);
  run(200);
  expect(welcome.secs - before).toBeLessThan(0.3);
  // A page that was hidden is not caught up with.
  now += 60_000;
  run(200);
  expect(welcome.secs - before).toBeLessThan(1.6);
});

test('with reduced motion the figure stands still', () => {
  reduced = true;
  welcome.keep(true);
  run(1000);
  expect([drawn, welcome.secs, callbacks.size]).toEqual([[], 0, 0]);
});
