import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { shares, slower } from '../tools/times.mjs';

const root = join(import.meta.dirname, '../..');
const document = readFileSync(join(root, 'docs/testing.md'), 'utf8');
const program = readFileSync(join(root, 'web/tools/test.mjs'), 'utf8');

test('the document has a row for every check, and its shares are the whole', () => {
  const [, checks = ''] = /^const checks = \{\n(.*?)^\};/ms.exec(program) ?? [];
  const names = [...checks.matchAll(/^ {2}'?([\w-]+)'?: /gm)].map(([, name]) => name);
  const rows = [...document.matchAll(/^\| `([\w-]+)` \|.* \|$/gm)].map(([, name]) => name).filter((name) => names.includes(name));
  expect(names.length).toBeGreaterThan(10);
  expect(rows.slice(0, names.length)).toEqual(names);
  const sum = [...shares(document).values()].reduce((a, b) => a + b, 0);
  expect(sum).toBeCloseTo(1, 1);
});

test('a check that takes more than half again its share is named, whatever the machine', () => {
  const wanted = new Map([
    ['rust', 0.5],
    ['browser', 0.4],
    ['lint', 0.1],
  ]);
  const checks = (rust: number, browser: number, lint: number) => [
    { name: 'rust', secs: rust },
    { name: 'browser', secs: browser },
    { name: 'lint', secs: lint },
  ];
  expect(slower(checks(50, 40, 10), wanted)).toEqual([]);
  expect(slower(checks(500, 400, 100), wanted)).toEqual([]);
  expect(slower(checks(500, 400, 300), wanted)).toEqual(['lint took 300 s; by its share in docs/testing.md it would be 120 s.']);
  // Of a few seconds nothing can be said, nor of a check without a share.
  expect(slower(checks(5, 4, 3), wanted)).toEqual([]);
  expect(slower([...checks(50, 40, 10), { name: 'size', secs: 900 }], wanted)).toEqual([]);
});
