/** Types of the part of meshoptimizer's decoder used by the tests, as bundled with three.js; it has no types of its own there. */
declare module 'three/addons/libs/meshopt_decoder.module.js' {
  export const MeshoptDecoder: {
    ready: Promise<void>;
    decodeGltfBuffer(target: Uint8Array, count: number, size: number, source: Uint8Array, mode: string, filter?: string): void;
  };
}
