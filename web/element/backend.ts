/** Chooses between the two wasm builds and makes engines from them. */

import webglUrl from '../pkg/webgl/raconteur_bg.wasm?url';
import webgpuUrl from '../pkg/webgpu/raconteur_bg.wasm?url';
import { PlayerError, type Backend, type Engine } from './types.js';

/** What the JavaScript side of a build gives for one instance. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  Player: { create(canvas: HTMLCanvasElement | undefined): Promise<Engine> };
}

const scripts: Record<Backend, () => Promise<{ default: () => unknown }>> = {
  webgpu: () => import('../pkg/webgpu/raconteur.js'),
  webgl: () => import('../pkg/webgl/raconteur.js'),
};
const urls: Record<Backend, string> = { webgpu: webgpuUrl, webgl: webglUrl };

/** Compiled once a page; each player has an instance of its own. */
const modules = new Map<Backend, Promise<WebAssembly.Module>>();

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
  Promise.all([scripts[backend](), compile(backend)]).catch(() => undefined);
}

/** A fresh engine that draws on `canvas`, or one without a picture. */
export async function createEngine(backend: Backend, canvas: HTMLCanvasElement | undefined): Promise<Engine> {
  const [script, module] = await Promise.all([scripts[backend](), compile(backend)]);
  const instance = script.default() as Instance;
  await instance({ module_or_path: module });
  return await instance.Player.create(canvas);
}

function compile(backend: Backend): Promise<WebAssembly.Module> {
  let module = modules.get(backend);
  if (module === undefined) {
    module = fetchModule(urls[backend]);
    modules.set(backend, module);
    // A failure is not kept: the network may come back.
    module.catch(() => modules.delete(backend));
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
