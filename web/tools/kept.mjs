// Caches cargo's builds of third-party crates between checkouts in the user's cache: a checkout
// without a target folder starts from it. Uses only Node's own modules.
//
// Cargo names the files of a registry crate by a hash of all build inputs, independent of the
// checkout, so two checkouts can share them. For crates of the workspace it compares only times, so
// these are never shared. Files that the compiler writes once are hard links; the small ones that
// cargo rewrites are copies.

import { copyFileSync, cpSync, existsSync, linkSync, lstatSync, mkdirSync, readdirSync, renameSync, rmSync, utimesSync } from 'node:fs';
import { homedir } from 'node:os';
import { isAbsolute, join } from 'node:path';
import { root } from './steps.mjs';

/** Maximum size of the cache in bytes, above which it is deleted and rebuilt: it then contains unused crates. */
const MAX_BYTES = 6 * 2 ** 30;

/** Names of the workspace's own packages begin with it. */
const OWN = 'raconteur';

/** Returns cargo's target folder. */
export function targetFolder() {
  const given = process.env['CARGO_TARGET_DIR'] ?? 'target';
  return isAbsolute(given) ? given : join(root, given);
}

/** Returns a path in the cache shared between checkouts: below `RACONTEUR_KEPT`, otherwise in the user's cache. */
export const keptPath = (name) => join(process.env['RACONTEUR_KEPT'] ?? join(process.env['XDG_CACHE_HOME'] ?? join(homedir(), '.cache'), 'raconteur'), name);

const compiled = () => keptPath('compiled');

const list = (folder) => (existsSync(folder) ? readdirSync(folder) : []);

/** Folders of a target folder in which cargo compiles, one for each profile and platform: `debug`, `wasm32-unknown-unknown/debug`. */
function profiles(target) {
  const below = (path) => list(join(target, path)).map((name) => (path === '' ? name : join(path, name)));
  return below('')
    .flatMap((path) => [path, ...(lstatSync(join(target, path)).isDirectory() ? below(path) : [])])
    .filter((path) => existsSync(join(target, path, '.fingerprint')));
}

const hashOf = (name) => /-([0-9a-f]{16})(?:\.|$)/.exec(name)?.[1];

/** Creates a folder atomically, in a temporary folder next to it, because other processes may do the same. */
function place(to, make) {
  const half = `${to}.${process.pid}`;
  rmSync(half, { recursive: true, force: true });
  try {
    make(half);
    renameSync(half, to);
  } catch (error) {
    // Another run was sooner.
    if (!['EEXIST', 'ENOTEMPTY'].includes(error.code)) throw error;
  } finally {
    // Also where both were one file already, which are left as they are.
    rmSync(half, { recursive: true, force: true });
  }
}

/** Places a file that is written once: the same file under two names if the disk supports that, else a copy. */
function share(from, to) {
  place(to, (half) => {
    try {
      linkSync(from, half);
    } catch {
      copyFileSync(from, half);
      const { atime, mtime } = lstatSync(from);
      utimesSync(half, atime, mtime);
    }
  });
}

/** Copies a folder of small files, so each checkout has its own. */
const copy = (from, to) => place(to, (half) => cpSync(from, half, { recursive: true, preserveTimestamps: true, verbatimSymlinks: true }));

/** Copies the compiled third-party crates of `from` missing in `to`. Returns their number. */
export function carry(from, to) {
  let carried = 0;
  for (const profile of profiles(from)) {
    const [source, goal] = [join(from, profile), join(to, profile)];
    const there = new Set(list(join(goal, '.fingerprint')));
    const units = list(join(source, '.fingerprint')).filter((name) => /-[0-9a-f]{16}$/.test(name) && !name.startsWith(OWN) && !there.has(name));
    if (units.length === 0) continue;
    const hashes = new Set(units.map(hashOf));
    for (const folder of ['deps', 'build', '.fingerprint']) mkdirSync(join(goal, folder), { recursive: true });
    for (const name of list(join(source, 'deps'))) if (hashes.has(hashOf(name))) share(join(source, 'deps', name), join(goal, 'deps', name));
    for (const name of units) if (existsSync(join(source, 'build', name))) copy(join(source, 'build', name), join(goal, 'build', name));
    // Copied last, because cargo takes a unit with a fingerprint as compiled.
    for (const name of units) copy(join(source, '.fingerprint', name), join(goal, '.fingerprint', name));
    carried += units.length;
  }
  return carried;
}

/** Bytes of a folder; links are not followed. */
function sizeOf(path) {
  const entry = lstatSync(path);
  return entry.isDirectory() ? list(path).reduce((sum, name) => sum + sizeOf(join(path, name)), 0) : entry.size;
}

/** Performs a cache operation; on failure everything is compiled here as usual. */
function tried(what, work) {
  try {
    work();
  } catch (error) {
    console.log(`  ${what}: ${error.message}`);
  }
}

/** Initialises a checkout without compiled crates from the cache. */
export function begin() {
  const target = targetFolder();
  if (profiles(target).length > 0 || !existsSync(compiled())) return;
  tried('Nothing that was compiled before is used', () => {
    const carried = carry(compiled(), target);
    console.log(`  ${carried} compiled parts of other people's crates are taken from ${compiled()}`);
  });
}

/** Caches the compiled crates of this checkout. Call it only after cargo succeeded, so that no file is incomplete. */
export function keep() {
  tried('What was compiled is not kept', () => {
    const kept = compiled();
    carry(targetFolder(), kept);
    if (!existsSync(kept) || sizeOf(kept) <= MAX_BYTES) return;
    // Moves the old cache away immediately, because other checkouts may start from it.
    const old = `${kept}.${process.pid}`;
    renameSync(kept, old);
    rmSync(old, { recursive: true });
  });
}
