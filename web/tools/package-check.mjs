// Tests the packed files like a new user: puts them into an empty folder, builds a page with a
// bundler's defaults and plays a story in a browser. `npm run package` has packed them.

import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { importBare, importInWorker } from './package-bare.mjs';
import { copyLibrary, openBrowser, play, playWithoutVoice, serve, STORY } from './package-play.mjs';
import { main, root, run, start, Stop } from './steps.mjs';

const packed = join(root, '.setup/package');
const folder = join(root, '.setup/package-check');

const page = (script, library = '/') => `<!doctype html>
<html lang="en">
  <head><meta charset="utf-8" /><title>An application</title><script type="module" src="${script}"></script></head>
  <body><raconteur-player src="${library}${STORY}" assets="${library}raconteur/" loading="eager" label="Hello world"></raconteur-player></body>
</html>
`;

/** Page with packaged voices: one that speaks, and one whose folder is missing. */
const MAIN = `import { addSpeechSource } from '@raconteur/player';
import { espeak } from '@raconteur/voice-espeak';
import { naturalVoice } from '@raconteur/voice-kokoro';

addSpeechSource(espeak);
if (await naturalVoice(new URL('/raconteur/voices/kokoro/', document.baseURI))) throw new Error('There is no natural voice.');
`;

/** Bundlers: build command, and the served folder. */
const BUNDLERS = {
  vite: { script: '/main.js', served: 'dist', build: (app) => start(process.execPath, [join(root, 'node_modules/vite/bin/vite.js'), 'build', '--logLevel', 'warn'], { cwd: app }) },
  rolldown: { script: '/built/main.js', served: '.', build: (app) => start(process.execPath, [join(root, 'node_modules/rolldown/bin/cli.mjs'), 'main.js', '--dir', 'built', '--platform', 'browser'], { cwd: app, stdio: 'ignore' }) },
};

/** Unpacks a packed file where `npm install` would; its dependencies are found in parent folders. */
function install(app, name) {
  const to = join(app, 'node_modules/@raconteur', name);
  mkdirSync(to, { recursive: true });
  const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
  run('tar', ['-xzf', join(packed, `raconteur-${name}-${version}.tgz`), '-C', to, '--strip-components=1'], { why: `Unpacking ${name}` });
  return to;
}

/** Story of the page, and all voices; kokoro's includes flite's. */
const CHOICES = ['--stories', 'hello-world', '--voices', 'espeak,kokoro'];

/** Creates an application's folder with the packed files and a page. */
function lay(name, script) {
  const app = join(folder, name);
  for (const part of ['player', 'voice-flite', 'voice-espeak', 'voice-kokoro']) install(app, part);
  writeFileSync(join(app, 'package.json'), '{ "type": "module" }\n');
  writeFileSync(join(app, 'main.js'), MAIN);
  writeFileSync(join(app, 'index.html'), page(script));
  copyLibrary(app, install(app, 'library'), CHOICES);
  return app;
}

/** Checks that the command copies only used files, and reports missing ones. */
function checkCommand(app) {
  const library = join(app, 'public/raconteur');
  for (const used of ['stories/hello-world/story.eml', 'figures/sofia.glb', 'music/neutral.mp3', 'animations/stand.json', 'player/player.js', 'voices/flite/flite.js', 'voices/kokoro/kokoro.js']) {
    if (!existsSync(join(library, used))) throw new Stop(`The command does not copy ${used}.`);
  }
  for (const unused of ['stories/white-rabbit', 'figures/papous.glb', 'music/positive-lively.mp3', 'faces']) {
    if (existsSync(join(library, unused))) throw new Stop(`The command copies ${unused}.`);
  }
  for (const wrong of [['--stories', 'nonesuch'], ['--voices', 'nonesuch'], ['--everything']]) {
    const { status, stderr } = spawnSync(process.execPath, [join(app, 'node_modules/@raconteur/library/command.mjs'), 'elsewhere', ...wrong], { cwd: app, encoding: 'utf8' });
    if (status !== 1 || !stderr.includes('raconteur-library: ')) throw new Stop(`The command takes ${wrong.join(' ')}: ${stderr}`);
  }
  if (existsSync(join(app, 'elsewhere'))) throw new Stop('The command copies before it knows what.');
}

/** Checks a script tag that names a file on another server, which has the package and the library, as package servers do. */
async function checkScriptTag(browser, app) {
  const packages = await serve(app, { cors: true });
  const script = `${packages.address}node_modules/@raconteur/player/dist/standalone.js`;
  const bare = join(folder, 'script-tag');
  mkdirSync(bare, { recursive: true });
  writeFileSync(join(bare, 'index.html'), page(script, packages.address));
  const site = await serve(bare);
  try {
    const { words } = await play(browser, 'A script tag that names another server', site.address);
    console.log(`  script tag: says ${words.join(' ')}`);
  } finally {
    packages.close();
    site.close();
  }
}

await main(async () => {
  if (!existsSync(packed)) throw new Stop('There are no packed files: run "npm run package" first.');
  rmSync(folder, { recursive: true, force: true });
  const browser = await openBrowser();
  try {
    for (const [name, { script, served, build }] of Object.entries(BUNDLERS)) {
      const app = lay(name, script);
      if (served === '.') symlinkSync(join(app, 'public/raconteur'), join(app, 'raconteur'), 'junction');
      await build(app);
      const server = await serve(join(app, served), { strict: true });
      try {
        const { words } = await play(browser, `A page that ${name} builds`, server.address, { languages: ['en', 'de'] });
        console.log(`  ${name}: says ${words.join(' ')}`);
      } finally {
        server.close();
      }
    }
    checkCommand(join(folder, 'vite'));
    rmSync(join(folder, 'vite/dist/raconteur/voices'), { recursive: true });
    const mute = await serve(join(folder, 'vite/dist'), { strict: true });
    console.log(`  no voice: ${await playWithoutVoice(browser, mute.address)}`);
    mute.close();
    const app = join(folder, 'rolldown');
    await checkScriptTag(browser, app);
    importBare(app);
    await importInWorker(browser, app);
  } finally {
    await browser.close();
  }
});
