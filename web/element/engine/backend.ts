/** Chooses between the two wasm builds and makes engines from them. */

import webglUrl from '../../pkg/webgl/raconteur_bg.wasm?url';
import webgpuUrl from '../../pkg/webgpu/raconteur_bg.wasm?url';
import { fetchModule, SCRIPT } from '../base/fetching.js';
import type { Engine } from '../base/engine.js';
import type { Backend, Diagnostic, Performer } from '../base/types.js';

/** How the engine reads where a palm looks: `crate/web/src/palm.rs`. */
export interface PalmFunctions {
  /** Normal and fingers, 6 numbers; empty for a normal without direction. */
  handDirections(left: boolean, x: number, y: number, z: number, angle: number): Float64Array;
  /** Normal and angle, 4 numbers. */
  palmOf(left: boolean, directions: Float64Array): Float64Array;
}

/** How the engine tells plain text: `crate/web/src/narration.rs`. Languages are tags of BCP 47. */
export interface NarrationFunctions {
  /** The script of a text, phrase by phrase or not, so many characters of it; undefined where it has no word. */
  narrate(text: string, language: string, phrased: boolean, most: number): string | undefined;
  /** The fragment that goes on after a text that has left the feeling `felt`, and the feeling that this one leaves; undefined where it has no word. */
  continueNarration(text: string, language: string, felt: string): { readonly fragment: string; readonly feels: string } | undefined;
  /** The clauses of a text that comes piece by piece, and what may go on; with `whole` nothing more comes. */
  splitClauses(text: string, language: string, whole: boolean): { readonly clauses: readonly string[]; readonly rest: string };
}

/** A script that was fetched. */
export interface Script {
  readonly text: string;
  /** That some of its bytes are not UTF-8. */
  readonly problem?: Diagnostic;
}

/** What the JavaScript side of a build gives for one instance. */
interface Instance extends PalmFunctions, NarrationFunctions {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  performerOf(eml: string): Performer;
  decodeScript(bytes: Uint8Array): Script;
  /** What the instance was at when it trapped; 0 for nothing. */
  doing(): number;
  /** What the panic said that ended the instance; undefined where it was another trap. */
  panicMessage(): string | undefined;
  Player: { create(canvas: HTMLCanvasElement | undefined): Promise<Engine> };
}

const scripts: Record<Backend, () => Promise<{ default: () => unknown }>> = {
  webgpu: () => import('../../pkg/webgpu/raconteur.js'),
  webgl: () => import('../../pkg/webgl/raconteur.js'),
};
const urls: Record<Backend, string> = { webgpu: webgpuUrl, webgl: webglUrl };

/** No build is larger. */
const MAX_BYTES = 64e6;

/** Compiled once a page, by address; each player has an instance of its own. */
const modules = new Map<string, Promise<WebAssembly.Module>>();
const instances = new WeakMap<Engine, Instance>();

/** As much of a `GPUAdapter` as tells whether a processor stands in for a graphics card; browsers tell it in different ways. */
export interface Adapter {
  readonly isFallbackAdapter?: boolean;
  readonly info?: { readonly isFallbackAdapter?: boolean; readonly architecture?: string; readonly description?: string };
}

/** Whether a processor draws. */
export function isSoftware({ isFallbackAdapter, info }: Adapter): boolean {
  return (isFallbackAdapter ?? info?.isFallbackAdapter ?? false) || /swiftshader|llvmpipe|basic render/i.test(`${info?.architecture} ${info?.description}`);
}

/** Back ends to try, the best first: WebGPU on a graphics card, WebGL2 where a processor draws, which it does several times faster. */
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

/** Begins to fetch a build while the story is fetched, too; an engine made later says what went wrong. */
export function warmUp(backend: Backend): void {
  Promise.all([scripts[backend](), compile(urls[backend])]).catch(() => undefined);
}

/** A fresh instance of a build. */
export async function openInstance(backend: Backend): Promise<Instance> {
  const [script, module] = await Promise.all([scripts[backend](), compile(urls[backend])]);
  const instance = script.default() as Instance;
  await instance({ module_or_path: module });
  return instance;
}

/** A fresh engine that draws on `canvas`, or one without a picture. */
export async function createEngine(backend: Backend, canvas: HTMLCanvasElement | undefined): Promise<Engine> {
  const instance = await openInstance(backend);
  const engine = await instance.Player.create(canvas);
  instances.set(engine, instance);
  return engine;
}

/** The text of a script's bytes, and what is wrong with them: an instance says where bytes are no text. */
export async function decodeScript(backend: Promise<Backend>, bytes: Uint8Array): Promise<Script> {
  try {
    return { text: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
  } catch {
    return (await openInstance(await backend)).decodeScript(bytes);
  }
}

/** The performer that a text chooses, read by an instance of its own: there is no engine yet. */
export async function performerOf(backend: Backend, eml: string): Promise<Performer> {
  return (await openInstance(backend)).performerOf(eml);
}

/** What an engine was at when it trapped: a number of `Doing` in `trap.ts`. */
export function doingOf(engine: Engine): number {
  try {
    return instances.get(engine)?.doing() ?? 0;
  } catch {
    // Its memory is suspect.
    return 0;
  }
}

/** What an engine's panic said, and where in its source; undefined where it ended otherwise. */
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
    // A failure is not kept: the network may come back.
    module.catch(() => modules.delete(url));
  }
  return module;
}
