// Builds the player twice from one source, for WebGPU (small) and for WebGL2, and the importer of
// foreign avatars, which a page loads only when it meets one: cargo, wasm-bindgen, wasm-opt.
// Only Node's own modules.

import { copyFileSync, existsSync, mkdirSync, rmSync } from 'node:fs';
import { homedir } from 'node:os';
import { isAbsolute, join } from 'node:path';
import { packages, sources } from './changed.mjs';
import { once, root, start, Stop } from './steps.mjs';

/** The back ends, each with a build of its own. */
export const backends = ['webgpu', 'webgl'];

/** Every build and its folder in web/pkg/: features of the crate `web`, and the crate `avatar`. */
const builds = [...backends, 'avatar'];

/** Builds all variants into web/pkg/. */
export async function buildWasm() {
  // Cargo builds one after the other, and takes all cores for most of the time; what comes after it
  // takes one, and runs beside the next build.
  let cargo = Promise.resolve();
  const crates = packages({ tests: false });
  await Promise.all(builds.map((feature) => {
    const folder = `web/pkg/${feature}`;
    // What makes figures and voices is in none of them.
    const inputs = [...sources(crateOf(feature), crates), 'Cargo.toml', 'Cargo.lock', 'rust-toolchain.toml', 'web/tools/bindgen', 'web/tools/wasm.mjs'];
    const outputs = [`${folder}/raconteur.js`, `${folder}/raconteur_bg.wasm`];
    return once(`wasm-${feature}`, { inputs, outputs }, async () => {
      const compiled = cargo.then(() => compile(feature, join(root, folder)));
      cargo = compiled.catch(() => undefined);
      await finish(await compiled, join(root, folder));
    });
  }));
}

/** The package that a variant is a build of. */
const crateOf = (feature) => `raconteur-${backends.includes(feature) ? 'web' : feature}`;

/** Compiles a variant and gives its file, which lies in `folder` because cargo's own is the next variant's as well. */
async function compile(feature, folder) {
  const name = crateOf(feature);
  // Messages of panics name source files: without the folders of the build machine.
  const cargoHome = process.env['CARGO_HOME'] ?? join(homedir(), '.cargo');
  const flags = [
    process.env['RUSTFLAGS'] ?? '',
    '-Ctarget-feature=+simd128',
    `--remap-path-prefix=${cargoHome}=cargo`,
    `--remap-path-prefix=${root}=.`,
  ].join(' ').trim();
  await start('cargo', [
    'build', '--locked', '--package', name, '--target', 'wasm32-unknown-unknown',
    '--profile', 'wasm', ...(backends.includes(feature) ? ['--features', feature] : []),
  ], { why: `Compiling the ${feature} build`, env: { ...process.env, RUSTFLAGS: flags } });
  const target = process.env['CARGO_TARGET_DIR'] ?? 'target';
  const compiled = join(isAbsolute(target) ? target : join(root, target), `wasm32-unknown-unknown/wasm/${name.replace('-', '_')}.wasm`);
  if (!existsSync(compiled)) throw new Stop(`cargo left no ${compiled}.`);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const taken = join(folder, 'compiled.wasm');
  copyFileSync(compiled, taken);
  return taken;
}

/** Writes the JavaScript side of a compiled variant and optimizes it. */
async function finish(compiled, folder) {
  await start('cargo', ['run', '--locked', '--quiet', '--package', 'raconteur-bindgen', '--', compiled, folder], {
    why: 'Writing the JavaScript side',
  });
  rmSync(compiled);

  // From npm: distributions carry versions old enough to break reference types.
  const module = join(folder, 'raconteur_bg.wasm');
  await start(process.execPath, [
    join(root, 'node_modules/binaryen/bin/wasm-opt'), module, '-o', module, '-Oz',
    '--enable-bulk-memory', '--enable-reference-types', '--enable-nontrapping-float-to-int',
    '--enable-sign-ext', '--enable-mutable-globals', '--enable-multivalue', '--enable-simd',
  ], { why: 'Optimizing the wasm file' });
}
