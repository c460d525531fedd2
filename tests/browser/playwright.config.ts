import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { defineConfig } from '@playwright/test';
import { isLong, kind } from '../../web/test/tier.js';
import { chromiumArgs } from '../../web/tools/chromium.mjs';
import { PAGE, SOUND } from './kinds.mjs';
import type { BackendOption } from './stage.js';

const root = join(import.meta.dirname, '../..');
const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
const isTraced = process.env['BROWSER_TRACE'] !== undefined;
const report = process.env['BROWSER_REPORT'];

const port = Number(process.env['TEST_PORT'] ?? 4173 + 100);

export default defineConfig<BackendOption>({
  testDir: '.',
  outputDir: join(root, 'test-results'),
  reporter: [['list'], ...(report === undefined ? [] : [['json', { outputFile: report }] as const])],
  // A frame takes a tenth of a second in software, and the tests share two cores with the browser.
  timeout: 240_000,
  expect: { timeout: 60_000 },
  fullyParallel: true,
  // A test that passes at the second try hides a fault of the test or of the player.
  retries: 0,
  forbidOnly: true,
  use: {
    baseURL: `http://localhost:${port}`,
    viewport: { width: 480, height: 360 },
    launchOptions: { args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) },
    // Screenshots and page snapshots of every step take a fifth of the time; `BROWSER_TRACE=1`
    // enables them.
    trace: { mode: 'retain-on-failure', screenshots: isTraced, snapshots: isTraced, sources: isTraced },
  },
  // Back ends differ in rendering: the gate runs only rendering tests on both.
  projects: [
    { name: 'webgl', use: { backend: 'webgl' }, testIgnore: [PAGE, SOUND] },
    { name: 'webgl-sound', use: { backend: 'webgl' }, testMatch: SOUND },
    { name: 'webgpu', use: { backend: 'webgpu' }, ...(isLong ? { testIgnore: [PAGE, SOUND] } : { grep: /@draws/, testIgnore: PAGE }) },
    // A minute of sound is the same minute on either back end.
    { name: 'webgpu-sound', use: { backend: 'webgpu' }, testMatch: SOUND, testIgnore: /clock\.spec/ },
    // The behaviour of pages does not depend on their resolution, and a processor renders a quarter
    // of the pixels in a quarter of the time.
    { name: 'page', use: { backend: 'page', ...(isLong ? {} : { deviceScaleFactor: 0.5 }) }, testMatch: PAGE },
  ],
  webServer: {
    command: `node node_modules/vite/bin/vite.js preview --mode ${kind.name} --port ${port} --strictPort`,
    cwd: root,
    url: `http://localhost:${port}/`,
    reuseExistingServer: false,
  },
});
