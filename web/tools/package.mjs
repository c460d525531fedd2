// Packs the player for npm: `node web/tools/package.mjs [quick]` writes `.setup/package/*.tgz`, the player and its library
// of assets. `quick` packs the build of the tests.

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, runnerImport } from 'vite';
import { manifest } from './elements.mjs';
import { main, root, run } from './steps.mjs';
import { buildWasm, kinds } from './wasm.mjs';

const folder = join(root, '.setup/package');
const { version, license, dependencies } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
/** Folders of the library that a page needs; what is measured or described beside them is not packed. */
const LIBRARY = ['figures', 'animations', 'faces', 'music', 'stories', 'hand-shapes'];

const packageOf = (name, description, rest) => ({ name, version, description, license, type: 'module', ...rest });

/** Types of the element in templates, and the packages whose they are. */
const FRAMEWORKS = ['react', 'vue', 'svelte', 'solid', 'jsx'];

const LIT = /^(@lit\/reactive-element|lit(-html|-element)?)($|\/)/;
const NO_DOCUMENT = '@lit-labs/ssr-dom-shim';
/**
 * The build of lit that can be imported where there is no document, as in a worker: the one that Node finds. What that has for making
 * pages ahead is left out.
 */
const litAnywhere = {
  name: 'lit-anywhere',
  enforce: 'pre',
  resolveId: (source) => (source === NO_DOCUMENT ? source : LIT.test(source) ? fileURLToPath(import.meta.resolve(source)) : undefined),
  load: (id) => (id === NO_DOCUMENT ? 'export class HTMLElement {}\nexport const customElements = undefined;\n' : undefined),
};

/** Bundlers take an address from `import.meta.url` for a file of theirs, and copy a worker without what it loads; its plain name they leave alone. */
const plainWorkers = (file) => (/-worker-[\w-]+\.js$/.test(file) ? { runtime: JSON.stringify(file) } : { relative: true });

/**
 * A script and all that it loads: chunks by their names, wasm beside them by `new URL(…, import.meta.url)`, which bundlers know. Names
 * tell contents, so what several scripts have in common is there once.
 */
async function script(kind, to, name, { external = [], plugins = [] }) {
  await build({
    configFile: false,
    root,
    base: './',
    publicDir: false,
    logLevel: 'warn',
    plugins,
    resolve: { alias: [{ find: /^\.\.\/pkg\//, replacement: `${join(root, kind.folder)}/` }] },
    worker: { format: 'es' },
    experimental: { renderBuiltUrl: plainWorkers },
    build: {
      target: 'es2022',
      outDir: to,
      emptyOutDir: false,
      assetsDir: '.',
      assetsInlineLimit: 0,
      modulePreload: false,
      rolldownOptions: {
        input: { [name]: join(root, `web/package/player/${name}.ts`) },
        external,
        preserveEntrySignatures: 'strict',
        output: { entryFileNames: '[name].js', chunkFileNames: '[name]-[hash].js', assetFileNames: '[name]-[hash][extname]' },
      },
    },
  });
}

/** Declarations of what the scripts export, and of the element for frameworks. */
function types(to) {
  run(process.execPath, ['node_modules/typescript/bin/tsc', '--project', 'web/package', '--outDir', to], { why: 'Declaring the types of the package' });
  for (const name of ['attributes', ...FRAMEWORKS]) cpSync(join(root, `web/package/player/${name}.d.ts`), join(to, `web/package/player/${name}.d.ts`));
}

/** What a page can import, and where it is. */
function entries() {
  const declared = './types/web/package/player';
  const scripts = Object.entries({ '.': 'player', './standalone': 'standalone' });
  return {
    ...Object.fromEntries(scripts.map(([entry, name]) => [entry, { types: `${declared}/${name}.d.ts`, default: `./dist/${name}.js` }])),
    ...Object.fromEntries(FRAMEWORKS.map((name) => [`./${name}`, { types: `${declared}/${name}.d.ts` }])),
    './custom-elements.json': './custom-elements.json',
    './package.json': './package.json',
  };
}

function pack(name, about) {
  const own = join(folder, name);
  writeFileSync(join(own, 'package.json'), `${JSON.stringify(about, undefined, 2)}\n`);
  for (const file of ['LICENSE-MIT', 'LICENSE-APACHE']) cpSync(join(root, file), join(own, file));
  cpSync(join(root, 'web/package', name, 'README.md'), join(own, 'README.md'));
  run(process.platform === 'win32' ? 'npm.cmd' : 'npm', ['pack', '--silent', '--pack-destination', folder], { cwd: own, shell: process.platform === 'win32', why: `Packing ${name}` });
}

await main(async () => {
  const kind = process.argv[2] === 'quick' ? kinds.quick : kinds.shipped;
  await buildWasm(kind);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, 'player'), { recursive: true });
  const dist = join(folder, 'player/dist');
  // Pages have lit once, whoever else uses it; a script tag finds no packages.
  await script(kind, dist, 'player', { external: LIT });
  await script(kind, dist, 'standalone', { plugins: [litAnywhere] });
  types(join(folder, 'player/types'));
  writeFileSync(join(folder, 'player/custom-elements.json'), `${JSON.stringify(await manifest('dist/player.js'), undefined, 2)}\n`);
  const { module: written } = await runnerImport(join(root, 'web/tools/notices.ts'), { root, configFile: false, logLevel: 'error' });
  writeFileSync(join(folder, 'player/THIRD-PARTY-NOTICES.txt'), written.notices(root));
  pack('player', packageOf('@raconteur/player', 'A virtual storyteller as a custom element: a text in, a speaking and gesturing human figure out.', {
    keywords: ['custom-element', 'storytelling', 'virtual-human', 'lip-sync', 'webgpu', 'wasm'],
    exports: entries(),
    // For bundlers that do not look at `exports`.
    main: './dist/player.js',
    module: './dist/player.js',
    types: './types/web/package/player/player.d.ts',
    customElements: './custom-elements.json',
    // Importing it registers the element.
    sideEffects: ['./dist/player.js', './dist/standalone.js'],
    dependencies: { lit: dependencies.lit },
  }));
  mkdirSync(join(folder, 'assets/library'), { recursive: true });
  for (const part of LIBRARY) cpSync(join(root, 'assets', part), join(folder, 'assets/library', part), { recursive: true });
  cpSync(join(root, 'web/package/assets/copy.mjs'), join(folder, 'assets/copy.mjs'));
  pack('assets', packageOf('@raconteur/assets', 'Figures, animations and stories for @raconteur/player.', {
    bin: { 'raconteur-assets': './copy.mjs' },
    exports: { './library/*': './library/*', './package.json': './package.json' },
    // What a page's build leaves behind of the player is copied with the library.
    peerDependencies: { '@raconteur/player': version },
  }));
  console.log(`Packed in ${folder}`);
});
