/** GPU resources of a canvas and their release. */

import type { Backend } from '../base/types.js';

/** Subset of WebGPU used here; TypeScript's library lacks it. */
interface GpuContext {
  getConfiguration?(): { readonly device?: { destroy(): void } } | null;
  unconfigure(): void;
}

/**
 * Releases the resources of a canvas: the WebGPU device with all its textures, buffers and pipelines, or the WebGL context. Otherwise both live until garbage
 * collection, which the browser has no reason to run: it considers each a small object.
 */
export function giveBack(canvas: HTMLCanvasElement, backend: Backend): void {
  try {
    if (backend === 'webgl') {
      canvas.getContext('webgl2')?.getExtension('WEBGL_lose_context')?.loseContext();
      return;
    }
    const context = canvas.getContext('webgpu') as unknown as GpuContext | null;
    // An engine that trapped did not destroy its device.
    context?.getConfiguration?.()?.device?.destroy();
    context?.unconfigure();
  } catch {
    // It is lost already.
  }
}
