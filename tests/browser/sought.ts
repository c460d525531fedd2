/** Finds a piece of sound in a longer one. */

/** Match of a piece: position of its first sample, and the correlation, from −1 to 1. */
export interface Found {
  readonly at: number;
  readonly likeness: number;
}

/** Step of the coarse search, samples; the best match is then refined. */
const COARSE = 4;

/** Finds the position in `sound`, from `from` to `to`, that is most similar to `piece`: normalised cross-correlation. */
export function find(piece: Float32Array, sound: Float32Array, from: number, to: number): Found {
  const thin = (samples: Float32Array) =>
    Float32Array.from({ length: Math.floor(samples.length / COARSE) }, (_, i) => {
      let sum = 0;
      for (let k = 0; k < COARSE; k++) sum += samples[i * COARSE + k] ?? 0;
      return sum / COARSE;
    });
  const first = Math.max(0, from);
  const last = Math.min(sound.length - piece.length, to);
  const rough = best(thin(piece), thin(sound.subarray(first, Math.max(first, last + piece.length))), 0, Infinity);
  const near = first + rough.at * COARSE;
  return best(piece, sound, Math.max(first, near - 2 * COARSE), Math.min(last, near + 2 * COARSE));
}

function best(piece: Float32Array, sound: Float32Array, from: number, to: number): Found {
  let found: Found = { at: from, likeness: -1 };
  const power = piece.reduce((sum, x) => sum + x * x, 1e-12);
  for (let at = from; at <= Math.min(to, sound.length - piece.length); at++) {
    let dot = 0;
    let other = 1e-12;
    for (let i = 0; i < piece.length; i++) {
      const y = sound[at + i] ?? 0;
      dot += (piece[i] ?? 0) * y;
      other += y * y;
    }
    const likeness = dot / Math.sqrt(power * other);
    if (likeness > found.likeness) found = { at, likeness };
  }
  return found;
}

/** Returns the root mean square of samples. */
export function loudness(samples: Float32Array): number {
  return Math.sqrt(samples.reduce((sum, x) => sum + x * x, 0) / Math.max(1, samples.length));
}
