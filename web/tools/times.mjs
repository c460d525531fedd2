// How long checks and tests took: printed, kept in `.setup/times.json`, and held against the shares of
// docs/testing.md. Only Node's own modules.

import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { root } from './steps.mjs';

/** How many of the slowest tests are named. */
const NAMED = 10;
/** A check that takes more than this many times its share is named. */
const SLOW = 1.5;
/** Below this many seconds a share is too small to be told from chance. */
const LEAST_SECS = 10;

/** A path for a report that another program writes, without the one of the last run. */
export function reportPath(name) {
  const path = join(root, '.setup/reports', `${name}.json`);
  mkdirSync(dirname(path), { recursive: true });
  rmSync(path, { force: true });
  return path;
}

const read = (path) => (existsSync(path) ? JSON.parse(readFileSync(path, 'utf8')) : undefined);

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

/** The share of each check in the whole, 0 to 1, from the table of docs/testing.md: its rows end with a percentage. */
export function shares(text) {
  const rows = [...text.matchAll(/^\| `([\w-]+)` \|.*\| ([\d.]+) % \|$/gm)];
  return new Map(rows.map(([, name, percent]) => [name, Number(percent) / 100]));
}

/** Checks that took more than `SLOW` times their share of all that ran, as sentences. */
export function slower(checks, wanted) {
  const known = checks.filter(({ name }) => wanted.has(name));
  const total = known.reduce((sum, { secs }) => sum + secs, 0);
  const whole = known.reduce((sum, { name }) => sum + wanted.get(name), 0);
  return known
    .map(({ name, secs }) => ({ name, secs, share: (wanted.get(name) / whole) * total }))
    .filter(({ secs, share }) => secs > LEAST_SECS && secs > SLOW * share)
    .map(({ name, secs, share }) => `${name} took ${secs.toFixed(0)} s; by its share in docs/testing.md it would be ${share.toFixed(0)} s.`);
}

/** Prints and keeps the times of a run; `isWhole` where every check ran, so that shares mean something. */
export function report(checks, tests, isWhole) {
  const slowest = [...tests].sort((a, b) => b.secs - a.secs).slice(0, NAMED);
  if (slowest.length > 0) console.log('\nThe slowest tests:');
  for (const { name, secs } of slowest) console.log(`  ${secs.toFixed(1).padStart(6)} s  ${name}`);
  console.log('\nThe checks:');
  for (const { name, secs } of checks) console.log(`  ${secs.toFixed(1).padStart(6)} s  ${name}`);
  mkdirSync(join(root, '.setup'), { recursive: true });
  writeFileSync(join(root, '.setup/times.json'), `${JSON.stringify({ checks, tests }, null, 1)}\n`);
  if (!isWhole) return;
  const table = join(root, 'docs/testing.md');
  for (const sentence of slower(checks, shares(readFileSync(table, 'utf8')))) console.log(`Slower than usual: ${sentence}`);
}
