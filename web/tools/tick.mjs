// Times ticks of the wasm builds without pixels: `node web/tools/tick.mjs`, after a build. The
// story has eight players, five manipulators and gestures; each tick includes the digest of the
// pose that it made. Budgets: 250 µs for a tick without tissue, 2 ms with it at 60 a second, 400 µs
// for a step of the tissue with the controls that it follows. Only Node's own modules.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { backends } from './wasm.mjs';
import { main, root } from './steps.mjs';

const TICKS = 600;
const ROUNDS = 7;
/** Tissue steps per second; the next constant is the number of additional steps simulated before each time. */
const STEPS_PER_S = 120;
const AHEAD = 0.25;
const BEGIN_SECS = 3;

await main(async () => {
  const eml = readFileSync(join(root, 'tests/bench/benches/whole-body.eml'), 'utf8');
  const names = [...new Set([...eml.matchAll(/animationSetName='([\w-]+)'/g)].map((m) => m[1]))];
  const texts = names.map((name) => readFileSync(join(root, 'assets/animations', `${name}.json`), 'utf8'));
  const figure = readFileSync(join(root, 'assets/figures/sofia.glb'));
  // Under another name the tissue is not found.
  const hard = Buffer.from(figure);
  hard.write('"hidden"', hard.indexOf('"tissue"'));
  const moments = (rate) => Float64Array.from({ length: TICKS }, (_, i) => BEGIN_SECS + i * rate);
  const [none, still, frames, steps] = [new Float64Array(), moments(0), moments(1 / 60), moments(1 / STEPS_PER_S)];
  const median = (rounds, of) => rounds.map(of).sort((a, b) => a - b)[ROUNDS >> 1] * (1000 / TICKS);
  for (const backend of backends) {
    const folder = join(root, 'web/pkg', backend);
    const { default: instantiate } = await import(join(folder, 'raconteur.js'));
    const instance = instantiate();
    const module = await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm')));
    await instance({ module_or_path: module });
    /** Returns the duration of several lists of times, milliseconds, round by round. */
    const timed = (glb, ...lists) => {
      const run = (times) => {
        const start = performance.now();
        instance.poseDigests(eml, undefined, glb, names, texts, times);
        return performance.now() - start;
      };
      run(lists.at(-1));
      return Array.from({ length: ROUNDS }, () => lists.map(run));
    };
    // Loading the story and the figure takes the same time with few ticks as with many.
    const bare = median(timed(hard, none, frames), ([nothing, all]) => all - nothing);
    const soft = timed(figure, none, still, frames, steps);
    const tick = median(soft, ([nothing, , all]) => all - nothing);
    const step = median(soft, ([, rests, , all]) => all - rests) / (1 + AHEAD);
    console.log(`${backend}: ${bare.toFixed(0)} µs a tick without tissue, ${tick.toFixed(0)} µs with it, ${step.toFixed(0)} µs a step (medians of ${ROUNDS}); budgets 250, 2000 and 400 µs`);
  }
});
