// Times ticks of the wasm builds without pixels: `node web/tools/tick.mjs`, after a build.
// The budget of a tick with eight players, five manipulators and gestures is 250 µs. Each
// includes the digest of the pose that it made. Only Node's own modules.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { backends } from './wasm.mjs';
import { main, root } from './steps.mjs';

const TICKS = 1800;
const ROUNDS = 7;

await main(async () => {
  const eml = readFileSync(join(root, 'crate/player/benches/whole-body.eml'), 'utf8');
  const names = [...new Set([...eml.matchAll(/animationSetName='([\w-]+)'/g)].map((m) => m[1]))];
  const texts = names.map((name) => readFileSync(join(root, 'assets/animations', `${name}.json`), 'utf8'));
  const figure = readFileSync(join(root, 'assets/figures/sofia.glb'));
  for (const backend of backends) {
    const folder = join(root, 'web/pkg', backend);
    const { default: instantiate } = await import(join(folder, 'raconteur.js'));
    const instance = instantiate();
    const module = await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm')));
    const exports = await instance({ module_or_path: module });
    for (const part of ['face', 'more']) {
      await WebAssembly.instantiate(readFileSync(join(folder, `raconteur_${part}.wasm`)), { '.': exports });
      instance[`${part}Joined`]();
    }
    const run = (ticks) => {
      const times = Float64Array.from({ length: ticks }, (_, i) => i / 60);
      const start = performance.now();
      instance.poseDigests(eml, undefined, 'sofia', figure, names, texts, times);
      return performance.now() - start;
    };
    run(TICKS);
    // Reading the story and the figure takes the same with few ticks as with many.
    const each = Array.from({ length: ROUNDS }, () => ((run(TICKS) - run(0)) / TICKS) * 1000).sort((a, b) => a - b);
    console.log(`${backend}: ${each[ROUNDS >> 1].toFixed(0)} µs a tick (median of ${ROUNDS}; best ${each[0].toFixed(0)}); budget 250 µs`);
  }
});
