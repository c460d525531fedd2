/** Packages of `raconteur export`, and a SCORM system for them: the third-party scorm-again. */

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import type { Page } from '@playwright/test';
import { unzipSync } from 'fflate';
import { kind } from '../../web/test/tier.js';

export const root = join(import.meta.dirname, '../..');
const program = join(process.env['CARGO_TARGET_DIR'] ?? join(root, 'target'), 'debug/raconteur');
export const TYPES: { [ending: string]: string } = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

export const HELLO = join(root, 'assets/stories/hello-world');
/** Returns the files of a package. */
export function exported(standard: string, story = HELLO, ...more: readonly string[]): { readonly [path: string]: Uint8Array } {
  const file = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'course.zip');
  execFileSync(program, ['export', story, `--${standard}`, '--player', join(root, kind.site), '--title', 'Hello & welcome', '--pass', '50', ...more, '--output', file]);
  return unzipSync(readFileSync(file));
}

/** The systems, and where each has the status. */
export const SYSTEMS = {
  scorm12: { object: 'API', made: 'Scorm12API', set: 'LMSSetValue', commit: 'LMSCommit', status: ['core', 'lesson_status'], memory: 'suspend_data' },
  scorm2004: { object: 'API_1484_11', made: 'Scorm2004API', set: 'SetValue', commit: 'Commit', status: ['completion_status'], memory: 'suspend_data' },
} as const;

/** Returns the page of the system: it stores committed data, and passes it to the next session; while `refuses` is set it accepts nothing. */
const pageOf = ({ object, made, set, commit }: (typeof SYSTEMS)[keyof typeof SYSTEMS]) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>A system</title>
  <script src="system.js"></script>
  <script>
    const api = (window.${object} = new ${made}({ autocommit: false }));
    const kept = localStorage.getItem('kept');
    if (kept !== null) api.loadFromJSON(JSON.parse(kept), '');
    for (const method of ['${set}', '${commit}']) {
      const right = api[method].bind(api);
      api[method] = (...given) => (window.refuses ? 'false' : right(...given));
    }
    Object.assign(api.cmi, api.cmi.core === undefined ? { learner_id: '7' } : {});
    if (api.cmi.core !== undefined) api.cmi.core.student_id = '7';
    api.on('${commit}', () => localStorage.setItem('kept', JSON.stringify(api.renderCMIToJSONObject())));
  </script>
  <iframe src="course/index.html" title="The course" width="460" height="340" allow="autoplay"></iframe></html>`;

/** Serves a system with a package, and reports missing files. */
export async function serve(page: Page, standard: keyof typeof SYSTEMS, story = HELLO, ...more: readonly string[]): Promise<string[]> {
  const files = exported(standard, story, ...more);
  const system = SYSTEMS[standard];
  const missing: string[] = [];
  await page.route('**/lms/**', (route) => {
    const path = new URL(route.request().url()).pathname.replace(/^\/lms\//, '');
    if (path === '') return route.fulfill({ contentType: 'text/html', body: pageOf(system) });
    if (path === 'system.js') return route.fulfill({ path: join(root, `node_modules/scorm-again/dist/${standard}.js`) });
    const file = files[path.replace(/^course\//, '')];
    if (file === undefined) {
      missing.push(path);
      return route.fulfill({ status: 404 });
    }
    return route.fulfill({ contentType: TYPES[extname(path)] ?? 'application/octet-stream', body: Buffer.from(file) });
  });
  await page.goto('/lms/');
  return missing;
}

export const playerIn = (page: Page) => page.frameLocator('iframe').locator('raconteur-player');

/** Value that the system has stored under a key. */
export const kept = (page: Page, at: readonly string[]) =>
  page.evaluate(
    (path) =>
      path.reduce<unknown>((data, name) => (data as { [name: string]: unknown } | undefined)?.[name], (JSON.parse(localStorage.getItem('kept') ?? '{}') as { cmi?: unknown }).cmi),
    at,
  );
