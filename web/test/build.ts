/** Instance of the engine, for tests that read the same in both builds. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { kind } from './tier.js';

/** Timeout for compiling a build on a busy machine. */
export const COMPILE_MS = 60_000;

/** Opens the required part of the JavaScript side of a build. */
export async function openBuild<Functions>(): Promise<Functions> {
  const folder = join(import.meta.dirname, '../..', kind.folder, 'webgl');
  const { default: instantiate } = (await import(join(folder, 'raconteur.js'))) as { default: () => unknown };
  const instance = instantiate() as Functions & ((source: { module_or_path: WebAssembly.Module }) => Promise<unknown>);
  await instance({ module_or_path: await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm'))) });
  return instance;
}
