/** Messages between a page and its speech worker. */

import type { SpeechRequest } from './source.js';

/** Message to the worker: a text to speak, or a cancellation. */
export type WorkerRequest = ({ readonly kind: 'speak'; readonly id: number } & SpeechRequest) | { readonly kind: 'stop'; readonly id: number };

/** Newly spoken part; `Said` of `crate/say`. */
export interface Part {
  readonly bundle: string;
  readonly sounds: readonly (readonly [string, Uint8Array])[];
  readonly problems: readonly string[];
}

/** Message from the worker. */
export type Reply =
  | { readonly kind: 'progress'; readonly share: number }
  | ({ readonly kind: 'part'; readonly id: number } & Part)
  | { readonly kind: 'done'; readonly id: number }
  /** `dead`: the worker cannot be used again. */
  | { readonly kind: 'failed'; readonly id: number; readonly message: string; readonly dead: boolean };
