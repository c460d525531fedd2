// Tests the packed files like users of ten bundlers and frameworks: copies each example to an empty
// folder, installs it with npm, checks its types, builds it with the bundler's defaults, serves it
// and plays it to its end in a browser. node web/tools/package-cells.mjs [--pictures FOLDER]
// [NAME…]

import { spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { delimiter, join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { IMPORTED, IMPORTS } from './package-bare.mjs';
import { CELLS, DENO } from './package-bundlers.mjs';
import { copyLibrary, openBrowser, play, refuse, serve } from './package-play.mjs';
import { ask, main, root, Stop } from './steps.mjs';

const packed = join(root, '.setup/package');
const folder = join(root, '.setup/package-cells');
const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
/** Files generated in an example's folder, which are not part of the example. */
const MADE = new Set(['node_modules', 'dist', '.next', 'public', 'package-lock.json', 'next-env.d.ts']);
const FAILS = 'fails';
const PLAY = 'main p > button';
const INSTALL = ['npm', 'install', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel=error'];

const packedFile = (part) => `file:${join(packed, `raconteur-${part}-${version}.tgz`)}`;

/** Runs an npm program in an application's folder; its output is shown on failure. */
function program(app, [name, ...args], why = `${name} ${args.join(' ')}`) {
  const env = { ...process.env, NEXT_TELEMETRY_DISABLED: '1', PATH: `${join(app, 'node_modules/.bin')}${delimiter}${process.env['PATH']}` };
  const { status, stdout, stderr } = spawnSync(name, args, { cwd: app, encoding: 'utf8', env, shell: process.platform === 'win32' });
  if (status === 0) return;
  console.error(`${stdout ?? ''}${stderr ?? ''}`.slice(-6000));
  throw new Stop(`${why} failed (exit ${status}).`);
}

/** Lays an example into an empty folder, with a bundler that is not its own, and installs it. */
function lay(name, { example, packages = {}, files = {} }) {
  const app = join(folder, name);
  rmSync(app, { recursive: true, force: true });
  cpSync(join(root, 'examples', example), app, { recursive: true, filter: (path) => !MADE.has(path.split(/[\\/]/).at(-1)) });
  const manifest = JSON.parse(readFileSync(join(app, 'package.json'), 'utf8'));
  for (const part of ['library', 'player', 'voice-flite']) manifest.dependencies[`@raconteur/${part}`] = packedFile(part);
  Object.assign(manifest.devDependencies, packages);
  if (Object.keys(packages).length > 0) delete manifest.devDependencies.vite;
  writeFileSync(join(app, 'package.json'), JSON.stringify(manifest, undefined, 2));
  for (const [file, text] of Object.entries(files)) writeFileSync(join(app, file), text);
  program(app, INSTALL, `Installing ${name}`);
  copyLibrary(app, join(app, 'node_modules/@raconteur/library'), ['--stories', 'hello-world', '--voices', 'flite']);
  return app;
}

/** Builds a page if the bundler does not: the example's page with the built script. */
function layPage(app, { served, script }) {
  if (script === undefined) return;
  const page = readFileSync(join(app, 'index.html'), 'utf8').replace(/<script type="module" src="[^"]+">/, script);
  writeFileSync(join(app, served, 'index.html'), page);
}

/** Checks the types of the example, and that the mistakes in `web/package/types` are detected. */
function checkTypes(app, { example, types }) {
  if (types === undefined) return;
  const wrong = { plain: 'wrong.js', react: 'src/wrong.tsx', next: 'app/wrong.tsx', vue: 'src/wrong.vue', svelte: 'src/wrong.svelte', solid: 'src/wrong.tsx' }[example];
  cpSync(join(root, 'web/package/types', `${example}.${wrong.split('.').at(-1)}`), join(app, wrong));
  for (const command of types) program(app, command);
  rmSync(join(app, wrong));
}

/** Imports it in Deno, where there is no document either. */
function tryDeno() {
  const app = join(folder, 'deno');
  rmSync(app, { recursive: true, force: true });
  mkdirSync(app, { recursive: true });
  writeFileSync(join(app, 'package.json'), JSON.stringify({ private: true, type: 'module', dependencies: { '@raconteur/player': packedFile('player'), deno: DENO } }));
  writeFileSync(join(app, 'import.js'), IMPORTS);
  program(app, INSTALL, 'Installing Deno');
  if (ask(join(app, 'node_modules/.bin/deno'), ['run', '--quiet', '--allow-env', join(app, 'import.js')])?.trim() !== IMPORTED) throw new Stop('The package cannot be imported in Deno.');
  return { cell: 'deno', bundler: `deno ${DENO}`, outcome: 'imports', types: '', secs: 0 };
}

async function tryCell(browser, name, cell, pictures) {
  const began = performance.now();
  const app = lay(name, cell);
  checkTypes(app, cell);
  for (const command of cell.build) program(app, command);
  layPage(app, cell);
  if (cell.served !== undefined && !existsSync(join(app, cell.served, 'raconteur'))) cpSync(join(app, 'public/raconteur'), join(app, cell.served, 'raconteur'), { recursive: true });
  const server = cell.serve ? await cell.serve(app) : await serve(join(app, cell.served));
  try {
    if (cell.refused !== undefined) await refuse(browser, server.address, cell.refused);
    else await play(browser, name, server.address, { button: PLAY, ...(pictures ? { picture: join(pictures, `${name}.png`) } : {}) });
  } finally {
    server.close();
  }
  return { cell: name, bundler: cell.bundler, outcome: cell.refused === undefined ? 'plays' : 'refuses', types: cell.types === undefined ? '' : 'checked', secs: Math.round((performance.now() - began) / 1000) };
}

await main(async () => {
  if (!existsSync(packed)) throw new Stop('There are no packed files: run "npm run package" first.');
  const { values, positionals } = parseArgs({ allowPositionals: true, options: { pictures: { type: 'string' } } });
  const pictures = values.pictures && resolve(values.pictures);
  if (pictures) mkdirSync(pictures, { recursive: true });
  const tried = { ...CELLS, deno: undefined };
  const unknown = positionals.find((name) => !(name in tried));
  if (unknown !== undefined) throw new Stop(`There is no cell ${unknown}; there are ${Object.keys(tried).join(', ')}.`);
  const browser = await openBrowser();
  const rows = [];
  try {
    for (const [name, cell] of Object.entries(tried)) {
      if (positionals.length > 0 && !positionals.includes(name)) continue;
      try {
        rows.push(cell === undefined ? tryDeno() : await tryCell(browser, name, cell, pictures));
      } catch (error) {
        // The other examples run too, so that one run reports all failures.
        console.error(`  ${error.message}`);
        rows.push({ cell: name, bundler: cell?.bundler, outcome: FAILS, types: '', secs: 0 });
      }
      console.log(`  ${name}: ${rows.at(-1).outcome}`);
    }
  } finally {
    await browser.close();
  }
  console.table(rows);
  const failed = rows.filter(({ outcome }) => outcome === FAILS);
  if (failed.length > 0) throw new Stop(`These fail: ${failed.map(({ cell }) => cell).join(', ')}.`);
});
