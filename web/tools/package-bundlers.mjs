// The bundlers and frameworks that the packed files are tried with: exact versions, and how each builds an application by its defaults.

import { spawn } from 'node:child_process';
import { createServer } from 'node:net';
import { join } from 'node:path';

/** Version of Deno, installed from npm too. */
export const DENO = '2.9.6';

const vite = { bundler: 'vite 8.3.8', build: [['vite', 'build', '--logLevel', 'warn']], served: 'dist' };
const tsc = [['tsc']];
const MAIN = '<script type="module" src="/main.js">';

async function freePort() {
  const server = createServer();
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  const { port } = server.address();
  await new Promise((closed) => server.close(closed));
  return port;
}

/** Serves the build of Next with its own server. */
async function serveNext(app) {
  const port = await freePort();
  const address = `http://127.0.0.1:${port}/`;
  const child = spawn(process.execPath, [join(app, 'node_modules/next/dist/bin/next'), 'start', '--port', String(port)], { cwd: app, stdio: 'ignore', env: { ...process.env, NEXT_TELEMETRY_DISABLED: '1' } });
  for (let tries = 0; tries < 100; tries++) {
    if (await fetch(address).then((response) => response.ok, () => false)) break;
    await new Promise((later) => setTimeout(later, 200));
  }
  return { address, close: () => child.kill() };
}

/**
 * Test matrix. `packages`: packages installed in addition to the example's; `script`: the tag of the page, if the bundler does not write one; `refused`: the
 * message of a page that cannot play.
 */
export const CELLS = {
  'vite-plain': { ...vite, example: 'plain', types: tsc },
  'vite-react': { ...vite, example: 'react', types: tsc },
  'vite-vue': { ...vite, example: 'vue', types: [['vue-tsc']] },
  'vite-svelte': { ...vite, example: 'svelte', types: [['svelte-check', '--tsconfig', './tsconfig.json', '--fail-on-warnings']] },
  'vite-solid': { ...vite, example: 'solid', types: tsc },
  'webpack-plain': {
    bundler: 'webpack 5.113.0',
    example: 'plain',
    packages: { webpack: '5.113.0', 'webpack-cli': '7.3.1' },
    build: [['webpack', './main.js', '--mode', 'production']],
    served: 'dist',
    script: MAIN,
  },
  'rspack-plain': {
    bundler: 'rspack 2.3.3',
    example: 'plain',
    packages: { '@rspack/core': '2.3.3', '@rspack/cli': '2.2.8' },
    build: [['rspack', 'build', '--entry', './main.js', '--mode', 'production']],
    served: 'dist',
    script: MAIN,
  },
  'esbuild-plain': {
    bundler: 'esbuild 0.28.2',
    example: 'plain',
    packages: { esbuild: '0.28.2' },
    build: [['esbuild', 'main.js', '--bundle', '--format=esm', '--outdir=dist']],
    served: 'dist',
    script: MAIN,
  },
  'esbuild-script': {
    bundler: 'esbuild 0.28.2, iife',
    example: 'plain',
    packages: { esbuild: '0.28.2' },
    // Its default, a classic script, does not know its own URL.
    build: [['esbuild', 'main.js', '--bundle', '--outdir=dist']],
    served: 'dist',
    script: MAIN,
    refused: 'was built as a script without an address of its own: build it as a module (esbuild: --format=esm)',
  },
  'rollup-plain': {
    bundler: 'rollup 4.68.8',
    example: 'plain',
    packages: { rollup: '4.68.8', '@rollup/plugin-node-resolve': '16.0.3' },
    // Without a plugin it finds no packages.
    build: [['rollup', 'main.js', '--dir', 'dist', '--plugin', 'node-resolve', '--silent']],
    served: 'dist',
    script: MAIN,
  },
  'parcel-plain': {
    bundler: 'parcel 2.16.4',
    example: 'plain',
    packages: { parcel: '2.16.4' },
    build: [['parcel', 'build', 'index.html', '--no-cache']],
    served: 'dist',
  },
  'next-react': { bundler: 'next 16.4.6 (turbopack)', example: 'next', build: [['next', 'build']], types: [['next', 'typegen'], ...tsc], serve: serveNext },
};
