// Measures the download size of a page with one player, per back end, against the budget; files are
// compressed in advance, as on a static server.

import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { main, root, Stop } from './steps.mjs';

/** Size budgets, KB of 1,000 bytes, gzip: JavaScript and wasm of one player with speech and emotions. */
const budgets = { webgpu: 600, webgl: 1200 };
/** KB, brotli: everything that a page fetches before a story's first word. */
const firstWord = 2500;
const story = join(root, 'assets/stories/white-rabbit');
/** Scripts that several pages share, KB. */
const sharedByPages = 13;
/** Savings of plain builds, each measured once: gzip kilobytes less for a WebGPU player. */
const replaced = [
  { what: 'players, manipulators, live clauses and music in a file fetched only where asked for', kb: 71.4, at: '1e7f1e2' },
  { what: 'a standard library compiled anew, panics without messages, functions sorted by likeness, short import names, two rounds of -Oz', kb: 57.2, at: 'f2816ef' },
  { what: 'own readers of JSON and of numbers, and short names in shaders (106.4 measured at 59bf609 with typed glTF, less the 54 that went with it)', kb: 52.4, at: '2a753a2' },
];
/** Size budgets of page scripts without shared code, KB; most of the gestures' is the editor. */
const pages = { gestures: 150, transcribe: 16, viewer: 13, face: 10, expression: 8, composite: 300 };

/**
 * Files fetched only by some players: annotation reader, avatar importer, in-page speech and its engines, narration, mind connection, music, browser speech, time stretching, and
 * film.
 */
const apart = 'added annotate avatar faces film flite here kokoro marks mind music natural say server spoken src stretch tell told vtt worker'.split(' ');

/** Returns the gzip size. Node's own deflate trades 2 % of size for speed, so the `gzip` program is used if installed. */
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
  /** Returns a script with every build file that it names, directly or indirectly, except `without`. */
  const reach = (start, without) => {
    const found = new Set([start]);
    for (const path of found) {
      if (!path.endsWith('.js')) continue;
      const text = readFileSync(path, 'utf8');
      for (const other of files) if (!without.test(basename(other)) && text.includes(basename(other))) found.add(other);
    }
    return [...found].filter((path) => /\.(js|wasm)$/.test(path));
  };
  /** Measures the download before the first word of a story: its page, the player, the figure, the text, its voice. */
  const measureFirstWord = () => {
    const voice = join(story, 'voice');
    const { utterances } = JSON.parse(readFileSync(join(voice, 'speech.json'), 'utf8'));
    const sound = join(voice, utterances[0].audio[0].file);
    const page = [join(root, 'dist/index.html'), ...named(/^(index|player|markup)-.*\.css$/)];
    const told = [join(root, 'assets/figures/sofia.glb'), join(story, 'story.eml'), join(voice, 'speech.json'), sound];
    const paths = [...page, ...reach(entry, new RegExp(`^(${apart.join('|')}|webgl)-`)), ...told];
    const kb = paths.reduce((total, path) => total + brotliCompressSync(readFileSync(path)).length, 0) / 1000;
    console.log(`first word on webgpu: ${kb.toFixed(1)} KB brotli; budget ${firstWord} KB`);
    if (kb > firstWord) over.push('first word');
  };
  // Files that only some players fetch have limits of their own; speech engines that run in the
  // page are third-party software and have none.
  for (const [backend, budget] of Object.entries(budgets)) {
    const other = backend === 'webgpu' ? 'webgl' : 'webgpu';
    measure(backend, reach(entry, new RegExp(`^(${apart.join('|')}|${other})-`)), budget);
  }
  measure('annotate', named(/^annotate-/), 400);
  measure('avatar', named(/^avatar-/), 250);
  measure('faces', named(/^faces-.*wasm$/), 250);
  measure('say', named(/^(say|here|flite-worker)-/), 1300);
  measure('mind', named(/^mind-/), 4);
  measure('music', named(/^music-/), 3);
  measure('spoken', named(/^spoken-/), 3);
  measure('stretch', named(/^stretch-/), 2);
  // Files that pages add to the player; a file shared by several pages counts once.
  const player = reach(entry, /^$/);
  const added = Object.keys(pages).map((page) => {
    const [script] = named(new RegExp(`^${page}-.*\\.js$`));
    if (script === undefined) throw new Stop(`dist/ has no script of the page ${page}.`);
    return [page, reach(script, /^$/).filter((path) => !player.includes(path))];
  });
  const isShared = (path) => added.filter(([, paths]) => paths.includes(path)).length > 1;
  measure('pages, shared', [...new Set(added.flatMap(([, paths]) => paths))].filter(isShared), sharedByPages);
  for (const [page, paths] of added) measure(`page ${page}`, paths.filter((path) => !isShared(path)), pages[page]);
  measureFirstWord();
  console.log('\nWhat plain builds gave up, KB gzip of WebGPU:');
  for (const { what, kb, at } of replaced) console.log(`  ${kb.toFixed(1)}: ${what} (measured at ${at})`);
  if (over.length > 0) throw new Stop(`The ${over.join(' and ')} build is over its budget.`);
});
