import { expect, test } from 'vitest';
import { clampRate, formatTime, spokenTime, StoryClock } from '../element/base/clock.js';

test('rests where it was put, and waits for its anchor', () => {
  const clock = new StoryClock();
  clock.rest(4);
  expect(clock.storyTimeAt(100)).toBe(4);
  clock.start(4, 10, 1);
  expect(clock.storyTimeAt(9.9)).toBe(4);
  expect(clock.storyTimeAt(10.5)).toBe(4.5);
});

test('speed changes how fast the story passes, and sourceAt is the inverse', () => {
  const clock = new StoryClock();
  clock.start(2, 10, 1.5);
  expect(clock.storyTimeAt(12)).toBe(5);
  expect(clock.sourceAt(5)).toBe(12);
});

test('speeds outside the range are brought into it', () => {
  expect([0, 0.1, 0.25, 1.3, 9, -1, NaN].map(clampRate)).toEqual([0, 0.25, 0.25, 1.3, 4, 0.25, 1]);
});

test('times are written and spoken as people do', () => {
  expect([0, 65.9, 3725, NaN].map(formatTime)).toEqual(['0:00', '1:05', '1:02:05', '0:00']);
  expect([0, 1, 65, 3600].map((secs) => spokenTime(secs))).toEqual(['0 seconds', '1 second', '1 minute 5 seconds', '1 hour']);
  expect([spokenTime(65, 'de'), spokenTime(61, 'pt'), spokenTime(1, 'no language!')]).toEqual(['1 Minute 5 Sekunden', '1 minuto 1 segundo', '1 second']);
});
