/** Avatars made elsewhere; fetched only by pages that meet one. */

import instantiate from '../pkg/avatar/raconteur.js';
import wasmUrl from '../pkg/avatar/raconteur_bg.wasm?url';
import type { Diagnostic } from './types.js';

/** What the converter gives: `convert` of `crate/web`, feature `avatar`. */
interface Converted {
  readonly glb: Uint8Array;
  readonly diagnostics: readonly Diagnostic[];
}

interface Instance {
  (source: { module_or_path: Promise<Response> }): Promise<unknown>;
  convert(name: string, bytes: Uint8Array): Converted;
}

/** The figure that an avatar makes; throws an `Error` that says what is wrong with the file. */
export async function convertAvatar(name: string, bytes: Uint8Array): Promise<Converted> {
  // A fresh instance each time: a hostile file can at worst end this one.
  const instance = instantiate() as unknown as Instance;
  await instance({ module_or_path: fetch(new URL(wasmUrl, import.meta.url)) });
  return instance.convert(name, bytes);
}
