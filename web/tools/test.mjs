// `npm test`: prepares everything, then checks everything, the quick checks first.
// `npm test -- NAME…` runs only the named checks, `npm test -- --changed` those that the files need which
// differ from the branch main, and Rust's tests of the crates that they reach.

import { needed } from './changed.mjs';
import { main, run, Stop } from './steps.mjs';
import { browser, cpp, engines, packages, page, rust, typos } from './setup.mjs';
import { backends, buildWasm } from './wasm.mjs';

const cargo = (...args) => run('cargo', args);
const node = (file, ...args) => run(process.execPath, [file, ...args]);

/** Name, and what it does. */
const checks = {
  format: () => cargo('fmt', '--all', '--check'),
  clippy: () => cargo('clippy', '--locked', '--workspace', '--all-targets', '--', '--deny', 'warnings'),
  'clippy-wasm': () => {
    for (const backend of backends) {
      cargo('clippy', '--locked', '--package', 'raconteur-web', '--target', 'wasm32-unknown-unknown',
        '--features', backend, '--', '--deny', 'warnings');
    }
  },
  doc: () => run('cargo', ['doc', '--locked', '--workspace', '--no-deps'], { env: { ...process.env, RUSTDOCFLAGS: '--deny warnings' } }),
  rust: (crates) => cargo('test', '--locked', ...(crates?.flatMap((name) => ['--package', name]) ?? ['--workspace'])),
  voices: async () => {
    await engines();
    node('web/tools/voices.mjs', '--check');
  },
  wasm: () => buildWasm(),
  lint: () => node('node_modules/@biomejs/biome/bin/biome', 'check', '--error-on-warnings', '.'),
  spelling: async () => run(await typos(), []),
  types: () => node('node_modules/typescript/bin/tsc', '--noEmit'),
  unit: () => {
    // The poses of the wasm builds are compared with the command line's.
    cargo('build', '--locked', '--package', 'raconteur-cli');
    node('node_modules/vitest/vitest.mjs', 'run');
  },
  size: async () => {
    await page();
    node('web/tools/size.mjs');
  },
  browser: async () => {
    await page();
    await browser();
    // Figures are compared with the command line's pictures of them.
    cargo('build', '--locked', '--package', 'raconteur-cli');
    node('node_modules/@playwright/test/cli.js', 'test', '--config', 'tests/browser/playwright.config.ts');
  },
};

await main(async () => {
  const change = process.argv.includes('--changed') ? needed() : undefined;
  if (change?.checks.length === 0) {
    console.log('Nothing differs from main that a check looks at.');
    return;
  }
  const wanted = change?.checks ?? process.argv.slice(2);
  const unknown = wanted.find((name) => !(name in checks));
  if (unknown !== undefined) throw new Stop(`There is no check ${unknown}; there are ${Object.keys(checks).join(', ')}.`);
  await packages();
  await rust();
  await cpp();
  // Rust's own tests draw pictures and bake speech: the software Vulkan and the engines come before them.
  if (wanted.length === 0 || wanted.includes('rust')) {
    await browser();
    await engines();
  }
  const times = [];
  for (const [name, check] of Object.entries(checks)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    console.log(`\n=== ${name}`);
    const start = Date.now();
    await check(change?.crates);
    times.push(`${name} ${((Date.now() - start) / 1000).toFixed(0)} s`);
  }
  console.log(`\nAll is well: ${times.join(', ')}.`);
});
