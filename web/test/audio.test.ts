import { expect, test } from 'vitest';
import { latency } from '../element/audio.js';

test('the output is as late as the browser says, as far as an output can be', () => {
  expect(latency({ outputLatency: 0.25, baseLatency: 0.01 })).toBe(0.25);
  expect(latency({ outputLatency: 3.978, baseLatency: 0.01 })).toBe(0.01);
  expect(latency({ outputLatency: 0, baseLatency: 0.01 })).toBe(0.01);
});

test('browsers that know neither figure are taken as immediate', () => {
  const unknown = undefined as unknown as number;
  expect(latency({ outputLatency: unknown, baseLatency: unknown })).toBe(0);
});
