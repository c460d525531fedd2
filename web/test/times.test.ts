import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { budgets, grown, referenceProbe, slower } from '../tools/times.mjs';

const root = join(import.meta.dirname, '../..');
const document = readFileSync(join(root, 'docs/testing.md'), 'utf8');
const program = readFileSync(join(root, 'web/tools/test.mjs'), 'utf8');

test('the document has a row for every check, and its budgets are those of the gate', () => {
  const LONG: readonly string[] = /^const LONG = \[(.*)\];$/m.exec(program)?.[1]?.match(/\w+/g) ?? [];
  const [, checks = ''] = /^const checks = \{\n(.*?)^\};/ms.exec(program) ?? [];
  const names = [...checks.matchAll(/^ {2}'?([\w-]+)'?: /gm)].map(([, name]) => name);
  const rows = [...document.matchAll(/^\| `([\w-]+)` \|.* \|$/gm)].map(([, name]) => name).filter((name) => names.includes(name));
  expect(names.length).toBeGreaterThan(10);
  expect(rows.slice(0, names.length)).toEqual(names);
  const table = budgets(document);
  expect([...table.keys()]).toEqual(names.filter((name) => name !== undefined && !LONG.includes(name)));
  const sum = [...table.values()].reduce((a, b) => a + b, 0);
  const shares = [...document.matchAll(/^\| `([\w-]+)` \|.* \| \d+ s \| ([\d.]+) % \|$/gm)].map(([, name = '', percent]) => [name, Number(percent)] as const);
  for (const [name, percent] of shares) expect(Math.abs(percent - (100 * (table.get(name) ?? 0)) / sum), name).toBeLessThan(0.06);
  expect(referenceProbe(document)).toBeGreaterThan(0.5);
});

test('a check that takes more than a quarter over its budget is named, on a slow machine as on a quick one', () => {
  const wanted = new Map([
    ['rust', 200],
    ['lint', 4],
  ]);
  const rust = (secs: number) => [{ name: 'rust', secs }];
  expect(slower(rust(249), wanted, 1)).toEqual([]);
  expect(slower(rust(498), wanted, 2)).toEqual([]);
  expect(slower(rust(260), wanted, 1)).toEqual(['rust took 260 s; its budget is 200 s on this machine.']);
  expect(slower(rust(260), wanted, 0.5)).toEqual(['rust took 260 s; its budget is 100 s on this machine.']);
  // Durations of a few seconds, or of checks without a budget, are not significant.
  expect(slower([{ name: 'lint', secs: 9 }], wanted, 1)).toEqual([]);
  expect(slower([{ name: 'size', secs: 900 }], wanted, 1)).toEqual([]);
});

test('what grew since main is named, the most first, as this machine would have taken', () => {
  const before = {
    probe: 2,
    checks: [{ name: 'rust', secs: 100 }],
    tests: [
      { name: 'a', secs: 4 },
      { name: 'b', secs: 30 },
      { name: 'gone', secs: 5 },
    ],
  };
  const now = (probe: number, rust: number, a: number, b: number) => ({
    probe,
    checks: [{ name: 'rust', secs: rust }],
    tests: [
      { name: 'a', secs: a },
      { name: 'b', secs: b },
      { name: 'new', secs: 90 },
    ],
  });
  expect(grown(now(2, 110, 8, 33), before)).toEqual([]);
  expect(grown(now(4, 220, 10, 66), before)).toEqual([]);
  expect(grown(now(2, 160, 12, 33), before)).toEqual(['rust took 160.0 s; on main it would be 100.0 s.', 'a took 12.0 s; on main it would be 4.0 s.']);
  expect(grown(now(1, 110, 4, 30), before)).toEqual(['rust took 110.0 s; on main it would be 50.0 s.', 'b took 30.0 s; on main it would be 15.0 s.']);
});
