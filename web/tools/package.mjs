// Packs the player for npm: `node web/tools/package.mjs [quick]` writes `.setup/package/*.tgz`, the player, its library and the
// engines of voices. `quick` packs the build of the tests.

import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { runnerImport } from 'vite';
import { manifest } from './elements.mjs';
import { FRAMEWORKS, library, place, player, version, voice } from './package-about.mjs';
import { besideFlite, copyTypes, declareTypes, LIT, litAnywhere, looksForVoices, script } from './package-build.mjs';
import { checkContents, checkSize, printSizes } from './package-size.mjs';
import { uses } from './package-uses.mjs';
import { main, root, run, Stop } from './steps.mjs';
import { buildWasm, kinds } from './wasm.mjs';

const folder = join(root, '.setup/package');
/** Types of all packages, before each gets its own. */
const declared = join(root, '.setup/package-types');
/** Library folders required by a page; measurements and descriptions next to them are not packed. */
const LIBRARY = ['figures', 'hair', 'animations', 'faces', 'music', 'stories', 'hand-shapes'];
/** Builds whose code each package has: crates and features, for the notices. */
const SAY = ['say'];
const PLAYER = [['web', 'webgpu'], ['web', 'webgl'], ['avatar'], ['faces'], SAY];

const ESPEAK = 'packages/voice-espeak';
const ESPEAK_ENGINE = 'node_modules/@echogarden/espeak-ng-emscripten';
/** Engines of voices: each a package, with a script that exports its source. */
const VOICES = [
  { name: 'voice-flite', description: 'Lets @raconteur/player speak English, by flite.', script: 'flite', source: 'web/package/voice-flite/flite.ts', readme: 'web/package/voice-flite/README.md' },
  { name: 'voice-kokoro', description: 'Lets @raconteur/player speak English with a natural voice, by Kokoro.', script: 'kokoro', source: 'web/package/voice-kokoro/kokoro.ts', readme: 'web/package/voice-kokoro/README.md', using: [besideFlite], rest: { dependencies: { '@raconteur/voice-flite': version } } },
  { name: 'voice-espeak', description: readAbout(ESPEAK).description, script: 'espeak', source: `${ESPEAK}/src/index.ts`, readme: `${ESPEAK}/README.md`, rest: { license: readAbout(ESPEAK).license }, licenses: [`${ESPEAK_ENGINE}/COPYING`] },
];

function readAbout(path) {
  return JSON.parse(readFileSync(join(root, path, 'package.json'), 'utf8'));
}

const NPM = process.platform === 'win32' ? 'npm.cmd' : 'npm';
const inPackage = (cwd) => ({ cwd, shell: process.platform === 'win32' });
const LICENSES = ['LICENSE-MIT', 'LICENSE-APACHE'];

/** Packs a folder that has its files. */
function pack(name, about, readme, licenses = LICENSES) {
  const own = join(folder, name);
  writeFileSync(join(own, 'package.json'), `${JSON.stringify(about, undefined, 2)}\n`);
  for (const file of licenses) cpSync(join(root, file), join(own, file.split('/').at(-1)));
  cpSync(join(root, readme), join(own, 'README.md'));
  run(NPM, ['pack', '--silent', '--pack-destination', folder], { ...inPackage(own), why: `Packing ${name}` });
  checkPublishing(own, name);
}

/** Checks that npm accepts the package; requires neither a network nor a login. */
function checkPublishing(own, name) {
  const { status, stderr } = spawnSync(NPM, ['publish', '--dry-run', '--offline'], { ...inPackage(own), encoding: 'utf8' });
  if (status === 0 && !stderr.includes('auto-corrected')) return;
  console.error(stderr);
  throw new Stop(`npm would not publish ${name} as it is.`);
}

/** Writes the notices for third-party work in a package. */
async function writeNotices(name, builds, packages) {
  const { module: written } = await runnerImport(join(root, 'web/tools/notices.ts'), { root, configFile: false, logLevel: 'error' });
  writeFileSync(join(folder, name, 'THIRD-PARTY-NOTICES.txt'), written.notices(root, { builds, packages }));
}

async function packPlayer(kind) {
  const own = join(folder, 'player');
  const to = join(own, 'dist');
  const entry = (name) => `web/package/player/${name}.ts`;
  // Pages load lit once, even if they use it elsewhere; a script tag cannot resolve packages.
  const bundled = await script(kind, to, 'player', entry('player'), { external: LIT, using: [looksForVoices] });
  const alone = await script(kind, to, 'standalone', entry('standalone'), { using: [litAnywhere, looksForVoices] });
  for (const name of ['player', 'standalone']) copyTypes(declared, `web/package/player/${name}.d.ts`, join(own, 'types'));
  for (const name of ['attributes', ...FRAMEWORKS]) cpSync(join(root, `web/package/player/${name}.d.ts`), join(own, `types/web/package/player/${name}.d.ts`));
  writeFileSync(join(own, 'custom-elements.json'), `${JSON.stringify(await manifest('dist/player.js'), undefined, 2)}\n`);
  const contents = new Set([...bundled, ...alone]);
  checkContents(contents);
  await writeNotices('player', PLAYER, contents);
  pack('player', player(), 'web/package/player/README.md');
}

async function packVoice(kind, { name, script: module, source, readme, using, rest, licenses, description }) {
  const own = join(folder, name);
  const packages = await script(kind, join(own, 'dist'), module, source, { using });
  const types = source.replace(/\.ts$/, '');
  copyTypes(declared, `${types}.d.ts`, join(own, 'types'));
  await writeNotices(name, [SAY], packages);
  pack(name, voice({ name, description, script: module, types, rest }), readme, licenses && [...LICENSES, ...licenses]);
}

async function packLibrary(kind) {
  const own = join(folder, 'library');
  mkdirSync(join(own, 'library'), { recursive: true });
  for (const part of LIBRARY) cpSync(join(root, 'assets', part), join(own, 'library', part), { recursive: true });
  writeFileSync(join(own, 'uses.json'), `${JSON.stringify(await uses(kind), undefined, 2)}\n`);
  cpSync(join(root, 'web/package/library/command.mjs'), join(own, 'command.mjs'));
  pack('library', library(), 'web/package/library/README.md');
}

await main(async () => {
  const kind = process.argv[2] === 'quick' ? kinds.quick : kinds.shipped;
  await buildWasm(kind);
  for (const old of [folder, declared]) rmSync(old, { recursive: true, force: true });
  declareTypes(declared);
  await packPlayer(kind);
  for (const engine of VOICES) await packVoice(kind, engine);
  await packLibrary(kind);
  printSizes(folder, ['player', 'library', ...VOICES.map(({ name }) => name)]);
  if (kind === kinds.shipped) checkSize(join(folder, 'player'));
  if (place === undefined) console.log('The packages name no repository: git has no server called origin. npm tells of no provenance of such a package; say "npm publish --no-provenance".');
  console.log(`Packed in ${folder}`);
});
