import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { defineConfig } from '@playwright/test';
import { chromiumArgs } from '../../web/tools/chromium.mjs';

const root = join(import.meta.dirname, '../..');
const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

const port = Number(process.env['TEST_PORT'] ?? 4173 + 100);

export default defineConfig({
  testDir: '.',
  outputDir: join(root, 'test-results'),
  reporter: [['list']],
  // A picture takes a tenth of a second in software, and two cores are shared with the browser.
  timeout: 120_000,
  expect: { timeout: 30_000 },
  workers: 1,
  // Sound runs in real time, and a machine that many share may stop for seconds: a test that fails is
  // tried once more, and one that passes then is listed as flaky.
  retries: 1,
  forbidOnly: true,
  use: {
    baseURL: `http://localhost:${port}`,
    viewport: { width: 480, height: 360 },
    launchOptions: { args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) },
    trace: 'retain-on-failure',
  },
  projects: [
    { name: 'webgpu', testIgnore: /page\.spec/ },
    // A minute of sound is the same minute on either back end.
    { name: 'webgl', testIgnore: /(page|clock)\.spec/ },
    { name: 'page', testMatch: /page\.spec/ },
  ],
  webServer: {
    command: `node node_modules/vite/bin/vite.js preview --port ${port} --strictPort`,
    cwd: root,
    url: `http://localhost:${port}/`,
    reuseExistingServer: false,
  },
});
