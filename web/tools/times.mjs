// Prints the durations of checks and tests, stores them in `.setup/times.json`, and compares them
// with the budgets of docs/testing.md and with the last complete run of main. Uses only Node's own
// modules.

import { existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { keptPath } from './kept.mjs';
import { ask, root } from './steps.mjs';

/** Number of slowest tests listed. */
const NAMED = 10;
/** Factor over the budget, or over the time on main, above which a check or test is listed. */
const SLOW = 1.25;
/** Duration in seconds below which a check is too short to distinguish from noise. */
const MIN_SECS = 10;
/** A test that grew by less is not named. */
const MIN_GROWTH_SECS = 5;

/** Returns a path for a report that another program writes, without the report of the last run. */
export function reportPath(name) {
  const path = join(root, '.setup/reports', `${name}.json`);
  mkdirSync(dirname(path), { recursive: true });
  rmSync(path, { force: true });
  return path;
}

const read = (path) => (existsSync(path) ? JSON.parse(readFileSync(path, 'utf8')) : undefined);

/** Reads the results of an earlier run; undefined if they do not exist or cannot be read. */
function readKept(path) {
  try {
    return read(path);
  } catch {
    return undefined;
  }
}

/** Tests of a report of vitest, with seconds. */
export function unitTimes(path) {
  const files = read(path)?.testResults ?? [];
  return files.flatMap(({ assertionResults }) => assertionResults).map(({ fullName, duration }) => ({ name: `unit ${fullName.trim()}`, secs: (duration ?? 0) / 1000 }));
}

/** Tests of a report of Playwright, with seconds. */
export function browserTimes(path) {
  const inside = (suite) => [...(suite.specs ?? []), ...(suite.suites ?? []).flatMap(inside)];
  return (read(path)?.suites ?? []).flatMap(inside).flatMap(({ title, file, tests }) =>
    tests.map(({ projectName, results }) => ({ name: `${projectName} ${file}: ${title}`, secs: results.reduce((sum, { duration }) => sum + duration, 0) / 1000 })),
  );
}

/** Returns the budget of each check from the table of docs/testing.md, whose rows end with seconds on the reference machine. */
export function budgets(text) {
  const rows = [...text.matchAll(/^\| `([\w-]+)` \|.*\| (\d+) s \| [\d.]+ % \|$/gm)];
  return new Map(rows.map(([, name, secs]) => [name, Number(secs)]));
}

/** Seconds of the probe on the reference machine, from docs/testing.md. */
export function referenceProbe(text) {
  const [, secs] = /the probe takes ([\d.]+) s/.exec(text) ?? [];
  if (secs === undefined) throw new Error('docs/testing.md does not say how long the probe takes on the reference machine.');
  return Number(secs);
}

/** Checks that took more than `SLOW` times their budget on a machine that is `pace` times slower than the reference, as sentences. */
export function slower(checks, wanted, pace) {
  return checks
    .filter(({ name }) => wanted.has(name))
    .map(({ name, secs }) => ({ name, secs, budget: wanted.get(name) * pace }))
    .filter(({ secs, budget }) => secs > MIN_SECS && secs > SLOW * budget)
    .map(({ name, secs, budget }) => `${name} took ${secs.toFixed(0)} s; its budget is ${budget.toFixed(0)} s on this machine.`);
}

/** Returns checks and tests slower than in `before`, a run of main, as sentences in descending order of growth. */
export function grown(now, before) {
  const pace = now.probe / before.probe;
  const old = new Map([...before.checks, ...before.tests].map(({ name, secs }) => [name, secs * pace]));
  return [...now.checks, ...now.tests]
    .filter(({ name, secs }) => old.has(name) && secs - old.get(name) > MIN_GROWTH_SECS && secs > SLOW * old.get(name))
    .sort((a, b) => b.secs - old.get(b.name) - (a.secs - old.get(a.name)))
    .slice(0, NAMED)
    .map(({ name, secs }) => `${name} took ${secs.toFixed(1)} s; on main it would be ${old.get(name).toFixed(1)} s.`);
}

/** Returns true if the checkout is part of main without changes. */
const isMain = () => ask('git', ['status', '--porcelain'])?.trim() === '' && ask('git', ['merge-base', '--is-ancestor', 'HEAD', 'main']) !== undefined;

/**
 * Prints and stores the times of a run: `checks` and `tests` with seconds, and the duration of the `probe` before them. Reports everything over its budget;
 * for a complete gate run (`isWhole`) without skipped checks also the growth since main, and stores it if it is on main. The long tier (`isLong`) has no
 * budgets.
 */
export function report({ checks, tests, probe, isWhole, isLong }) {
  const slowest = [...tests].sort((a, b) => b.secs - a.secs).slice(0, NAMED);
  if (slowest.length > 0) console.log('\nThe slowest tests:');
  for (const { name, secs } of slowest) console.log(`  ${secs.toFixed(1).padStart(6)} s  ${name}`);
  console.log('\nThe checks:');
  for (const { name, secs } of checks) console.log(`  ${secs.toFixed(1).padStart(6)} s  ${name}`);
  console.log(`  ${checks.reduce((sum, { secs }) => sum + secs, 0).toFixed(1).padStart(6)} s  all`);
  const now = { checks, tests, probe };
  write(join(root, '.setup/times.json'), now);
  if (isLong) return;
  const text = readFileSync(join(root, 'docs/testing.md'), 'utf8');
  const pace = probe / referenceProbe(text);
  console.log(`This machine is just now ${pace.toFixed(2)} times as slow as the reference machine.`);
  for (const sentence of slower(checks, budgets(text), pace)) console.log(`Over its budget: ${sentence}`);
  if (!isWhole) return;
  const kept = keptPath('times.json');
  const before = readKept(kept);
  if (before !== undefined) for (const sentence of grown(now, before)) console.log(`Grew: ${sentence}`);
  if (isMain()) write(kept, now);
}

function write(path, value) {
  mkdirSync(dirname(path), { recursive: true });
  // Whole or not at all: it may be broken off.
  writeFileSync(`${path}.new`, `${JSON.stringify(value, null, 1)}\n`);
  renameSync(`${path}.new`, path);
}
