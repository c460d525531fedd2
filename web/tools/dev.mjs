// `npm run dev [-- --backend webgl|webgpu] [--port N] [--host NAME]`: starts Vite's server with one
// unoptimised wasm build. A change of Rust rebuilds it and reloads the pages; a change of
// TypeScript or CSS reloads the affected modules.

import { mkdirSync, rmSync } from 'node:fs';
import { join, relative } from 'node:path';
import { targetFolder } from './kept.mjs';
import { packages, rust } from './setup.mjs';
import { main, root, serverOptions, start, Stop } from './steps.mjs';

/** Folder of the build; the server serves it in place of both back ends' builds. */
const folder = join(root, 'web/pkg/dev');
const backends = ['webgl', 'webgpu'];
/** Pattern of the build's sources, relative to the root: a change triggers a rebuild. */
const SOURCES = /^(crate\/|web\/tools\/bindgen\/|Cargo\.(toml|lock)$|rust-toolchain\.toml$)/;
/** Debounce interval, because editors save several files at once. */
const SETTLED_MS = 200;

/** Compiles the player and writes its JavaScript side. */
async function build(backend) {
  const since = Date.now();
  const compiled = join(targetFolder(), 'wasm32-unknown-unknown/debug/raconteur_web.wasm');
  await start('cargo', ['build', '--package', 'raconteur-web', '--target', 'wasm32-unknown-unknown', '--no-default-features', '--features', backend]);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  await start('cargo', ['run', '--quiet', '--package', 'raconteur-bindgen', '--', compiled, folder]);
  console.log(`  wasm (${backend}): ${((Date.now() - since) / 1000).toFixed(1)} s`);
}

/** Serves the build, renders with its back end, and rebuilds it when its sources change. */
function player(backend) {
  return {
    name: 'raconteur-dev',
    enforce: 'pre',
    resolveId: (id) => {
      const file = /\/pkg\/(?:webgl|webgpu)\/(raconteur[\w.]+(?:\?\w+)?)$/.exec(id)?.[1];
      return file === undefined ? undefined : join(folder, file);
    },
    transformIndexHtml: (page) => page.replaceAll('<raconteur-player', `<raconteur-player backend="${backend}"`),
    configureServer(server) {
      let timer;
      let building = false;
      const rebuild = async () => {
        // Changes during a build are built next.
        if (building) return later();
        building = true;
        try {
          await build(backend);
          server.moduleGraph.invalidateAll();
          server.ws.send({ type: 'full-reload' });
        } catch (error) {
          console.error(`raconteur: ${error.message}`);
        }
        building = false;
      };
      const later = () => {
        clearTimeout(timer);
        timer = setTimeout(rebuild, SETTLED_MS);
      };
      server.watcher.on('all', (_, path) => {
        if (SOURCES.test(relative(root, path).replaceAll('\\', '/'))) later();
      });
    },
  };
}

await main(async () => {
  const { backend = 'webgl', port, host } = serverOptions('npm run dev [-- --backend webgl|webgpu] [--port N] [--host NAME]', {
    backend: { type: 'string' },
  });
  if (!backends.includes(backend)) throw new Stop(`--backend wants ${backends.join(' or ')}, not ${backend}.`);
  await packages();
  await rust();
  await build(backend);
  const { createServer } = await import('vite');
  // Generated files are not watched; the build above reloads pages itself.
  const ignored = ['target', 'dist', '.setup', 'web/pkg', 'test-results'].map((name) => join(root, name, '**'));
  const server = await createServer({
    root,
    plugins: [player(backend)],
    server: { port: port ?? 5173, strictPort: port !== undefined, host: host ?? 'localhost', watch: { ignored } },
  });
  await server.listen();
  console.log('\nRaconteur is on stage, and follows what you change:');
  server.printUrls();
  console.log('  Press Ctrl+C to stop.\n');
});
