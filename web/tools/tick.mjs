// Times ticks of the wasm builds without pixels: `node web/tools/tick.mjs`, after a build. The
// story has eight players, five manipulators and gestures; each tick includes the skin's nodes
// and the digest of the pose that it made. Budgets: 2 ms for a tick of a story that plays, 400 µs
// for a step of the face's tissue with the controls that it follows. Only Node's own modules.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { backends } from './wasm.mjs';
import { main, root } from './steps.mjs';

const TICKS = 600;
const ROUNDS = 7;
/** Of the tissue, and how many more are walked ahead for each. */
const STEPS_PER_S = 120;
const AHEAD = 0.25;
const BEGIN_SECS = 3;

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
    const run = (times) => {
      const start = performance.now();
      instance.poseDigests(eml, undefined, 'sofia', figure, names, texts, Float64Array.from(times));
      return performance.now() - start;
    };
    const moments = (rate) => Array.from({ length: TICKS }, (_, i) => BEGIN_SECS + i * rate);
    const [none, still, playing] = [[], moments(0), moments(1 / STEPS_PER_S)];
    run(playing);
    const rounds = Array.from({ length: ROUNDS }, () => [none, still, playing].map(run));
    const median = (of) => rounds.map(of).sort((a, b) => a - b)[ROUNDS >> 1] * (1000 / TICKS);
    // Reading the story and the figure takes the same with few ticks as with many.
    const body = median(([nothing, own]) => own - nothing);
    const step = median(([, own, all]) => all - own) / (1 + AHEAD);
    const tick = body + (step * (1 + AHEAD) * STEPS_PER_S) / 60;
    console.log(`${backend}: ${tick.toFixed(0)} µs a tick at 60 a second, ${body.toFixed(0)} of them without a step of the tissue; ${step.toFixed(0)} µs a step (medians of ${ROUNDS})`);
  }
});
