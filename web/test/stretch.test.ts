import { expect, test } from 'vitest';
import { stretch } from '../element/stretch.js';

const RATE = 16000;

/** A voice-like sound: a fundamental with harmonics, one second. */
function voice(hz: number): Float32Array {
  return Float32Array.from({ length: RATE }, (_, i) => {
    const phase = (2 * Math.PI * hz * i) / RATE;
    return 0.3 * Math.sin(phase) + 0.2 * Math.sin(2 * phase) + 0.1 * Math.sin(3 * phase);
  });
}

/** Fundamental by autocorrelation over the middle of a sound, Hz: the first lag as good as the best, nearly. */
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

test.each([0.5, 0.75, 1.25, 1.5, 2])('at %f times the speed the length changes and the pitch stays', (rate) => {
  for (const hz of [110, 220]) {
    const sound = voice(hz);
    const changed = stretch(sound, RATE, rate);
    expect(changed.length).toBe(Math.round(sound.length / rate));
    // One sample of lag is 1.4 % at 220 Hz.
    expect(Math.abs(pitch(changed) / hz - 1)).toBeLessThan(0.02);
    // Windows that did not fit would cancel each other; a good fit keeps the loudness.
    expect(power(changed) / power(sound)).toBeGreaterThan(0.9);
    expect(power(changed) / power(sound)).toBeLessThan(1.1);
  }
});

test('what is loud at a moment stays at its moment', () => {
  const sound = new Float32Array(RATE * 2);
  sound.set(voice(150).subarray(0, RATE / 4), RATE);
  const changed = stretch(sound, RATE, 1.6);
  let [sum, weighted] = [0, 0];
  changed.forEach((x, i) => {
    sum += x * x;
    weighted += x * x * i;
  });
  const middle = (weighted / sum / RATE) * 1.6;
  // Half the search range, in the input's time.
  expect(Math.abs(middle - 1.125)).toBeLessThan(0.02);
});

test('very short and silent sounds do no harm', () => {
  expect(stretch(new Float32Array(5), RATE, 2)).toHaveLength(3);
  expect(stretch(new Float32Array(0), RATE, 2)).toHaveLength(1);
  expect(stretch(new Float32Array(RATE), RATE, 1.5).every((x) => x === 0)).toBe(true);
});
