// Builds the player twice from one source: for WebGPU (small) and for WebGL2, each with what
// only some stories need and what moves a face in files of their own; and the importer of foreign
// avatars, which a page loads only when it meets one.
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

/**
 * Files beside the first, each with the functions that the rest calls only where the file is there: what
 * only some stories need (players and manipulators, animations, fragments that come later, music),
 * and what moves a face besides its lips.
 */
const parts = {
  more: { doors: /^\$"<?raconteur_((actor|player)\[\w+\]::motion|web\[\w+\]::more)::/, mark: '' },
  face: { doors: /^\$"<?raconteur_(actor\[\w+\]::feeling|body\[\w+\]::read::soft|player\[\w+\]::(feelings|soft|fibres)|speech\[\w+\]::bundle::melody::read\b|web\[\w+\]::drawn)/, mark: 'A' },
};

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
    if (backends.includes(feature)) outputs.push(...Object.keys(parts).map((part) => `${folder}/raconteur_${part}.wasm`));
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
    const text = (path) => path.replace(/wasm$/, 'wat');
    modules.push(...Object.keys(parts).map((part) => join(root, folder, `raconteur_${part}.wasm`)));
    binaryen('wasm-dis', module, '-o', text(module));
    split(text(module), Object.values(parts).map((part, i) => ({ ...part, to: text(modules[i + 1]) })));
    for (const path of modules) {
      binaryen('wasm-as', text(path), '-o', path);
      rmSync(text(path));
    }
  }
  for (const path of modules) {
    // Nothing lives below 1024 (the end of the stack is there), so offsets fold into loads.
    // What joins later may be fast rather than small.
    const passes = path === module ? ['--flatten', '--rereloop', '-Oz', '-Oz'] : ['-O3'];
    binaryen('wasm-opt', path, '-o', path, ...passes, '--low-memory-unused');
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
