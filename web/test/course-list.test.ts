/** List of lessons of a site, with the progress stored by the browser. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { runInNewContext } from 'node:vm';
import { expect, it } from 'vitest';
import { BrowserRecord } from '../course/storage.js';
import { report, shelf } from './course-store.js';

const SCRIPT = readFileSync(join(import.meta.dirname, '../../crate/cli/src/commands/export/list.js'), 'utf8');

it('shows what the pages of the lessons keep', () => {
  const kept = new Map<string, string>();
  const storage = shelf(kept);
  const at = { ...report(1), progress: 0.428 };
  for (const [course, more] of [
    ['urn:a', {}],
    ['urn:b', { isComplete: true, progress: 0.95 }],
  ] as const) {
    const record = new BrowserRecord(course, storage);
    void record.open();
    record.save({ ...at, ...more });
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
