// Importing the packed files where there is no document: in Node, in its workers, in a worker of a browser and, in the long tier, in Deno.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { serve } from './package-play.mjs';
import { ask, Stop } from './steps.mjs';

/** Test module for each environment: the whole interface is available, but no element. */
export const IMPORTS = "import { RaconteurPlayer, openFaces, PlayerError } from '@raconteur/player';\nconsole.log([RaconteurPlayer, openFaces, PlayerError].map((it) => typeof it).join(' '));\n";
export const IMPORTED = 'function function function';

const THREAD = "import { Worker } from 'node:worker_threads';\nnew Worker(new URL('import.js', import.meta.url));\n";
const PAGE = '<!doctype html><title>A worker</title>';
const WORKER = "import * as player from './node_modules/@raconteur/player/dist/standalone.js';\nself.postMessage([player.RaconteurPlayer, player.openFaces, player.PlayerError].map((it) => typeof it).join(' '));\n";

/** Imports the package in plain Node and in a worker of Node. */
export function importBare(app) {
  writeFileSync(join(app, 'import.js'), IMPORTS);
  writeFileSync(join(app, 'thread.js'), THREAD);
  for (const [file, where] of [['import.js', 'Node'], ['thread.js', 'a worker of Node']]) {
    if (ask(process.execPath, [join(app, file)])?.trim() !== IMPORTED) throw new Stop(`The package cannot be imported in ${where}.`);
    console.log(`  ${where}: imports it`);
  }
}

/** Imports the package in a worker of a browser, which has no packages except the file for script tags. */
export async function importInWorker(browser, app) {
  writeFileSync(join(app, 'worker.html'), PAGE);
  writeFileSync(join(app, 'worker.js'), WORKER);
  const server = await serve(app);
  const tab = await browser.newPage();
  try {
    await tab.goto(`${server.address}worker.html`);
    const told = await tab.evaluate(
      () =>
        new Promise((done) => {
          const worker = new Worker('/worker.js', { type: 'module' });
          worker.onmessage = ({ data }) => done(data);
          worker.onerror = ({ message }) => done(message);
        }),
    );
    if (told !== IMPORTED) throw new Stop(`The package cannot be imported in a worker of a browser: ${told}`);
    console.log('  a worker of a browser: imports it');
  } finally {
    await tab.close();
    server.close();
  }
}
