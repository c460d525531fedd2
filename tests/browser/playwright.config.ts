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
  // A picture takes a tenth of a second in software, and two cores are shared with the browser.
  timeout: 240_000,
  expect: { timeout: 60_000 },
  fullyParallel: true,
  // A test that passes at the second try hides a fault: of its own, or of the player.
  retries: 0,
  forbidOnly: true,
  use: {
    baseURL: `http://localhost:${port}`,
    viewport: { width: 480, height: 360 },
    launchOptions: { args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) },
    // Pictures and copies of the page for every step take a fifth of the time: `BROWSER_TRACE=1` asks for them.
    trace: { mode: 'retain-on-failure', screenshots: isTraced, snapshots: isTraced, sources: isTraced },
  },
  // Back ends differ in what draws: in the gate only what is about that runs on both.
  projects: [
    { name: 'webgl', use: { backend: 'webgl' }, testIgnore: [PAGE, SOUND] },
    { name: 'webgl-sound', use: { backend: 'webgl' }, testMatch: SOUND },
    { name: 'webgpu', use: { backend: 'webgpu' }, ...(isLong ? { testIgnore: [PAGE, SOUND] } : { grep: /@draws/, testIgnore: PAGE }) },
    // A minute of sound is the same minute on either back end.
    { name: 'webgpu-sound', use: { backend: 'webgpu' }, testMatch: SOUND, testIgnore: /clock\.spec/ },
    // What pages do does not depend on how finely they are drawn, and a processor draws a quarter of the pixels in a quarter of the time.
    { name: 'page', use: { backend: 'page', ...(isLong ? {} : { deviceScaleFactor: 0.5 }) }, testMatch: PAGE },
  ],
  webServer: {
    command: `node node_modules/vite/bin/vite.js preview --mode ${kind.name} --port ${port} --strictPort`,
    cwd: root,
    url: `http://localhost:${port}/`,
    reuseExistingServer: false,
  },
});
