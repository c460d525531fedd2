/**
 * Time stretching without pitch change: waveform-similarity overlap-add, after Verhelst & Roelands 1993, doi:10.1109/ICASSP.1993.319366. Windows of the sound
 * are placed at even steps; each is taken from near the position given by the new rate, at the offset that continues the last window best. The rate refers to
 * the middles of windows, so every point stays within the search range of its position.
 */

/** Long enough for two periods of a low voice (80 Hz). */
const WINDOW_SECS = 0.025;
/** Search range of a window in both directions: together a period of a low voice. */
const SEARCH_SECS = 0.00625;
/** Step of the coarse search over offsets and samples; a fine search follows. */
const COARSE = 4;

/** Returns a recording at a speed, with its pitch preserved. */
export function paced(sound: AudioBuffer, rate: number): AudioBuffer {
  const channels = Array.from({ length: sound.numberOfChannels }, (_, c) => stretch(sound.getChannelData(c), sound.sampleRate, rate));
  const buffer = new AudioBuffer({
    length: channels[0]?.length ?? 1,
    numberOfChannels: Math.max(1, channels.length),
    sampleRate: sound.sampleRate,
  });
  channels.forEach((samples, c) => buffer.copyToChannel(samples, c));
  return buffer;
}

/** Returns the samples of `input`, stretched to `1 / rate` of their duration. */
export function stretch(input: Float32Array, sampleRate: number, rate: number): Float32Array<ArrayBuffer> {
  const step = Math.max(16, Math.round((WINDOW_SECS * sampleRate) / 2));
  const size = step * 2;
  const length = Math.max(1, Math.round(input.length / rate));
  const output = new Float32Array(length);
  if (input.length < size * 2) {
    // Too short to search in: a click or less.
    for (let i = 0; i < length; i++) output[i] = input[Math.min(input.length - 1, Math.floor(i * rate))] ?? 0;
    return output;
  }
  const window = new Float32Array(size);
  for (let i = 0; i < size; i++) window[i] = 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size);
  const search = Math.round(SEARCH_SECS * sampleRate);

  // The first window has its middle at the start, and the last reaches beyond the end: there is silence.
  let taken = -step;
  for (let at = -step; at < length; at += step) {
    if (at >= 0) {
      // Natural continuation of the last window, compared with the position that the speed
      // requires.
      const natural = taken + step;
      const wanted = Math.round((at + step) * rate) - step;
      taken = Math.abs(natural - wanted) <= 1 ? natural : best(input, natural, wanted, search, size);
    }
    const end = Math.min(size, length - at);
    for (let i = Math.max(0, -at); i < end; i++) {
      output[at + i] = (output[at + i] ?? 0) + (window[i] ?? 0) * (input[taken + i] ?? 0);
    }
  }
  return output;
}

/** Returns the position within `search` of `wanted` that is most similar to `natural`. */
function best(input: Float32Array, natural: number, wanted: number, search: number, size: number): number {
  const from = wanted - search;
  const to = wanted + search;
  let place = wanted;
  let score = -Infinity;
  const look = (start: number, stop: number, by: number, stride: number) => {
    score = -Infinity;
    for (let candidate = start; candidate <= stop; candidate += by) {
      const likeness = similarity(input, natural, candidate, size, stride);
      if (likeness > score) [score, place] = [likeness, candidate];
    }
  };
  look(from, to, COARSE, COARSE);
  look(Math.max(from, place - COARSE), Math.min(to, place + COARSE), 1, 2);
  return place;
}

/** Returns the correlation of two stretches of the input, normalised by the level of the second. */
function similarity(input: Float32Array, a: number, b: number, size: number, stride: number): number {
  let dot = 0;
  let power = 1e-9;
  for (let i = 0; i < size; i += stride) {
    const [x, y] = [input[a + i] ?? 0, input[b + i] ?? 0];
    dot += x * y;
    power += y * y;
  }
  return dot / Math.sqrt(power);
}
