/** Chooses between the two wasm builds and makes engines from them. */

import webglUrl from '../pkg/webgl/raconteur_bg.wasm?url';
import webglFaceUrl from '../pkg/webgl/raconteur_face.wasm?url';
import webglMoreUrl from '../pkg/webgl/raconteur_more.wasm?url';
import webgpuUrl from '../pkg/webgpu/raconteur_bg.wasm?url';
import webgpuFaceUrl from '../pkg/webgpu/raconteur_face.wasm?url';
import webgpuMoreUrl from '../pkg/webgpu/raconteur_more.wasm?url';
import { PlayerError, type Backend, type Engine, type Performer } from './types.js';

/** What the JavaScript side of a build gives for one instance. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<WebAssembly.ModuleImports>;
  performerOf(eml: string): Performer;
  faceJoined(): void;
  moreJoined(): void;
  /** What the instance was at when it trapped; 0 for nothing. */
  doing(): number;
  Player: { create(canvas: HTMLCanvasElement | undefined): Promise<Engine> };
}

const scripts: Record<Backend, () => Promise<{ default: () => unknown }>> = {
  webgpu: () => import('../pkg/webgpu/raconteur.js'),
  webgl: () => import('../pkg/webgl/raconteur.js'),
};
const urls: Record<Backend, string> = { webgpu: webgpuUrl, webgl: webglUrl };
/** What is in files of its own: what moves a face besides its lips, and what only some stories need. */
export type Part = 'face' | 'more';
const partUrls: Record<Part, Record<Backend, string>> = {
  face: { webgpu: webgpuFaceUrl, webgl: webglFaceUrl },
  more: { webgpu: webgpuMoreUrl, webgl: webglMoreUrl },
};

/** Compiled once a page, by address; each player has an instance of its own. */
const modules = new Map<string, Promise<WebAssembly.Module>>();
/** How a part joins an engine. */
const joins = new WeakMap<Engine, (part: Part) => Promise<void>>();
const instances = new WeakMap<Engine, Instance>();

/** WebGPU where the browser really has an adapter, else WebGL2. */
export async function chooseBackend(): Promise<Backend> {
  const gpu = (navigator as { gpu?: { requestAdapter(): Promise<object | null> } }).gpu;
  if (gpu === undefined) return 'webgl';
  try {
    return (await gpu.requestAdapter()) === null ? 'webgl' : 'webgpu';
  } catch {
    return 'webgl';
  }
}

/** Begins to fetch a build while the story is fetched, too; an engine made later says what went wrong. */
export function warmUp(backend: Backend): void {
  Promise.all([scripts[backend](), compile(urls[backend]), compile(partUrls.face[backend])]).catch(() => undefined);
}

/** A fresh engine that draws on `canvas`, or one without a picture. */
export async function createEngine(backend: Backend, canvas: HTMLCanvasElement | undefined): Promise<Engine> {
  const [script, module] = await Promise.all([scripts[backend](), compile(urls[backend])]);
  const instance = script.default() as Instance;
  const exports = await instance({ module_or_path: module });
  const engine = await instance.Player.create(canvas);
  instances.set(engine, instance);
  // Whoever asks waits for the same, so that they go on in the order in which they came.
  const joined: Partial<Record<Part, Promise<void>>> = {};
  joins.set(engine, (part) => (joined[part] ??= (async () => {
    await WebAssembly.instantiate(await compile(partUrls[part][backend]), { '.': exports });
    instance[`${part}Joined`]();
  })().catch((error: unknown) => {
    // The network may come back.
    delete joined[part];
    throw error;
  })));
  return engine;
}

/** Whom a text chooses to perform it, by an instance of its own: nobody is on stage yet. */
export async function performerOf(backend: Backend, eml: string): Promise<Performer> {
  const [script, module] = await Promise.all([scripts[backend](), compile(urls[backend])]);
  const instance = script.default() as Instance;
  await instance({ module_or_path: module });
  return instance.performerOf(eml);
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

/** Fetches a part into an engine: texts that it reads later are performed with it. */
export async function joinPart(engine: Engine, part: Part): Promise<void> {
  await joins.get(engine)?.(part);
}

function compile(url: string): Promise<WebAssembly.Module> {
  let module = modules.get(url);
  if (module === undefined) {
    module = fetchModule(url);
    modules.set(url, module);
    // A failure is not kept: the network may come back.
    module.catch(() => modules.delete(url));
  }
  return module;
}

async function fetchModule(url: string): Promise<WebAssembly.Module> {
  const response = await fetch(new URL(url, import.meta.url)).catch((error: unknown) => {
    throw new PlayerError('The player could not be fetched: is the network there?', { cause: error });
  });
  if (!response.ok) throw new PlayerError(`The player could not be fetched: the server answered ${response.status}.`);
  // Streaming needs the right MIME type, which not every server sends.
  return response.headers.get('content-type')?.startsWith('application/wasm')
    ? await WebAssembly.compileStreaming(response)
    : await WebAssembly.compile(await response.arrayBuffer());
}
