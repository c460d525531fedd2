// Prepares a bare clone. `node web/tools/setup.mjs [page|test]`; finished steps are skipped.
//   page: packages, Rust's wasm target, both wasm builds, the built page in dist/
//   test: all of that, a browser with software rendering, and speech engines
// Only Node's own modules: this installs the others.

import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { ask, main, once, root, run, Stop } from './steps.mjs';
import { buildWasm } from './wasm.mjs';

/** npm packages, exactly as locked. */
export async function packages() {
  await once(
    'packages',
    { inputs: ['package.json', 'package-lock.json'], extra: process.version, outputs: ['node_modules/.package-lock.json'] },
    () => run(process.platform === 'win32' ? 'npm.cmd' : 'npm', ['ci', '--no-audit', '--no-fund'], {
      shell: process.platform === 'win32',
      why: 'Installing the npm packages',
    }),
  );
}

/** The pinned Rust toolchain with the wasm target. */
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

/** A compiler of C++: the simplifier that makes levels of detail is written in it. */
export async function cpp() {
  // On Windows Rust's own linker comes with one.
  if (process.platform === 'win32' || ask(process.env['CXX'] ?? 'c++', ['--version']) !== undefined) return;
  if (installed(['g++'])) return;
  throw new Stop('The command line needs a compiler of C++: install g++ or clang with your system’s packages, then run this again.');
}

function hasWasmTarget() {
  const folder = ask('rustc', ['--print', 'target-libdir', '--target', 'wasm32-unknown-unknown'])?.trim();
  return folder !== undefined && existsSync(folder);
}

/** The page, built into dist/. */
export async function page() {
  await packages();
  await rust();
  await buildWasm();
  await once(
    'page',
    {
      inputs: ['index.html', 'gestures', 'viewer', 'face', 'vite.config.ts', 'package-lock.json', 'web/element', 'web/pages', 'web/tools/docs.ts', 'web/tools/links.ts', 'web/tools/notices.ts', 'web/tools/parts.ts', 'assets',
        'README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'SECURITY.md', 'docs', '.setup/wasm-webgpu', '.setup/wasm-webgl', '.setup/wasm-avatar'],
      outputs: ['dist/index.html'],
    },
    async () => {
      const { build } = await import('vite');
      await build({ root, logLevel: 'warn' });
    },
  );
}

/** A Chromium that draws without a graphics card, and a Vulkan that does. */
export async function browser() {
  const missing = [];
  if (!chromium()) missing.push('chromium');
  const drivers = ['/usr/share/vulkan/icd.d', '/etc/vulkan/icd.d'];
  const icd = process.env['VK_DRIVER_FILES'] ?? process.env['VK_ICD_FILENAMES'];
  if (process.platform === 'linux' && icd === undefined && !drivers.some((d) => existsSync(d))) {
    missing.push('mesa-vulkan-drivers', 'libvulkan1');
  }
  if (missing.length === 0 || installed(['chromium', 'mesa-vulkan-drivers', 'libvulkan1', 'libegl1', 'libgl1-mesa-dri'])) return;
  throw new Stop(
    `The tests need ${missing.join(', ')}: install ${missing.length > 1 ? 'them' : 'it'} with your system's packages` +
      (missing.includes('chromium') ? ' (or run "npx playwright install chromium")' : '') +
      ', then run this again.',
  );
}

/** Speech engines with voices to measure, and what encodes their sound. */
export async function engines() {
  const runs = (program, ...args) => spawnSync(program, args, { stdio: 'ignore' }).error === undefined;
  const festival = ask('festival', ['-b', '(print (voice.list))']) ?? '';
  const packages = {
    festival: runs('festival', '--version'),
    'festvox-us-slt-hts': festival.includes('cmu_us_slt_arctic_hts'),
    'festvox-kallpc16k': festival.includes('kal_diphone'),
    'festvox-kdlpc16k': festival.includes('ked_diphone'),
    flite: runs('flite', '--version'),
    // The program brings its library, which is what speaks.
    'espeak-ng': runs('espeak-ng', '--version'),
    'opus-tools': runs('opusenc', '--version'),
    ffmpeg: runs('ffmpeg', '-version'),
  };
  const missing = Object.keys(packages).filter((name) => !packages[name]);
  if (missing.length === 0 || installed([...Object.keys(packages), 'libespeak-ng1'])) return;
  throw new Stop(
    `Measuring voices needs ${missing.join(', ')} (names of Debian's packages): install ${missing.length > 1 ? 'them' : 'it'}, then run this again.`,
  );
}

/** The spelling checker: the one on the path, or its wheel, unpacked beside the stamps. */
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

/** Installs packages where that can be done: on Debian and its kin, as root. Tells whether it was. */
function installed(packages) {
  const debian = existsSync('/etc/debian_version') && ask('apt-get', ['--version']) !== undefined;
  if (!debian || process.getuid?.() !== 0) return false;
  const env = { ...process.env, DEBIAN_FRONTEND: 'noninteractive' };
  run('apt-get', ['update', '-qq'], { env, why: 'Updating the package lists' });
  run('apt-get', ['install', '-y', '-qq', '--no-install-recommends', ...packages], { env, why: `Installing ${packages.join(', ')}` });
  return true;
}

/** The browser for the tests: the system's, or Playwright's own download. */
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
      await cpp();
      await browser();
      await engines();
    }
    console.log('Everything is in place.');
  });
}
