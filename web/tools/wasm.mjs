// Builds the player twice from one source: for WebGPU (small) and for WebGL2, each with what
// only some stories need in a second file; and the importer of foreign avatars, which a page
// loads only when it meets one.
// Only Node's own modules.

import { copyFileSync, existsSync, mkdirSync, rmSync } from 'node:fs';
import { homedir } from 'node:os';
import { isAbsolute, join } from 'node:path';
import { nameByLikeness } from './order.mjs';
import { shortenImports } from './shorten.mjs';
import { split } from './split.mjs';
import { once, root, run, Stop } from './steps.mjs';

/** The back ends, each with a build of its own. */
export const backends = ['webgpu', 'webgl'];

/** Functions that the rest calls only where a story asks for players or manipulators. */
const doors = /^\$"<?raconteur_(actor|player)\[\w+\]::motion::/;

/** Every build: cargo's feature and the folder in web/pkg/. */
const builds = [...backends, 'avatar'];

/** The programs that shape a build: what they change is built anew. */
const tools = ['bindgen', 'wasm.mjs', 'module.mjs', 'order.mjs', 'shorten.mjs', 'split.mjs'].map((name) => `web/tools/${name}`);

/** Builds all variants into web/pkg/. */
export async function buildWasm() {
  for (const feature of builds) {
    const folder = `web/pkg/${feature}`;
    const inputs = ['crate', 'Cargo.toml', 'Cargo.lock', 'rust-toolchain.toml', 'web/tools/bindgen', ...tools];
    const outputs = [`${folder}/raconteur.js`, `${folder}/raconteur_bg.wasm`];
    if (backends.includes(feature)) outputs.push(`${folder}/raconteur_motion.wasm`);
    await once(`wasm-${feature}`, { inputs, outputs }, () => build(feature, folder));
  }
}

function build(feature, folder) {
  const target = process.env['CARGO_TARGET_DIR'] ?? 'target';
  // Panic messages name source files; the builder's own folders are nobody's business.
  const cargoHome = process.env['CARGO_HOME'] ?? join(homedir(), '.cargo');
  const remapped = `--remap-path-prefix=${cargoHome}=cargo --remap-path-prefix=${root}=.`;
  // A panic ends the player at once instead of first writing a message that no reader sees:
  // a tenth of the download. For this the standard library is compiled anew, which cargo
  // offers as unstable; rust-toolchain.toml pins the compiler, so it cannot change.
  const flags = `${process.env['RUSTFLAGS'] ?? ''} ${remapped} -Zunstable-options -Cpanic=immediate-abort`.trim();
  run('cargo', [
    'build', '--locked', '--package', 'raconteur-web', '--target', 'wasm32-unknown-unknown',
    '--profile', 'wasm', '--no-default-features', '--features', `${feature},intrinsics`,
    '-Zbuild-std=std,panic_abort', '-Zbuild-std-features=optimize_for_size',
  ], { why: `Compiling the ${feature} build`, env: { ...process.env, RUSTC_BOOTSTRAP: '1', RUSTFLAGS: flags } });
  const compiled = join(isAbsolute(target) ? target : join(root, target), 'wasm32-unknown-unknown/wasm/raconteur_web.wasm');
  if (!existsSync(compiled)) throw new Stop(`cargo left no ${compiled}.`);
  rmSync(join(root, folder), { recursive: true, force: true });
  mkdirSync(join(root, folder), { recursive: true });
  // The next variant overwrites cargo's file, so this one is taken away first.
  const taken = join(root, folder, 'compiled.wasm');
  copyFileSync(compiled, taken);
  run('cargo', ['run', '--locked', '--quiet', '--package', 'raconteur-bindgen', '--', taken, join(root, folder)], {
    why: 'Writing the JavaScript side',
  });
  rmSync(taken);
  const module = join(root, folder, 'raconteur_bg.wasm');
  const modules = [module];
  if (backends.includes(feature)) {
    const motion = join(root, folder, 'raconteur_motion.wasm');
    const texts = modules.concat(motion).map((path) => path.replace(/wasm$/, 'wat'));
    binaryen('wasm-dis', module, '-o', texts[0]);
    split(...texts, doors);
    modules.push(motion);
    modules.forEach((path, i) => binaryen('wasm-as', texts[i], '-o', path));
    texts.forEach((path) => rmSync(path));
  }
  for (const path of modules) {
    // Nothing lives below 1024 (the end of the stack is there), so offsets fold into loads.
    // What few fetch may be fast rather than small.
    binaryen('wasm-opt', path, '-o', path, path === module ? '-Oz' : '-O3', '--low-memory-unused');
    nameByLikeness(path);
    binaryen('wasm-opt', path, '-o', path, '--reorder-functions-by-name');
  }
  shortenImports(module, join(root, folder, 'raconteur.js'));
}

/** Runs one of binaryen's programs, from npm: distributions carry versions old enough to break reference types. */
function binaryen(program, ...args) {
  run(process.execPath, [
    join(root, 'node_modules/binaryen/bin', program), ...args,
    '--enable-bulk-memory', '--enable-reference-types', '--enable-nontrapping-float-to-int',
    '--enable-sign-ext', '--enable-mutable-globals', '--enable-multivalue',
  ], { why: 'Shrinking the wasm files' });
}
