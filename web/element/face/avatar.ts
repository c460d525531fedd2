/** Import of avatars; fetched only by pages that encounter one. */

import instantiate from '../../pkg/avatar/raconteur.js';
import wasmUrl from '../../pkg/avatar/raconteur_bg.wasm?url';
import { toldLook } from './face-look.js';
import { fetchModule, SCRIPT } from '../base/fetching.js';
import type { FaceLook, FigureFace } from '../base/face-types.js';
import type { Diagnostic } from '../base/types.js';

/** Maximum size of the WebAssembly module that reads imported avatars, bytes. */
const MAX_BYTES = 64e6;

interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  /** `convert` of `crate/web`, feature `avatar`. */
  convert(name: string, bytes: Uint8Array): { glb: Uint8Array; diagnostics: Diagnostic[] };
  /** `convertAnimation` of `crate/web`, feature `avatar`. */
  convertAnimation(name: string, bytes: Uint8Array): string;
  /** `faceFile` of the same. */
  faceFile(
    name: string,
    glb: Uint8Array,
    skin: Float64Array,
    organs: Float64Array,
    factors: Float64Array,
    look: FaceLook | undefined,
    lenders: readonly string[],
    files: readonly Uint8Array[],
    painted: Uint8Array | undefined,
  ): Uint8Array;
  /** Returns the message of the panic that ended the instance. */
  panicMessage(): string | undefined;
}

/** Sources of a figure file with a face. */
export interface FaceFile {
  /** The name of the new figure. */
  readonly name: string;
  /** The figure that gets the face. */
  readonly glb: Uint8Array;
  readonly face: FigureFace;
  /** Files of figures that lend hair, by name. */
  readonly lent: ReadonlyMap<string, Uint8Array>;
  /** Painted image of the skin. */
  readonly painted: Uint8Array | undefined;
}

/** Opens a fresh instance each time: a hostile file can at worst crash this one. */
async function open(): Promise<Instance> {
  const instance = instantiate() as unknown as Instance;
  const module = await fetchModule(new URL(wasmUrl, SCRIPT), { what: 'The part that reads imported avatars', most: MAX_BYTES });
  await instance({ module_or_path: module });
  return instance;
}

/** Returns the result of an instance; a panic's message becomes the error. */
async function use<T>(work: (instance: Instance) => T): Promise<T> {
  const instance = await open();
  try {
    return work(instance);
  } catch (error) {
    const panic = error instanceof WebAssembly.RuntimeError ? instance.panicMessage() : undefined;
    throw panic === undefined ? error : new Error(panic, { cause: error });
  }
}

/** Converts an avatar to a figure; throws an `Error` that describes the fault of the file. */
export async function convertAvatar(name: string, bytes: Uint8Array): Promise<{ glb: Uint8Array; diagnostics: Diagnostic[] }> {
  return await use((instance) => instance.convert(name, bytes));
}

/** Converts an animation of a foreign file to the text of a clip: the one of this name, or the first. Throws an `Error` that describes the fault. */
export async function convertAnimation(name: string, bytes: Uint8Array): Promise<string> {
  return await use((instance) => instance.convertAnimation(name, bytes));
}

/** Returns a figure with a face as a figure file, which any story can use. Throws an `Error` that describes the fault. */
export async function faceFile({ name, glb, face, lent, painted }: FaceFile): Promise<Uint8Array> {
  const { skin, organs, factors, look } = face;
  return await use((instance) => instance.faceFile(name, glb, skin, organs, factors ?? new Float64Array(), toldLook(look), [...lent.keys()], [...lent.values()], painted));
}
