import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { ENTRIES, SPECS, specsOf, visitedAt, visits } from '../tools/graph.mjs';

const all = Object.keys(visits());

test('every spec says what it visits', () => {
  const specs = readdirSync(join(import.meta.dirname, '../..', SPECS)).filter((name) => name.endsWith('.spec.ts'));
  expect(all).toEqual(specs.sort());
  expect(Object.values(visits()).flat()).toEqual(expect.arrayContaining(['home', 'viewer', 'gestures', 'face', 'expression', 'composite', 'docs', 'course']));
  for (const name of Object.values(visits()).flat()) expect(ENTRIES).toHaveProperty(name);
});

test('a change of a page reaches the specs that visit it, and no others', () => {
  const page = (name: string) => specsOf([name]).specs;
  expect(page('web/pages/face/speak.ts')).toEqual(['face.page.spec.ts', 'layout.page.spec.ts']);
  expect(page('web/pages/viewer/viewer.css')).toEqual(['expression.page.spec.ts', 'face.page.spec.ts', 'layout.page.spec.ts', 'viewer.page.spec.ts']);
  expect(page('web/pages/parts/top.html')).toEqual(expect.arrayContaining(['face.page.spec.ts', 'viewer.page.spec.ts', 'gestures.page.spec.ts']));
  expect(page('web/course/scorm.ts')).toEqual(['course-learners.page.spec.ts', 'course-ready.page.spec.ts', 'course-result.page.spec.ts', 'course.page.spec.ts']);
  expect(page('docs/eml.md')).toEqual(['layout.page.spec.ts']);
});

test('the element is on every page, helpers reach the specs that use them, and what is not known is told', () => {
  expect(specsOf(['web/element/element.ts'])).toEqual({ specs: all, unknown: [] });
  expect(specsOf(['tests/browser/fixture.ts']).specs).toEqual(expect.arrayContaining(['many.spec.ts', 'media.spec.ts', 'platform-media.spec.ts']));
  expect(specsOf(['tests/browser/lms.ts']).specs).toEqual(['course-learners.page.spec.ts', 'course-ready.page.spec.ts', 'course-result.page.spec.ts', 'course.page.spec.ts']);
  expect(specsOf(['tests/browser/face.page.spec.ts']).specs).toEqual(['face.page.spec.ts']);
  expect(specsOf(['web/tools/peer.mjs', 'web/pages/face/dials.ts']).unknown).toEqual(['web/tools/peer.mjs']);
});

test('an address belongs to a page, or to a test alone', () => {
  expect(visitedAt('/')).toBe('home');
  expect(visitedAt('/face/')).toBe('face');
  expect(visitedAt('/docs/eml.html')).toBe('docs');
  expect(visitedAt('/raconteur-composite.js')).toBe('composite');
  expect(visitedAt('/test/')).toBeUndefined();
  expect(visitedAt('/app/face-1.js')).toBeUndefined();
});
