// `npm test`, the gate: prepares everything, then runs every check once. `npm run test:long`
// (`--long`) runs all checks. With names, only those checks run. With `--changed`, only those run
// that the files changed from branch main affect, and Rust's tests of the crates that they reach.
// With `--fresh` it runs in a new clone next to this one, without caches. docs/testing.md has
// details.

import { availableParallelism } from 'node:os';
import { isPage, isTimed } from '../../tests/browser/kinds.mjs';
import { needed, sources } from './changed.mjs';
import { fresh } from './fresh.mjs';
import { begin, keep } from './kept.mjs';
import { probe } from './probe.mjs';
import { buildTests, runTests } from './rust-tests.mjs';
import { packages, page, rust, schemas, system, typos } from './setup.mjs';
import { main, once, start, Stop } from './steps.mjs';
import { browserTimes, report, reportPath, unitTimes } from './times.mjs';
import { backends, builds, buildWasm, kinds, stampOf } from './wasm.mjs';

const isLong = process.argv.includes('--long');
// Tests query it: Rust tests through `raconteur-tier`, browser and unit tests directly.
if (isLong) process.env['TEST_LONG'] = '1';
/** Tested builds: the shipped ones in the long tier. */
const kind = isLong ? kinds.shipped : kinds.quick;

const cargo = (args, options) => start('cargo', args, options);
const node = (file, args = [], options) => start(process.execPath, [file, ...args], options);

let building;
/** Compiles Rust's tests and programs, once per run. */
const built = () => (building ??= buildTests());
const program = async (name) => (await built()).programs[name];

/** True if a check was skipped because it had passed before: the run's times are then not those of the gate. */
let wasSpared = false;

/** Does `work` unless it passed before with the same `inputs`; always in the long tier. */
const unlessPassed = async (name, inputs, work) => {
  if (isLong) return work();
  if (await once(`passed-${name}`, { inputs }, work)) return;
  wasSpared = true;
  console.log('  passed before, and unchanged');
};

/** Inputs of browser tests; the next constant adds those of the pages. */
const PLAYED = [...builds.map((build) => `.setup/${stampOf(kind, build)}`), 'web/element', 'web/speech', 'packages', 'web/test/tier.ts', 'web/tools/chromium.mjs', 'tests/browser', 'assets', 'vite.config.ts', 'package-lock.json'];
// The pages include figures in three.js next to the command line's renderings of them.
const PAGES = ['crate/cli', 'index.html', 'web/pages', 'web/tools/pages.ts', 'web/composite', 'web/course', 'web/tools/course.ts', 'docs', 'README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'SECURITY.md'];

/** Completed tests, for the final report. */
const tests = [];

/** Runs the tests of some projects, or of these only those of the specs that are named. */
const playwright = async (name, workers, projects, specs = []) => {
  const path = reportPath(name);
  try {
    await node('node_modules/@playwright/test/cli.js', ['test', '--config', 'tests/browser/playwright.config.ts', '--workers', String(workers), ...projects.map((p) => `--project=${p}`), ...specs.map((spec) => `/${spec}`), ...(specs.length > 0 ? ['--pass-with-no-tests'] : [])], {
      env: { ...process.env, BROWSER_REPORT: path },
    });
  } finally {
    tests.push(...browserTimes(path));
  }
};

/** Browser tests: two in parallel, except those timed by audio, which run alone. */
const BROWSER = [
  { name: 'player', workers: 2, projects: ['webgl', 'webgpu'], inputs: PLAYED, has: (spec) => !isPage(spec) },
  { name: 'pages', workers: 2, projects: ['page'], inputs: [...PLAYED, ...PAGES], has: isPage },
  { name: 'sound', workers: 1, projects: isLong ? ['webgl-sound', 'webgpu-sound'] : ['webgl-sound'], inputs: PLAYED, has: isTimed },
];

/** Checks by name, in order: those that fail fast come first. */
const checks = {
  format: () => cargo(['fmt', '--all', '--check']),
  lint: () => node('node_modules/@biomejs/biome/bin/biome', ['check', '--error-on-warnings', '.']),
  spelling: async () => start(await typos(), []),
  compile: () => built(),
  rust: async ({ crates } = {}) => {
    const { spared, done } = await runTests((await built()).tests, { crates, runsAll: isLong });
    wasSpared ||= spared.length > 0;
    tests.push(...done);
  },
  // The examples of the documentation compile and run.
  doctest: () => cargo(['test', '--locked', '--workspace', '--doc', '--quiet']),
  // Benches want crates of their own to be read first.
  clippy: () => cargo(['clippy', '--locked', '--workspace', ...(isLong ? [] : ['--exclude', 'raconteur-bench']), '--all-targets', '--', '--deny', 'warnings']),
  'clippy-wasm': async () => {
    for (const backend of isLong ? backends : ['webgl']) {
      await cargo(['clippy', '--locked', '--package', 'raconteur-web', '--target', 'wasm32-unknown-unknown', '--features', backend, '--', '--deny', 'warnings']);
    }
  },
  doc: () => cargo(['doc', '--locked', '--workspace', '--no-deps'], { env: { ...process.env, RUSTDOCFLAGS: '--deny warnings' } }),
  // Checks that the committed files pass where nothing was compiled before.
  fresh: () => fresh(),
  // Running them requires a nightly compiler.
  fuzz: () => cargo(['check', '--locked', '--manifest-path', 'fuzz/Cargo.toml']),
  voices: async () => {
    const raconteur = await program('raconteur');
    await unlessPassed('voices', [...sources('raconteur-cli'), 'web/tools/voices.mjs'], () => node('web/tools/voices.mjs', ['--check', raconteur]));
  },
  witness: () => node('web/tools/witness.mjs'),
  people: async () => node('web/tools/people.mjs', [await program('raconteur')]),
  wasm: async () => buildWasm(kind, await program('raconteur-bindgen')),
  types: () => node('node_modules/typescript/bin/tsc', ['--noEmit']),
  unit: async () => {
    const path = reportPath('unit');
    // The poses of the wasm builds are compared with the command line's.
    await built();
    await node('node_modules/vitest/vitest.mjs', ['run', '--reporter=default', '--reporter=json', `--outputFile.json=${path}`]);
    tests.push(...unitTimes(path));
  },
  // Two bundlers of an empty folder, and plain Node.
  package: async () => {
    await buildWasm(kind, await program('raconteur-bindgen'));
    await unlessPassed('package', [...PLAYED, 'web/package', 'web/tools/elements.mjs', ...['', '-about', '-build', '-check', '-play', '-bare', '-size', '-uses'].map((part) => `web/tools/package${part}.mjs`)], async () => {
      await node('web/tools/package.mjs', isLong ? [] : ['quick']);
      await node('web/tools/package-check.mjs');
      if (isLong) await node('web/tools/package-cells.mjs');
    });
  },
  size: async () => {
    await page(kind, await program('raconteur-bindgen'));
    await node('web/tools/size.mjs');
  },
  browser: async ({ specs } = {}) => {
    // Figures are compared with the command line's renderings of them.
    await page(kind, await program('raconteur-bindgen'));
    if (specs === undefined || specs.some((spec) => spec.startsWith('course'))) await schemas();
    for (const { name, workers, projects, inputs, has } of BROWSER) {
      const run = (some) => playwright(name, Math.min(workers, availableParallelism()), projects, some);
      if (specs === undefined) await unlessPassed(name, inputs, () => run());
      else if (specs.some(has)) await run(specs.filter(has));
    }
  },
};

/** Checks of the long tier only. */
const LONG = ['doc', 'fresh', 'fuzz', 'witness', 'people', 'size'];
/** Checks after which there is more to cache, and no compiler is running. */
const COMPILES = ['compile', 'doctest', 'clippy', 'clippy-wasm', 'wasm'];
/** Checks that run the output of `built`. */
const RUNS_BUILT = ['compile', 'rust', 'voices', 'people', 'wasm', 'unit', 'package', 'size', 'browser'];

await main(async () => {
  if (process.argv.includes('--fresh')) return fresh();
  const change = process.argv.includes('--changed') ? needed() : undefined;
  if (change?.checks.length === 0) {
    console.log('Nothing differs from main that a check looks at.');
    return;
  }
  const named = change?.checks ?? process.argv.slice(2).filter((name) => name !== '--long');
  const unknown = named.find((name) => !(name in checks));
  if (unknown !== undefined) throw new Stop(`There is no check ${unknown}; there are ${Object.keys(checks).join(', ')}.`);
  const wanted = Object.keys(checks).filter((name) => (named.length > 0 ? named.includes(name) : isLong || !LONG.includes(name)));

  // Before anything else is at work.
  const pace = await probe();
  await rust();
  await system('cpp');
  begin();
  // Downloads wait for the network while the compiler works.
  const runsBuilt = wanted.some((name) => RUNS_BUILT.includes(name));
  const prepared = Promise.all([packages(), ...(runsBuilt ? [system('browser', 'engines')] : [])]);
  if (runsBuilt) built().catch(() => undefined);
  await prepared;
  const times = [];
  for (const name of wanted) {
    console.log(`\n=== ${name}`);
    const begun = performance.now();
    await checks[name](change);
    times.push({ name, secs: (performance.now() - begun) / 1000 });
    if (COMPILES.includes(name)) keep();
  }
  report({ checks: times, tests, probe: pace, isWhole: named.length === 0 && !isLong && !wasSpared, isLong });
  console.log('\nAll is well. The times are kept in .setup/times.json.');
});
