// Determines the checks that a change needs, from the graph of crates. Uses only Node's own
// modules.

import { specsOf, visits } from './graph.mjs';
import { ask, Stop } from './steps.mjs';

/** Returns the files that differ from `main`, committed or not, and new ones that git does not ignore. */
function changedFiles() {
  const base = ask('git', ['merge-base', 'HEAD', 'main'])?.trim();
  if (base === undefined) throw new Stop('--changed compares with the branch main, and there is none.');
  const lists = [ask('git', ['diff', '--name-only', base]), ask('git', ['ls-files', '--others', '--exclude-standard'])];
  return lists.flatMap((list) => (list ?? '').split('\n')).filter(Boolean);
}

/** Returns the workspace packages by name, each with its folder in the tree and the packages it uses, those of its tests included or not. */
export function packages({ tests = true } = {}) {
  const text = ask('cargo', ['metadata', '--locked', '--no-deps', '--format-version', '1']);
  if (text === undefined) throw new Stop('cargo metadata failed.');
  const { packages: all, workspace_root: root } = JSON.parse(text);
  return new Map(
    all.map(({ name, manifest_path: manifest, dependencies }) => [
      name,
      { folder: manifest.slice(root.length + 1, -'Cargo.toml'.length), uses: dependencies.filter(({ kind }) => tests || kind !== 'dev').map((d) => d.name) },
    ]),
  );
}

/** Returns the changed crates, and all their dependants. */
export function affected(files, crates) {
  const hit = new Set([...crates].filter(([, { folder }]) => files.some((file) => file.startsWith(folder))).map(([name]) => name));
  for (let before = -1; before !== hit.size; ) {
    before = hit.size;
    for (const [name, { uses }] of crates) if (uses.some((used) => hit.has(used))) hit.add(name);
  }
  return [...hit].sort();
}

/** Folders of a workspace package and of all that it is compiled from. */
export function sources(name, crates = packages({ tests: false })) {
  const found = new Set([name]);
  for (const one of found) for (const used of crates.get(one)?.uses ?? []) if (crates.has(used)) found.add(used);
  return [...found].map((one) => crates.get(one)?.folder ?? one).sort();
}

/** Files that make up or check the web part. */
const WEB = /^(web|face|expression|gestures|viewer|composite|packages|tests\/browser|index\.html|package|vite\.config|tsconfig|biome|docs|\w+\.md$)/;
/** Files with which every page is built, served or visited. */
const EVERYWHERE = /^(package|vite\.config|web\/test\/tier|web\/tools\/(chromium|links|notices|parts|wasm)\.|tests\/browser\/(playwright\.config|kinds|stage)\.)/;
/** Files that are not part of any page or element. */
const ASIDE = /^(web\/test\/|web\/tools\/|web\/package\/|tsconfig|biome)/;

/** Returns the specs required by a change of files: all of them if the readers of a web file are unknown. */
function specs(files) {
  const found = specsOf(files);
  const isAll = files.some((file) => EVERYWHERE.test(file)) || found.unknown.some((file) => WEB.test(file) && !ASIDE.test(file));
  return isAll ? Object.keys(visits()) : found.specs;
}

/** Returns the work of `npm test -- --changed`: checks by name, the crates to test, and the specs. */
export function needed() {
  const files = changedFiles();
  const crates = packages();
  // Files from which every crate is built, or which every crate plays.
  const all = files.some((file) => /^(Cargo\.|rust-toolchain|\.ci\/|assets\/|tests\/suite\/)/.test(file));
  const rust = all ? [...crates.keys()] : affected(files, crates);
  const web = files.filter((file) => WEB.test(file));
  const checks = files.length > 0 ? ['spelling'] : [];
  if (rust.length > 0) checks.push('format', 'clippy', 'doctest', 'rust');
  if (web.length > 0) checks.push('lint', 'types');
  // The unit tests of the web compare the wasm builds with the program, and read files of crates and of the library.
  if (web.length > 0 || rust.length > 0) checks.push('wasm', 'unit');
  const visited = specs(files);
  if (visited.length > 0) checks.push('browser');
  return { checks, crates: rust, specs: visited };
}
