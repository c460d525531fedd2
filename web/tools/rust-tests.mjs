// Rust's tests: built by one command, together with the programs that other checks use, then run side by
// side, one program a processor and the slowest first. `cargo test` runs one program after the other, and
// `cargo build --package` afterwards compiles half of the workspace again, with other features.
// Only Node's own modules.

import { spawn } from 'node:child_process';
import { availableParallelism } from 'node:os';
import { basename, dirname } from 'node:path';
import { createInterface } from 'node:readline';
import { packages, sources } from './changed.mjs';
import { root, stamp, Stop } from './steps.mjs';

/** Slowest test programs: started first, so that none runs alone at the end. */
const SLOWEST = ['raconteur_sculpt', 'sweep', 'shipped', 'library', 'symmetry', 'face', 'environment', 'serve', 'bake', 'bad_input', 'penetration', 'limb_speed'];

/**
 * Compiles the tests of the workspace with its programs: `tests` with name, package, folder and executable,
 * and `programs` by name.
 */
export async function buildTests() {
  const child = spawn('cargo', ['build', '--locked', '--workspace', '--bins', '--tests', '--message-format', 'json-render-diagnostics'], {
    cwd: root,
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const ended = new Promise((resolve, reject) => {
    child.on('error', () => reject(new Stop('cargo is not installed.')));
    child.on('exit', (code, signal) => (code === 0 ? resolve() : reject(new Stop(`Compiling the tests failed (exit ${code ?? signal}).`))));
  });
  const built = { tests: [], programs: {} };
  const read = (async () => {
    for await (const line of createInterface({ input: child.stdout })) {
      const message = JSON.parse(line);
      if (message.reason !== 'compiler-artifact' || !message.executable) continue;
      const { target, executable, manifest_path: manifest } = message;
      if (!message.profile.test) built.programs[target.name] = executable;
      else built.tests.push({ name: target.name, package: basename(dirname(manifest)), folder: dirname(manifest), executable });
    }
  })();
  await Promise.all([ended, read]);
  return built;
}

/** Inputs of tests in addition to the sources of their crates: files of the library, cases, saved inputs, checked documents. */
const READ = ['assets', 'tests/suite', 'tests/digests', 'tests/golden', 'fuzz/saved', 'docs/eml.md', 'docs/eml.json', 'docs/eml.rng', 'docs/face.md', 'docs/live.md', 'Cargo.lock', 'Cargo.toml', 'rust-toolchain.toml'];

/** Returns, for each package of `tests`, the stamp of its last success; `tidy` reads the whole tree, and has none. */
function notes(tests) {
  const crates = packages();
  const names = [...new Set(tests.map((t) => t.package))].filter((name) => name !== 'tidy');
  return new Map(names.map((name) => [name, stamp(`passed-tests-${name}`, [...sources(`raconteur-${name}`, crates), ...READ])]));
}

/**
 * Runs the tests of the packages in `crates`, or of all. Packages that passed are skipped while their inputs are unchanged, unless `runsAll`: `spared`. Fails
 * if a test fails, after all have run; `done` are the tests with seconds.
 */
export async function runTests(tests, { crates, runsAll }) {
  const wanted = tests.filter((t) => crates === undefined || crates.includes(`raconteur-${t.package}`));
  const passed = runsAll ? new Map() : notes(wanted);
  const skipped = [...passed].filter(([, note]) => note.holds()).map(([name]) => name);
  if (skipped.length > 0) console.log(`  passed before, and unchanged: ${skipped.sort().join(', ')}`);
  const rank = ({ name }) => (SLOWEST.includes(name) ? SLOWEST.indexOf(name) : SLOWEST.length);
  const queue = wanted.filter((t) => !skipped.includes(t.package)).sort((a, b) => rank(a) - rank(b));
  const done = [];
  const work = async () => {
    for (let next = queue.shift(); next !== undefined; next = queue.shift()) done.push(await runProgram(next));
  };
  await Promise.all(Array.from({ length: availableParallelism() }, work));
  const broken = done.filter((program) => program.status !== 0);
  for (const [name, note] of passed) if (!broken.some((program) => program.package === name)) note.write();
  const count = (of) => done.reduce((sum, program) => sum + program[of], 0);
  console.log(`\n${count('passed')} passed, ${count('failed')} failed, ${count('ignored')} skipped`);
  if (broken.length > 0) throw new Stop(`Tests failed:\n${broken.map(saysWhy).join('\n')}`);
  return { spared: skipped, done: done.flatMap((program) => program.tests) };
}

/** Returns the failed tests of a program, or its exit status if none failed. */
function saysWhy({ name, status, tests }) {
  const failed = tests.filter((test) => !test.passed);
  return failed.length > 0 ? failed.map((test) => `  ${test.name}`).join('\n') : `  ${name} ended with ${status}`;
}

/** Runs one program, one test at a time, so that the interval between results is the duration of a test. */
function runProgram({ name: file, package: crate, folder, executable }) {
  const name = `${crate}/${file}`;
  return new Promise((resolve, reject) => {
    const begun = performance.now();
    const child = spawn(executable, ['--test-threads', '1'], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
    const lines = [];
    const tests = [];
    const counts = { passed: 0, failed: 0, ignored: 0 };
    let last = begun;
    const hear = (line) => {
      lines.push(line);
      const [, ...numbers] = /^test result: \w+\. (\d+) passed; (\d+) failed; (\d+) ignored;/.exec(line) ?? [];
      if (numbers.length > 0) [counts.passed, counts.failed, counts.ignored] = numbers.map(Number);
      const [, test, result] = /^test (.+) \.\.\. (ok|FAILED)$/.exec(line) ?? [];
      if (test === undefined) return;
      const now = performance.now();
      tests.push({ name: `${name} ${test}`, passed: result === 'ok', secs: (now - last) / 1000 });
      last = now;
    };
    createInterface({ input: child.stdout }).on('line', hear);
    createInterface({ input: child.stderr }).on('line', (line) => lines.push(line));
    child.on('error', (error) => reject(new Stop(`${executable} cannot be run: ${error.message}.`)));
    child.on('close', (code, signal) => {
      const status = code ?? signal;
      if (status !== 0) console.log(lines.join('\n'));
      if (counts.passed > 0 || status !== 0) {
        console.log(`  ${name}: ${counts.passed} tests, ${((performance.now() - begun) / 1000).toFixed(1)} s${status === 0 ? '' : ', FAILED'}`);
      }
      resolve({ name, package: crate, status, tests, ...counts });
    });
  });
}
