import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { AnimationLoops } from '../element/picture/animation-loops.js';

let page: { hidden: boolean };
let frames: (() => void)[];

beforeEach(() => {
  vi.useFakeTimers();
  frames = [];
  page = { hidden: false };
  vi.stubGlobal('document', page);
  vi.stubGlobal('requestAnimationFrame', (frame: () => void) => frames.push(frame));
  vi.stubGlobal('cancelAnimationFrame', () => undefined);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('a hidden page is drawn four times a second, and often enough where it is watched elsewhere', () => {
  let pictures = 0;
  let isElsewhere = false;
  const pulse = new AnimationLoops(
    () => (pictures += 1),
    () => undefined,
    () => isElsewhere,
  );
  const inASecond = (): number => {
    pictures = 0;
    vi.advanceTimersByTime(1000);
    return pictures;
  };
  pulse.keep(true, true);
  // The screen itself requests frames.
  expect([inASecond(), frames.length]).toEqual([0, 1]);
  page.hidden = true;
  expect(inASecond()).toBe(4);
  isElsewhere = true;
  pulse.keep(true, true);
  expect(inASecond()).toBeGreaterThanOrEqual(25);
  page.hidden = false;
  expect(inASecond()).toBe(0);
  // A stream is stopped without a word.
  page.hidden = true;
  isElsewhere = false;
  expect(inASecond()).toBe(4);
  pulse.keep(false, true);
  expect(inASecond()).toBe(0);
});
