import { describe, expect, it } from 'vitest';
import { levelAt, placeIn, steer } from '../element/sound/music.js';

describe('levelAt', () => {
  const line = [
    [1, 0],
    [3, 1],
    [10, 1],
    [10.5, 0.4],
  ] as const;

  it('is straight between points and flat beyond them', () => {
    expect([0, 1, 2, 3, 7, 10.25, 99].map((t) => levelAt(line, t))).toEqual([0, 0, 0.5, 1, 1, 0.7, 0.4]);
  });

  it('is silent where nothing is said', () => {
    expect(levelAt([], 5)).toBe(0);
  });
});

describe('placeIn', () => {
  it('begins a loop again', () => {
    expect([placeIn(25, 10, true), placeIn(-1, 10, true), placeIn(25, 10, false)]).toEqual([5, 9, 25]);
  });

  it('is a time also where a server does not tell how long a piece is', () => {
    for (const length of [Number.POSITIVE_INFINITY, Number.NaN, 0]) expect(placeIn(25, length, true)).toBe(25);
  });
});

describe('steer', () => {
  it('leaves a piece alone that is where it should be', () => {
    expect(steer(0.005, 1)).toBe(1);
    expect(steer(-0.005, 1.5)).toBe(1.5);
  });

  it('pulls a little when it is near and sets it when it is far', () => {
    expect(steer(0.05, 1)).toBe(0.985);
    expect(steer(-0.05, 2)).toBe(2.03);
    expect([steer(0.2, 1), steer(-7, 1)]).toEqual(['set', 'set']);
  });

  it('brings a piece home without swinging past', () => {
    // Looked at four times a second, as in a hidden page.
    for (const start of [0.059, -0.04]) {
      let drift = start;
      for (let look = 0; look < 60; look++) {
        const speed = steer(drift, 1);
        if (speed === 'set') throw new Error('set');
        drift += (speed - 1) * 0.25;
        expect(Math.sign(drift)).toBe(Math.sign(start));
      }
      expect(Math.abs(drift)).toBeLessThan(0.0125);
    }
  });
});
