// Functions for every set-up step: running programs, and detecting completed steps. Uses only
// Node's own modules, because it runs before any package is installed.

import { spawn, spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

/** The repository's root. */
export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

/** Error that is printed as one sentence, without a stack trace. */
export class Stop extends Error {}

/** Runs a program in the root, showing its output; stops when it fails. */
export function run(command, args, options = {}) {
  const { why = `${command} ${args.join(' ')}`, ...rest } = options;
  const result = spawnSync(command, args, { cwd: root, stdio: 'inherit', ...rest });
  if (result.error?.code === 'ENOENT') throw new Stop(`${command} is not installed.`);
  if (result.status !== 0) throw new Stop(`${why} failed (exit ${result.status ?? result.signal}).`);
}

/** Runs a program in parallel; rejects when it fails. Its output is shown. */
export function start(command, args, options = {}) {
  const { why = `${command} ${args.join(' ')}`, ...rest } = options;
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, { cwd: root, stdio: 'inherit', ...rest });
    child.on('error', () => reject(new Stop(`${command} is not installed.`)));
    child.on('exit', (code, signal) => (code === 0 ? resolve() : reject(new Stop(`${why} failed (exit ${code ?? signal}).`))));
  });
}

/** Returns the output of a program, or undefined if it is missing or fails. */
export function ask(command, args) {
  const result = spawnSync(command, args, { cwd: root, encoding: 'utf8' });
  return result.status === 0 ? result.stdout : undefined;
}

/** Returns a digest of the contents of files and folders, relative to the root; missing ones count as empty. */
export function digest(paths, extra = '') {
  const hash = createHash('sha256').update(extra);
  const visit = (path) => {
    if (!existsSync(path)) return;
    if (statSync(path).isDirectory()) {
      for (const name of readdirSync(path).sort()) {
        if (name !== 'node_modules' && name !== 'pkg' && name !== 'target') visit(join(path, name));
      }
    } else {
      hash.update(`${relative(root, path)}\0`).update(readFileSync(path)).update('\0');
    }
  };
  for (const path of paths) visit(join(root, path));
  return hash.digest('hex');
}

/** Returns a stamp in `.setup` for work with these inputs; `holds()` while they are unchanged. */
export function stamp(name, inputs, extra) {
  const path = join(root, '.setup', name);
  const now = digest(inputs, extra);
  return {
    holds: () => existsSync(path) && readFileSync(path, 'utf8') === now,
    remove: () => rmSync(path, { force: true }),
    write: () => {
      mkdirSync(dirname(path), { recursive: true });
      writeFileSync(path, now);
    },
  };
}

/**
 * Does `work` unless it was done before with the same inputs and its outputs still exist. The stamp is removed first, so that interrupted work is repeated.
 * Returns true if there was work.
 */
export async function once(name, { inputs, extra, outputs = [] }, work) {
  const done = stamp(name, inputs, extra);
  if (done.holds() && outputs.every((path) => existsSync(join(root, path)))) return false;
  done.remove();
  console.log(`\n› ${name}`);
  const start = Date.now();
  await work();
  done.write();
  console.log(`  ${name}: ${((Date.now() - start) / 1000).toFixed(1)} s`);
  return true;
}

/** Runs a program's main function; a `Stop` is printed as a sentence. */
export async function main(work) {
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Stop)) throw error;
    console.error(`\nraconteur: ${error.message}`);
    process.exit(1);
  }
}

/** Returns the options of a server program: `--port N`, `--host NAME`, and its own; `usage` is printed for `--help`. */
export function serverOptions(usage, own = {}) {
  const options = { ...own, port: { type: 'string' }, host: { type: 'string' }, help: { type: 'boolean' } };
  let values;
  try {
    ({ values } = parseArgs({ options }));
  } catch (error) {
    throw new Stop(`${error.message}\n${usage}`);
  }
  if (values.help) {
    console.log(usage);
    process.exit(0);
  }
  const port = values.port === undefined ? undefined : Number(values.port);
  if (port !== undefined && !(Number.isInteger(port) && port >= 0 && port < 65536)) {
    throw new Stop(`--port wants a number from 0 to 65535, not ${values.port}.`);
  }
  return { ...values, port };
}
