/** What a canvas holds of the graphics card, and how it is given back. */

import type { Backend } from '../base/types.js';

/** The parts of WebGPU that are used here; TypeScript's library does not have them. */
interface GpuContext {
  getConfiguration?(): { readonly device?: { destroy(): void } } | null;
  unconfigure(): void;
}

/**
 * Gives back what a canvas holds: the device of WebGPU with all its textures, buffers and pipelines, or
 * the context of WebGL. Both live until garbage collection otherwise, of which the browser knows no
 * need: to it each of them is a small object.
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
