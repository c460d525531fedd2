// Packs the player for npm: `node web/tools/package.mjs [quick]` writes `.setup/package/*.tgz`, the player and its library
// of assets. `quick` packs the build of the tests.

import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'vite';
import { main, root, run } from './steps.mjs';
import { buildWasm, kinds } from './wasm.mjs';

const folder = join(root, '.setup/package');
const { version, license, dependencies } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
/** Folders of the library that a page needs; what is measured or described beside them is not packed. */
const LIBRARY = ['figures', 'animations', 'faces', 'music', 'stories', 'hand-shapes'];

const about = (name, description, rest) => ({ name, version, description, license, type: 'module', ...rest });

/** The script: chunks by their names, wasm beside them by `new URL(…, import.meta.url)`, which bundlers know. */
async function script(kind, to) {
  await build({
    configFile: false,
    root,
    base: './',
    publicDir: false,
    logLevel: 'warn',
    resolve: { alias: [{ find: /^\.\.\/pkg\//, replacement: `${join(root, kind.folder)}/` }] },
    worker: { format: 'es' },
    build: {
      target: 'es2022',
      outDir: to,
      emptyOutDir: true,
      assetsDir: '.',
      assetsInlineLimit: 0,
      modulePreload: false,
      rolldownOptions: {
        input: { player: join(root, 'web/package/player/player.ts') },
        // Pages have it once, whoever else uses it.
        external: /^lit($|\/)/,
        preserveEntrySignatures: 'strict',
        output: { entryFileNames: '[name].js', chunkFileNames: '[name]-[hash].js', assetFileNames: '[name]-[hash][extname]' },
      },
    },
  });
}

/** Declarations of what the script exports. */
function types(to) {
  run(process.execPath, ['node_modules/typescript/bin/tsc', '--project', 'web/package', '--outDir', to], { why: 'Declaring the types of the package' });
}

function pack(name, manifest) {
  const own = join(folder, name);
  writeFileSync(join(own, 'package.json'), `${JSON.stringify(manifest, undefined, 2)}\n`);
  for (const file of ['LICENSE-MIT', 'LICENSE-APACHE']) cpSync(join(root, file), join(own, file));
  cpSync(join(root, 'web/package', name, 'README.md'), join(own, 'README.md'));
  run(process.platform === 'win32' ? 'npm.cmd' : 'npm', ['pack', '--silent', '--pack-destination', folder], { cwd: own, shell: process.platform === 'win32', why: `Packing ${name}` });
}

await main(async () => {
  const kind = process.argv[2] === 'quick' ? kinds.quick : kinds.shipped;
  await buildWasm(kind);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, 'player'), { recursive: true });
  await script(kind, join(folder, 'player/dist'));
  types(join(folder, 'player/types'));
  cpSync(join(root, 'web/package/player/jsx.d.ts'), join(folder, 'player/types/web/package/player/jsx.d.ts'));
  const declared = './types/web/package/player';
  pack('player', about('@raconteur/player', 'A virtual storyteller as a custom element: a text in, a speaking and gesturing human figure out.', {
    keywords: ['custom-element', 'storytelling', 'virtual-human', 'lip-sync', 'webgpu', 'wasm'],
    exports: { '.': { types: `${declared}/player.d.ts`, default: './dist/player.js' }, './jsx': { types: `${declared}/jsx.d.ts` }, './package.json': './package.json' },
    // Importing it registers the element.
    sideEffects: ['./dist/player.js'],
    dependencies: { lit: dependencies.lit },
  }));
  mkdirSync(join(folder, 'assets/library'), { recursive: true });
  for (const part of LIBRARY) cpSync(join(root, 'assets', part), join(folder, 'assets/library', part), { recursive: true });
  // Where a page's build leaves modules behind, they are fetched from here.
  const modules = readdirSync(join(folder, 'player/dist')).filter((name) => name.startsWith('raconteur_bg-'));
  for (const name of modules) cpSync(join(folder, 'player/dist', name), join(folder, 'assets/library/player', name));
  cpSync(join(root, 'web/package/assets/copy.mjs'), join(folder, 'assets/copy.mjs'));
  pack('assets', about('@raconteur/assets', 'Figures, animations and stories for @raconteur/player.', { bin: { 'raconteur-assets': './copy.mjs' }, exports: { './library/*': './library/*', './package.json': './package.json' } }));
  console.log(`Packed in ${folder}`);
});
