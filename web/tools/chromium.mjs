/** Arguments of Chromium: software rendering provides both WebGPU (SwiftShader) and WebGL2 (Mesa) on a machine without a graphics card. */
export const chromiumArgs = [
  '--no-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--enable-unsafe-webgpu',
  '--use-angle=gl-egl',
  '--ignore-gpu-blocklist',
  '--autoplay-policy=no-user-gesture-required',
];
