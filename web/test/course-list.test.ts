/** The list of lessons of a site, as the browser has kept how far each is. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { runInNewContext } from 'node:vm';
import { expect, it } from 'vitest';
import type { Report } from '../course/report.js';
import { BrowserRecord } from '../course/storage.js';

const SCRIPT = readFileSync(join(import.meta.dirname, '../../crate/cli/src/commands/export/list.js'), 'utf8');

it('shows what the pages of the lessons keep', () => {
  const kept = new Map<string, string>();
  const storage = { getItem: (key: string) => kept.get(key) ?? null, setItem: (key: string, value: string) => void kept.set(key, value) };
  const report: Report = { placeSecs: 1, durationSecs: 10, progress: 0.428, seen: [], isComplete: false, score: undefined, isPassed: undefined, memory: '' };
  for (const [course, more] of [
    ['urn:a', {}],
    ['urn:b', { isComplete: true, progress: 0.95 }],
  ] as const) {
    const record = new BrowserRecord(course, storage);
    record.tell({ ...report, ...more });
    record.keep();
  }
  kept.set('raconteur-course:urn:d', 'no JSON');
  const items = ['urn:a', 'urn:b', 'urn:c', 'urn:d'].map((course) => {
    const parts = { progress: { value: 0 }, span: { textContent: '' } };
    return { ...parts, dataset: { course }, querySelector: (name: 'progress' | 'span') => parts[name] };
  });
  runInNewContext(SCRIPT, { localStorage: storage, document: { querySelectorAll: () => items }, addEventListener: () => undefined });
  expect(items.map(({ progress, span }) => [progress.value, span.textContent])).toEqual([
    [0.428, '42 %'],
    [1, '✓'],
    [0, '0 %'],
    [0, '0 %'],
  ]);
});
