/** Chooses between the two wasm builds and makes engines from them. */

import webglUrl from '../../pkg/webgl/raconteur_bg.wasm?url';
import webgpuUrl from '../../pkg/webgpu/raconteur_bg.wasm?url';
import { fetchModule, SCRIPT } from '../base/fetching.js';
import type { Engine } from '../base/engine.js';
import type { Backend, Diagnostic, Performer } from '../base/types.js';

/** Palm functions of the engine: `crate/web/src/palm.rs`. */
export interface PalmFunctions {
  /** Returns the directions of normal and fingers, 6 numbers; empty if the normal has no direction. */
  handDirections(left: boolean, x: number, y: number, z: number, angle: number): Float64Array;
  /** Returns the normal and angle of a palm, 4 numbers. */
  palmOf(left: boolean, directions: Float64Array): Float64Array;
}

/** Narration functions of the engine for plain text: `crate/web/src/narration.rs`. Languages are BCP 47 tags. */
export interface NarrationFunctions {
  /** Returns the script that narrates a text, phrase by phrase or not, up to a number of characters; undefined if it has no word. */
  narrate(text: string, language: string, phrased: boolean, most: number): string | undefined;
  /**
   * Returns the fragment that continues the narration after a text that ended with the emotion `felt`, and its own final emotion; undefined if it has no word.
   */
  continueNarration(text: string, language: string, emotion: string): { readonly fragment: string; readonly emotion: string } | undefined;
  /** Returns the clauses of a text that arrives in pieces, and the remainder that may continue; with `whole` the text is complete. */
  splitClauses(text: string, language: string, whole: boolean): { readonly clauses: readonly string[]; readonly rest: string };
}

/** A script that was fetched. */
export interface Script {
  readonly text: string;
  /** Diagnostic if some of its bytes are not UTF-8. */
  readonly problem?: Diagnostic;
}

/** JavaScript interface of a build for one instance. */
interface Instance extends PalmFunctions, NarrationFunctions {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  performerOf(eml: string): Performer;
  decodeScript(bytes: Uint8Array): Script;
  /** Returns the activity during which the instance trapped; 0 for none. */
  doing(): number;
  /** Returns the message of the panic that ended the instance; undefined for another trap. */
  panicMessage(): string | undefined;
  Player: { create(canvas: HTMLCanvasElement | undefined): Promise<Engine> };
}

const scripts: Record<Backend, () => Promise<{ default: () => unknown }>> = {
  webgpu: () => import('../../pkg/webgpu/raconteur.js'),
  webgl: () => import('../../pkg/webgl/raconteur.js'),
};
const urls: Record<Backend, string> = { webgpu: webgpuUrl, webgl: webglUrl };

/** Maximum size of a build, bytes. */
const MAX_BYTES = 64e6;

/** Compiled modules, once per page, by address; each player has its own instance. */
const modules = new Map<string, Promise<WebAssembly.Module>>();
const instances = new WeakMap<Engine, Instance>();

/** Members of a `GPUAdapter` that indicate software rendering; browsers report it in different ways. */
export interface Adapter {
  readonly isFallbackAdapter?: boolean;
  readonly info?: { readonly isFallbackAdapter?: boolean; readonly architecture?: string; readonly description?: string };
}

/** Returns true for software rendering. */
export function isSoftware({ isFallbackAdapter, info }: Adapter): boolean {
  return (isFallbackAdapter ?? info?.isFallbackAdapter ?? false) || /swiftshader|llvmpipe|basic render/i.test(`${info?.architecture} ${info?.description}`);
}

/** Returns the back ends to try, best first: WebGPU on a graphics card, WebGL2 for software rendering, which it does several times faster. */
export async function chooseBackends(): Promise<[Backend, ...Backend[]]> {
  const gpu = (navigator as { gpu?: { requestAdapter(): Promise<Adapter | null> } }).gpu;
  try {
    const adapter = (await gpu?.requestAdapter()) ?? null;
    if (adapter === null) return ['webgl'];
    // An adapter is no promise of a device.
    return isSoftware(adapter) ? ['webgl', 'webgpu'] : ['webgpu', 'webgl'];
  } catch {
    return ['webgl'];
  }
}

/** Begins to fetch a build in parallel with the story; an engine created later reports errors. */
export function warmUp(backend: Backend): void {
  Promise.all([scripts[backend](), compile(urls[backend])]).catch(() => undefined);
}

/** Opens a fresh instance of a build. */
export async function openInstance(backend: Backend): Promise<Instance> {
  const [script, module] = await Promise.all([scripts[backend](), compile(urls[backend])]);
  const instance = script.default() as Instance;
  await instance({ module_or_path: module });
  return instance;
}

/** Creates an engine that renders to `canvas`, or one without rendering. */
export async function createEngine(backend: Backend, canvas: HTMLCanvasElement | undefined): Promise<Engine> {
  const instance = await openInstance(backend);
  const engine = await instance.Player.create(canvas);
  instances.set(engine, instance);
  return engine;
}

/** Returns the text of a script's bytes, and their problems: an instance reports invalid bytes. */
export async function decodeScript(backend: Promise<Backend>, bytes: Uint8Array): Promise<Script> {
  try {
    return { text: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
  } catch {
    return (await openInstance(await backend)).decodeScript(bytes);
  }
}

/** Returns the performer chosen by a text, read by a separate instance, since there is no engine yet. */
export async function performerOf(backend: Backend, eml: string): Promise<Performer> {
  return (await openInstance(backend)).performerOf(eml);
}

/** Returns the activity during which an engine trapped: a number of `Doing` in `trap.ts`. */
export function doingOf(engine: Engine): number {
  try {
    return instances.get(engine)?.doing() ?? 0;
  } catch {
    // Its memory is suspect.
    return 0;
  }
}

/** Returns the message of an engine's panic, with its source location; undefined if it ended otherwise. */
export function panicOf(engine: Engine): string | undefined {
  try {
    return instances.get(engine)?.panicMessage();
  } catch {
    return undefined;
  }
}

function compile(url: string): Promise<WebAssembly.Module> {
  let module = modules.get(url);
  if (module === undefined) {
    module = fetchModule(new URL(url, SCRIPT), { what: 'The player', most: MAX_BYTES });
    modules.set(url, module);
    // A failure is not cached, because the network may return.
    module.catch(() => modules.delete(url));
  }
  return module;
}
