// Does what a new user does with the packed files: lays them into an empty folder, builds a page with a bundler's
// defaults and plays a story in a browser. `npm run package` has packed them.

import { existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { chromium } from '@playwright/test';
import { chromiumArgs } from './chromium.mjs';
import { ask, main, root, run, start, Stop } from './steps.mjs';

const packed = join(root, '.setup/package');
const folder = join(root, '.setup/package-check');
const STORY = 'raconteur/stories/hello-world/story.eml';
const PLAYED_MS = 60_000;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css' };

const page = (script) => `<!doctype html>
<html lang="en">
  <head><meta charset="utf-8" /><title>An application</title><script type="module" src="${script}"></script></head>
  <body><raconteur-player src="/${STORY}" assets="/raconteur/" loading="eager" label="Hello world"></raconteur-player></body>
</html>
`;

/** Bundlers by what they build an application with, and the folder that is served then. */
const BUNDLERS = {
  vite: { script: '/main.js', served: 'dist', build: (app) => start(process.execPath, [join(root, 'node_modules/vite/bin/vite.js'), 'build', '--logLevel', 'warn'], { cwd: app }) },
  rolldown: { script: '/built/main.js', served: '.', build: (app) => start(process.execPath, [join(root, 'node_modules/rolldown/bin/cli.mjs'), 'main.js', '--dir', 'built', '--platform', 'browser'], { cwd: app, stdio: 'ignore' }) },
};

/** Lays a packed file where `npm install` would; what it depends on is found further up. */
function install(app, name) {
  const to = join(app, 'node_modules/@raconteur', name);
  mkdirSync(to, { recursive: true });
  const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
  run('tar', ['-xzf', join(packed, `raconteur-${name}-${version}.tgz`), '-C', to, '--strip-components=1'], { why: `Unpacking ${name}` });
  return to;
}

async function serve(served) {
  const server = createServer(async ({ url = '/' }, response) => {
    const path = decodeURIComponent(url.split('?')[0] ?? '/');
    const file = join(served, path.endsWith('/') ? `${path}index.html` : path);
    const bytes = await readFile(file).catch(() => undefined);
    if (bytes === undefined) response.writeHead(404).end();
    else response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream' }).end(bytes);
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  return server;
}

/** Plays the story to its end; what was said. */
async function play(browser, address) {
  const tab = await browser.newPage();
  const faults = [];
  tab.on('pageerror', (error) => faults.push(error.message));
  await tab.goto(address);
  const told = await tab.evaluate(async (most) => {
    const player = document.querySelector('raconteur-player');
    const words = [];
    player.addEventListener('word', ({ detail }) => words.push(detail.word.text));
    const ended = new Promise((done) => player.addEventListener('ended', () => done('ended')));
    const late = new Promise((done) => setTimeout(() => done('late'), most));
    await customElements.whenDefined('raconteur-player');
    await player.play();
    return { outcome: await Promise.race([ended, late]), words, error: player.error?.message };
  }, PLAYED_MS);
  await tab.close();
  return { ...told, faults };
}

await main(async () => {
  if (!existsSync(packed)) throw new Stop('There are no packed files: run "npm run package" first.');
  rmSync(folder, { recursive: true, force: true });
  // Where there are no elements, importing it does nothing.
  const first = join(folder, 'vite');
  install(first, 'player');
  writeFileSync(join(first, 'package.json'), '{ "type": "module" }\n');
  writeFileSync(join(first, 'import.js'), "import { RaconteurPlayer } from '@raconteur/player';\nconsole.log(typeof RaconteurPlayer);\n");
  if (ask(process.execPath, [join(first, 'import.js')])?.trim() !== 'function') throw new Stop('The package cannot be imported in Node.');
  const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
  const browser = await chromium.launch({ args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) });
  try {
    for (const [name, { script, served, build }] of Object.entries(BUNDLERS)) {
      const app = join(folder, name);
      if (app !== first) install(app, 'player');
      const assets = install(app, 'assets');
      writeFileSync(join(app, 'package.json'), '{ "type": "module" }\n');
      writeFileSync(join(app, 'main.js'), "import '@raconteur/player';\n");
      writeFileSync(join(app, 'index.html'), page(script));
      run(process.execPath, [join(assets, 'copy.mjs'), join(app, 'public/raconteur'), '--only', 'figures,animations,stories,player'], { stdio: 'ignore', why: 'Copying the library' });
      if (served === '.') symlinkSync(join(app, 'public/raconteur'), join(app, 'raconteur'));
      await build(app);
      const server = await serve(join(app, served));
      const told = await play(browser, `http://127.0.0.1:${server.address().port}/`);
      server.close();
      if (told.outcome !== 'ended' || told.words.join(' ') !== 'Hello world!' || told.faults.length > 0) throw new Stop(`A page that ${name} builds does not play: ${JSON.stringify(told)}`);
      console.log(`  ${name}: says ${told.words.join(' ')}`);
    }
  } finally {
    await browser.close();
  }
});
