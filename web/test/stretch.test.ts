import { expect, test } from 'vitest';
import { stretch } from '../element/sound/stretch.js';

const RATE = 16000;

/** Returns a voice-like sound of one second: a fundamental with harmonics. */
function voice(hz: number): Float32Array {
  return Float32Array.from({ length: RATE }, (_, i) => {
    const phase = (2 * Math.PI * hz * i) / RATE;
    return 0.3 * Math.sin(phase) + 0.2 * Math.sin(2 * phase) + 0.1 * Math.sin(3 * phase);
  });
}

/** Returns the fundamental of a sound, Hz, by autocorrelation over its middle: the first lag that is nearly as good as the best. */
function pitch(sound: Float32Array): number {
  const from = Math.floor(sound.length / 3);
  const size = 2048;
  const shortest = Math.floor(RATE / 400);
  const scores = Array.from({ length: Math.floor(RATE / 70) - shortest }, (_, k) => {
    let sum = 0;
    for (let i = 0; i < size; i++) sum += (sound[from + i] ?? 0) * (sound[from + i + shortest + k] ?? 0);
    return sum;
  });
  const good = 0.9 * Math.max(...scores);
  let at = scores.findIndex((score) => score > good);
  while ((scores[at + 1] ?? -Infinity) > (scores[at] ?? 0)) at += 1;
  return RATE / (shortest + at);
}

const power = (sound: Float32Array) => Math.sqrt(sound.reduce((s, x) => s + x * x, 0) / sound.length);

test.each([0.25, 0.5, 0.75, 1.25, 1.5, 2, 4])('at %f times the speed the length changes and the pitch stays', (rate) => {
  for (const hz of [110, 220]) {
    const sound = voice(hz);
    const changed = stretch(sound, RATE, rate);
    expect(changed.length).toBe(Math.round(sound.length / rate));
    // One sample of lag is 1.4 % at 220 Hz.
    expect(Math.abs(pitch(changed) / hz - 1)).toBeLessThan(0.02);
    // Windows out of phase would cancel each other; a good match preserves the loudness.
    expect(power(changed) / power(sound)).toBeGreaterThan(0.9);
    expect(power(changed) / power(sound)).toBeLessThan(1.1);
  }
});

test.each([0.25, 0.5, 0.75, 1.25, 1.6, 2, 4])('at %f times the speed every moment stays within 10 ms of its place', (rate) => {
  // Noise correlates only with itself, so a piece of it identifies its position.
  let state = 1;
  const noise = Float32Array.from({ length: RATE * 2 }, () => (state = (state * 48_271) % 2_147_483_647) / 2 ** 30 - 1);
  const changed = stretch(noise, RATE, rate);
  const size = Math.round(RATE * 0.012);
  let [worst, found] = [0, 0];
  for (let at = 0; at + size <= changed.length; at += size) {
    const wanted = (at + size / 2) * rate - size / 2;
    let [best, place] = [0, 0];
    for (let from = Math.max(0, Math.round(wanted - RATE * 0.05)); from <= wanted + RATE * 0.05 && from + size <= noise.length; from++) {
      let [dot, a, b] = [0, 0, 0];
      for (let i = 0; i < size; i++) {
        const [x, y] = [changed[at + i] ?? 0, noise[from + i] ?? 0];
        dot += x * y;
        a += x * x;
        b += y * y;
      }
      const likeness = dot / Math.sqrt(a * b);
      if (likeness > best) [best, place] = [likeness, from];
    }
    // If two windows cross at equal level, either is a correct answer.
    if (best < 0.8) continue;
    found += 1;
    worst = Math.max(worst, Math.abs(place - wanted) / RATE);
  }
  expect(found).toBeGreaterThan(20);
  // At a higher rate, each part is audible for less time.
  expect(worst).toBeLessThan(0.01 * Math.max(1, rate / 2));
});

test('very short and silent sounds do no harm', () => {
  expect(stretch(new Float32Array(5), RATE, 2)).toHaveLength(3);
  expect(stretch(new Float32Array(0), RATE, 2)).toHaveLength(1);
  expect(stretch(new Float32Array(RATE), RATE, 1.5).every((x) => x === 0)).toBe(true);
});
