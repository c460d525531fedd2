import { cpSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';
import { buildDocs } from './web/tools/docs.js';

const root = import.meta.dirname;

/**
 * What a careful server sends. Nothing inline and nothing from elsewhere is needed:
 * wasm is the only thing that script-src must name besides the page's own files.
 */
const headers = {
  'Content-Security-Policy': [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "style-src 'self'",
    "img-src 'self' data:",
    "connect-src 'self'",
    "base-uri 'none'",
    "form-action 'none'",
    "frame-ancestors 'self'",
  ].join('; '),
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'no-referrer',
};

/** Stories and figures are served as they are, under the same address as in the repository; documents become pages. */
function library(): Plugin {
  return {
    name: 'raconteur-library',
    apply: 'build',
    closeBundle() {
      cpSync(join(root, 'assets'), join(root, 'dist/assets'), { recursive: true });
      buildDocs(root, join(root, 'dist'));
    },
  };
}

export default defineConfig({
  root,
  // Addresses are relative, so that dist/ may be served from any folder.
  base: './',
  // A missing file is answered 404, not with the page.
  appType: 'mpa',
  publicDir: false,
  plugins: [library()],
  build: {
    target: 'es2022',
    assetsDir: 'app',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rolldownOptions: {
      input: {
        index: join(root, 'index.html'),
        gestures: join(root, 'gestures/index.html'),
        'raconteur-player': join(root, 'web/element/index.ts'),
      },
      // The element has an address that a page can name.
      preserveEntrySignatures: 'strict',
      output: {
        entryFileNames: (chunk) => (chunk.name === 'raconteur-player' ? '[name].js' : 'app/[name]-[hash].js'),
        chunkFileNames: (chunk) => {
          const backend = /pkg\/(webgpu|webgl|avatar)\//.exec(chunk.facadeModuleId ?? '')?.[1];
          return `app/${backend ?? '[name]'}-[hash].js`;
        },
        // All builds call their file the same; the folder tells them apart.
        assetFileNames: (asset) => {
          const build = asset.originalFileNames.map((name) => /pkg\/(webgpu|webgl|avatar)\//.exec(name)?.[1]).find(Boolean);
          return `app/${build ?? '[name]'}-[hash][extname]`;
        },
      },
    },
  },
  preview: { headers },
  test: { include: ['web/test/**/*.test.ts'] },
});
