// Finds the files that make up the pages of the site and the browser tests. A file depends on
// another if its source contains the relative path in quotation marks. Uses only Node's own
// modules.

import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { root } from './steps.mjs';

/** Targets of browser tests, and their entry files. */
export const ENTRIES = {
  home: ['index.html'],
  viewer: ['web/pages/viewer/index.html'],
  gestures: ['web/pages/gestures/index.html'],
  transcribe: ['web/pages/transcribe/index.html'],
  face: ['web/pages/face/index.html'],
  expression: ['web/pages/expression/index.html'],
  composite: ['web/pages/composite/index.html', 'web/composite/index.ts'],
  docs: ['docs', 'README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'SECURITY.md', 'web/tools/docs.ts', 'web/pages/docs.css'],
  player: ['web/element/index.ts'],
  course: ['web/course/index.ts', 'web/tools/course.ts'],
};

/** The folder of the tests in a browser. */
export const SPECS = 'tests/browser';

/** Returns the targets of each spec in addition to the player, which is on every page. */
export const visits = () => JSON.parse(readFileSync(join(root, SPECS, 'visits.json'), 'utf8'));

/** Returns the target of a site address by its path; undefined for files served only by a test. */
export function visitedAt(path) {
  const [, script] = /^\/raconteur-(composite|course)\.js$/.exec(path) ?? [];
  const [, folder = ''] = path.split('/');
  const name = script ?? (folder === '' || folder === 'index.html' ? 'home' : folder);
  return name in ENTRIES ? name : undefined;
}

const isFile = (path) => existsSync(join(root, path)) && statSync(join(root, path)).isFile();

/** Resolves a name in `from` to a file, relative to the root; undefined if it is not a file. */
function named(from, name) {
  const [path = ''] = name.split(/[?#]/);
  if (path === '') return undefined;
  const places = path.startsWith('/') ? [path.slice(1)] : [relative(root, join(root, dirname(from), path))];
  return places.flatMap((place) => [place, place.replace(/\.js$/, '.ts')]).find(isFile);
}

const read = new Map();

/** Returns the files that a file names; reads each file once. */
function names(file) {
  const found = read.get(file) ?? namesIn(file);
  read.set(file, found);
  return found;
}

function namesIn(file) {
  if (!/\.(ts|mjs|css|html)$/.test(file)) return [];
  const text = readFileSync(join(root, file), 'utf8');
  const quoted = [...text.matchAll(/["'(]((?:\.{1,2}\/|\/)[^"'()\s]+)["')]/g)].map(([, name = '']) => named(file, name));
  const parts = [...text.matchAll(/<!-- part: ([\w-]+) -->/g)].map(([, name]) => `web/pages/parts/${name}.html`);
  return [...quoted, ...parts].filter((name) => name !== undefined && isFile(name));
}

const inside = (path) => (isFile(path) ? [path] : readdirSync(join(root, path), { recursive: true, encoding: 'utf8' }).map((name) => `${path}/${name}`).filter(isFile));

/** Returns all files reachable from the given ones, including them; a folder stands for its contents. */
export function reached(begins) {
  const found = new Set(begins.filter((path) => existsSync(join(root, path))).flatMap(inside));
  for (const file of found) for (const name of names(file)) found.add(name);
  return found;
}

/** Returns the specs affected by web files, and the files not used by any page, element or spec. A spec depends on its imports and on its targets. */
export function specsOf(files) {
  const parts = Object.fromEntries(Object.entries(ENTRIES).map(([name, begins]) => [name, reached(begins)]));
  const known = new Set(Object.values(parts).flatMap((all) => [...all]));
  const specs = [];
  for (const [spec, visited] of Object.entries(visits())) {
    // A spec imports files of the element only for their types; the files it visits are already
    // counted.
    const own = new Set([...reached([`${SPECS}/${spec}`])].filter((file) => !file.startsWith('web/') || !known.has(file)));
    for (const file of own) known.add(file);
    if (files.some((file) => own.has(file) || ['player', ...visited].some((name) => parts[name].has(file)))) specs.push(spec);
  }
  return { specs, unknown: files.filter((file) => !known.has(file)) };
}
