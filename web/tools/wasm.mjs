// Builds the player twice from one source, for WebGPU (small) and for WebGL2, and the importer of
// foreign avatars, the reader of annotations, the model of faces and the speech of pages, which a page loads only when it needs them: cargo, wasm-bindgen,
// wasm-opt. Tests have quick builds of their own.
// Only Node's own modules.

import { copyFileSync, existsSync, mkdirSync, rmSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { packages, sources } from './changed.mjs';
import { targetFolder } from './kept.mjs';
import { once, root, start, Stop } from './steps.mjs';

/** Back ends, each with its own build. */
export const backends = ['webgpu', 'webgl'];

/** All builds and their folders: features of the crate `web`, and the crates `annotate`, `avatar`, `faces` and `say`. */
export const builds = [...backends, 'annotate', 'avatar', 'faces', 'say'];

/**
 * Purposes of builds: shipping, small and fast, or testing soon after a change. A kind has cargo's profile, the folder of its wasm builds and that of its
 * page; optimised ones also go through wasm-opt.
 */
export const kinds = {
  shipped: { name: 'shipped', profile: 'wasm', folder: 'web/pkg', site: 'dist', isOptimized: true },
  quick: { name: 'quick', profile: 'wasm-quick', folder: 'web/pkg/quick', site: '.setup/site', isOptimized: false },
};

/** Returns the stamp in `.setup` of a wasm build. */
export const stampOf = (kind, build) => `wasm-${kind.name}-${build}`;

/** Builds all variants of a kind. `bindgen` is the program that writes their JavaScript, where it is built already. */
export async function buildWasm(kind = kinds.shipped, bindgen) {
  // Cargo's builds run one after the other and use all cores for most of the time; the steps after
  // a build use one core and run next to the following build.
  let cargo = Promise.resolve();
  const crates = packages({ tests: false });
  await Promise.all(builds.map((feature) => {
    const folder = `${kind.folder}/${feature}`;
    // None of the builds includes the crates that make figures and voices.
    const inputs = [...sources(crateOf(feature), crates), 'Cargo.toml', 'Cargo.lock', 'rust-toolchain.toml', 'web/tools/bindgen', 'web/tools/wasm.mjs'];
    const outputs = [`${folder}/raconteur.js`, `${folder}/raconteur_bg.wasm`];
    return once(stampOf(kind, feature), { inputs, outputs }, async () => {
      const compiled = cargo.then(() => compile(feature, kind, join(root, folder)));
      cargo = compiled.catch(() => undefined);
      await finish(await compiled, join(root, folder), kind, bindgen);
    });
  }));
}

/** Returns the package from which a variant is built. */
const crateOf = (feature) => `raconteur-${backends.includes(feature) ? 'web' : feature}`;

/** Compiles a variant and returns its file, copied to `folder` because the next variant overwrites cargo's own. */
async function compile(feature, { profile, isOptimized }, folder) {
  const name = crateOf(feature);
  // Panic messages contain names of source files, so the folders of the build machine are removed.
  // Test builds may contain them, but are compiled alike in every checkout, so that they can be
  // cached.
  const cargoHome = process.env['CARGO_HOME'] ?? join(homedir(), '.cargo');
  const hidden = isOptimized ? [`--remap-path-prefix=${cargoHome}=cargo`, `--remap-path-prefix=${root}=.`] : [];
  const flags = [process.env['RUSTFLAGS'] ?? '', '-Ctarget-feature=+simd128', ...hidden].join(' ').trim();
  // Test variants are compiled together if possible, so that crates are compiled once for all: the
  // first requested variant builds the others. A variant that ships has only its own features.
  const variants = isOptimized || feature === 'webgpu' ? [feature] : builds.filter((variant) => variant !== 'webgpu');
  await start('cargo', [
    'build', '--locked', ...variants.flatMap((variant) => ['--package', crateOf(variant)]), '--target', 'wasm32-unknown-unknown',
    '--profile', profile, ...variants.filter((variant) => backends.includes(variant)).flatMap((variant) => ['--features', `raconteur-web/${variant}`]),
  ], { why: `Compiling the ${feature} build`, env: { ...process.env, RUSTFLAGS: flags } });
  const compiled = join(targetFolder(), `wasm32-unknown-unknown/${profile}/${name.replace('-', '_')}.wasm`);
  if (!existsSync(compiled)) throw new Stop(`cargo left no ${compiled}.`);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const taken = join(folder, 'compiled.wasm');
  copyFileSync(compiled, taken);
  return taken;
}

/** Writes the JavaScript side of a compiled variant, and optimises it if its kind requires that. */
async function finish(compiled, folder, { isOptimized }, bindgen) {
  const [program, ...args] = bindgen === undefined ? ['cargo', 'run', '--locked', '--quiet', '--package', 'raconteur-bindgen', '--'] : [bindgen];
  await start(program, [...args, compiled, folder], { why: 'Writing the JavaScript side' });
  rmSync(compiled);
  if (!isOptimized) return;

  // From npm: distributions carry versions old enough to break reference types.
  const module = join(folder, 'raconteur_bg.wasm');
  await start(process.execPath, [
    join(root, 'node_modules/binaryen/bin/wasm-opt'), module, '-o', module, '-Oz',
    '--enable-bulk-memory', '--enable-reference-types', '--enable-nontrapping-float-to-int',
    '--enable-sign-ext', '--enable-mutable-globals', '--enable-multivalue', '--enable-simd',
  ], { why: 'Optimizing the wasm file' });
}
