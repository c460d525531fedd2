import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { defineConfig } from '@playwright/test';
import { isLong, kind } from '../../web/test/tier.js';
import { chromiumArgs } from '../../web/tools/chromium.mjs';
import type { BackendOption } from './stage.js';

const root = join(import.meta.dirname, '../..');
const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
const report = process.env['BROWSER_REPORT'];

const port = Number(process.env['TEST_PORT'] ?? 4173 + 100);

/** What is measured against sound as it is played; these have the machine for themselves. */
const SOUND = /(clock|media|music|play|voice)\.spec/;
const PAGE = /page\.spec/;

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
    trace: 'retain-on-failure',
  },
  // Back ends differ in what draws: in the gate only what is about that runs on both.
  projects: [
    { name: 'webgl', use: { backend: 'webgl' }, testIgnore: [PAGE, SOUND] },
    { name: 'webgl-sound', use: { backend: 'webgl' }, testMatch: SOUND },
    { name: 'webgpu', use: { backend: 'webgpu' }, ...(isLong ? { testIgnore: [PAGE, SOUND] } : { grep: /@draws/, testIgnore: PAGE }) },
    // A minute of sound is the same minute on either back end.
    { name: 'webgpu-sound', use: { backend: 'webgpu' }, testMatch: SOUND, testIgnore: /clock\.spec/ },
    { name: 'page', use: { backend: 'page' }, testMatch: PAGE },
  ],
  webServer: {
    command: `node node_modules/vite/bin/vite.js preview --mode ${kind.name} --port ${port} --strictPort`,
    cwd: root,
    url: `http://localhost:${port}/`,
    reuseExistingServer: false,
  },
});
