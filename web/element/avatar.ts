/** Avatars made elsewhere; fetched only by pages that meet one. */

import instantiate from '../pkg/avatar/raconteur.js';
import wasmUrl from '../pkg/avatar/raconteur_bg.wasm?url';
import type { Diagnostic } from './types.js';

/** What the converter gives: `Converted` of `crate/web`, feature `avatar`. */
interface Converted {
  take_glb(): Uint8Array;
  diagnostics(): { readonly code: string; readonly message: string; readonly hint: string }[];
}

interface Instance {
  (source: { module_or_path: Promise<Response> }): Promise<unknown>;
  convert(name: string, bytes: Uint8Array): Converted;
}

/** The figure that an avatar makes; throws an `Error` that says what is wrong with the file. */
export async function convertAvatar(name: string, bytes: Uint8Array): Promise<{ glb: Uint8Array; diagnostics: Diagnostic[] }> {
  // A fresh instance each time: a hostile file can at worst end this one.
  const instance = instantiate() as unknown as Instance;
  await instance({ module_or_path: fetch(new URL(wasmUrl, import.meta.url)) });
  const converted = instance.convert(name, bytes);
  const diagnostics = converted.diagnostics().map(({ code, message, hint }): Diagnostic => ({ code, severity: 'warning', message, hints: hint === '' ? [] : [hint] }));
  return { glb: converted.take_glb(), diagnostics };
}
