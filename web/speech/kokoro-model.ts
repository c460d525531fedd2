/** Kokoro-82M, a neural network that speaks phones: runs in a worker, with ONNX Runtime's wasm build. */

import * as ort from 'onnxruntime-web/wasm';
import glueUrl from 'onnxruntime-web/ort-wasm-simd-threaded.mjs?url';
import wasmUrl from 'onnxruntime-web/ort-wasm-simd-threaded.wasm?url';
import { fetchBytes, SCRIPT } from '../element/base/fetching.js';
import { voiceFile } from './serve.js';
import { trustOwnScripts } from './trusted.js';

/** Samples a second. */
export const RATE = 24_000;
/** Numbers of a style. */
const STYLE = 256;
/** Maximum size of the styles of a voice, bytes; those of Kokoro have half a megabyte. */
const MAX_STYLES_BYTES = 16e6;
/** The output that `npm run voice` adds to the model. */
const FRAMES = '/encoder/Clip_output_0';
/** Number of threads; more than this help little. */
const THREADS = 2;

/** Synthesised speech. */
export interface ModelOutput {
  /** Samples at `RATE`. */
  readonly samples: Float32Array;
  /** Duration of each token, with the padding before and after; their sum is the length of the audio. */
  readonly frames: Float32Array;
}

export interface Model {
  /** Returns the styles of a voice, one after another; the choice depends on the number of tokens (see `styleFor`). */
  voice(name: string): Promise<Float32Array>;
  /** Speaks tokens of `vocab.json`, without padding. `speed` 1 is the voice's own. */
  infer(tokens: ArrayLike<number>, style: Float32Array, speed: number): Promise<ModelOutput>;
}

/** Returns the style of a voice for a number of tokens. */
export function styleFor(voice: Float32Array, tokens: number): Float32Array {
  const last = voice.length / STYLE - 1;
  const row = Math.min(tokens, last) * STYLE;
  return voice.subarray(row, row + STYLE);
}

/** Fetches the model of a folder that `npm run voice` has filled. The folder's address ends with a slash. */
export async function openModel(folder: URL): Promise<Model> {
  const here = (address: string) => new URL(address, SCRIPT).href;
  ort.env.wasm.wasmPaths = { mjs: here(glueUrl), wasm: here(wasmUrl) };
  // Threads share memory, which requires a cross-origin isolated page. ONNX Runtime starts them by
  // plain URLs.
  ort.env.wasm.numThreads = self.crossOriginIsolated && trustOwnScripts() ? THREADS : 1;
  const session = await ort.InferenceSession.create(await fetchBytes(new URL('model.onnx', folder), voiceFile), { executionProviders: ['wasm'] });
  return {
    async voice(name) {
      const bytes = await fetchBytes(new URL(`${name}.bin`, folder), { what: `The voice ${name}`, most: MAX_STYLES_BYTES });
      return new Float32Array(bytes.buffer);
    },
    async infer(tokens, style, speed) {
      const padded = BigInt64Array.from([0, ...Array.from(tokens), 0], BigInt);
      const { audio, [FRAMES]: frames } = await session.run({
        tokens: new ort.Tensor('int64', padded, [1, padded.length]),
        style: new ort.Tensor('float32', style, [1, STYLE]),
        speed: new ort.Tensor('float32', Float32Array.of(speed), [1]),
      });
      if (audio === undefined || frames === undefined) throw new Error('The model of the voice is not the one that `npm run voice` fetches.');
      return { samples: audio.data as Float32Array, frames: frames.data as Float32Array };
    },
  };
}
