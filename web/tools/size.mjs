// What a page downloads for one player, per back end, against the budget; compressed
// ahead, as for a server of static files.

import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { main, root, Stop } from './steps.mjs';

/** KB of 1,000 bytes, gzip: JavaScript and wasm of one player that speaks and feels. */
const budgets = { webgpu: 600, webgl: 1200 };
/** Scripts of pages, KB; most of the gestures' is the editor. */
const pages = { gestures: 170, viewer: 17, face: 18 };

/** Node's own deflate gives up 2 % of size for speed, so the usual program is asked where it is there. */
function gzip9(part) {
  const { status, stdout } = spawnSync('gzip', ['-9', '-c'], { input: part, maxBuffer: 1e8 });
  return status === 0 ? stdout : gzipSync(part, { level: 9 });
}

await main(async () => {
  const folder = join(root, 'dist/app');
  if (!existsSync(folder)) throw new Stop('There is no dist/: run "npm run build" first.');
  const files = readdirSync(folder).map((name) => join(folder, name));
  const entry = join(root, 'dist/raconteur-player.js');
  const over = [];
  const measure = (name, paths, budget) => {
    const parts = paths.map((path) => readFileSync(path));
    const sum = (compress) => parts.reduce((total, part) => total + compress(part).length, 0) / 1000;
    const [gzip, brotli] = [sum(gzip9), sum(brotliCompressSync)];
    console.log(`${name}: ${gzip.toFixed(1)} KB gzip, ${brotli.toFixed(1)} KB brotli; budget ${budget} KB gzip`);
    if (gzip > budget) over.push(name);
  };
  const named = (pattern) => files.filter((path) => pattern.test(basename(path)));
  /** A script with every file of the build that it names, directly or through others, but for `without`. */
  const reach = (start, without) => {
    const found = new Set([start]);
    for (const path of found) {
      if (!path.endsWith('.js')) continue;
      const text = readFileSync(path, 'utf8');
      for (const other of files) if (!without.test(basename(other)) && text.includes(basename(other))) found.add(other);
    }
    return [...found].filter((path) => /\.(js|wasm)$/.test(path));
  };
  // What only some players fetch: the importer of foreign avatars, what connects to a mind, what
  // plays music, the browser's own voice, what keeps the pitch at other speeds, and what else only some stories need.
  for (const [backend, budget] of Object.entries(budgets)) {
    const other = backend === 'webgpu' ? 'webgl' : 'webgpu';
    measure(backend, reach(entry, new RegExp(`^(avatar|mind|music|spoken|stretch|more|(face-)?${other})-`)), budget);
  }
  measure('avatar', named(/^avatar-/), 250);
  measure('mind', named(/^mind-/), 4);
  measure('music', named(/^music-/), 3);
  measure('spoken', named(/^spoken-/), 3);
  measure('stretch', named(/^stretch-/), 2);
  for (const backend of Object.keys(budgets)) {
    measure(`more ${backend}`, named(new RegExp(`^more-${backend}-`)), 90);
  }
  // What pages of their own add to the player.
  const player = reach(entry, /^$/);
  for (const [page, budget] of Object.entries(pages)) {
    const [script] = named(new RegExp(`^${page}-.*\\.js$`));
    if (script === undefined) throw new Stop(`dist/ has no script of the page ${page}.`);
    measure(`page ${page}`, reach(script, /^$/).filter((path) => !player.includes(path)), budget);
  }
  if (over.length > 0) throw new Stop(`The ${over.join(' and ')} build is over its budget.`);
});
