import { describe, expect, it } from 'vitest';
import { arranged, MARK, type Box } from '../element/lesson/markers.js';
import { random } from './course-questions.js';

const PICTURE: Box = { left: 0, top: 0, right: 360, bottom: 608 };
const FORM: Box = { left: 6, top: 300, right: 354, bottom: 544 };

describe('Marks of what may be pointed at', () => {
  it('stand where that is, where nothing is in the way', () => {
    expect(arranged([{ x: 100, y: 200 }, undefined], PICTURE, FORM)).toEqual([{ x: 100, y: 200 }, undefined]);
  });

  it('are in the picture, apart, and not under the form, wherever that is', () => {
    const next = random(3);
    for (let i = 0; i < 3000; i += 1) {
      const [width, height] = [320 + Math.floor(1000 * next()), 400 + Math.floor(600 * next())];
      const picture: Box = { left: 0, top: 0, right: width, bottom: height };
      const isNarrow = width < 600;
      const form: Box = { left: isNarrow ? 6 : width * 0.6, top: height * (0.35 + 0.4 * next()), right: width - 6, bottom: height - 64 };
      const spots = Array.from({ length: 1 + Math.floor(8 * next()) }, () => ({ x: width * (1.4 * next() - 0.2), y: height * (1.4 * next() - 0.2) }));
      const places = arranged(spots, picture, form);
      places.forEach((place, at) => {
        const { x = Number.NaN, y = Number.NaN } = place ?? {};
        const [low, high] = [MARK / 2, width - MARK / 2];
        expect(x >= low && x <= high && y >= low && y <= height - 84, `${i}: ${x} ${y}`).toBe(true);
        const isUnder = x + MARK / 2 > form.left && x - MARK / 2 < form.right && y + MARK / 2 > form.top && y - MARK / 2 < form.bottom;
        expect(isUnder, `${i}: ${x} ${y}`).toBe(false);
        for (const other of places.slice(0, at)) expect(Math.hypot(x - (other?.x ?? 0), y - (other?.y ?? 0)), `${i}`).toBeGreaterThanOrEqual(MARK - 1e-9);
      });
    }
  });

  it('stand in the picture all the same where a form leaves no room', () => {
    const [place] = arranged([{ x: 100, y: 200 }], PICTURE, PICTURE);
    expect(place).toEqual({ x: 100, y: 200 });
  });
});
