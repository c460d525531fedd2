// Collects the licences of everything that is built into the site: Rust's library and crates in the
// wasm files, npm packages in the scripts. Reads them from the folders of the compiler and the
// package managers.

import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { rustLibrary } from './rust-library.js';

/** Third-party component of the site. */
export interface Component {
  readonly name: string;
  readonly version: string;
  /** Licence as an SPDX expression. */
  readonly license: string;
  readonly source: string;
  /** Licence and notice files, exactly as in the package. */
  readonly texts: readonly string[];
}

const LICENSE_FILE = /^(licen[sc]e|copying|notice|copyright)/i;

function textsIn(folder: string): string[] {
  const files = readdirSync(folder, { withFileTypes: true }).filter((entry) => entry.isFile() && LICENSE_FILE.test(entry.name));
  return files.map(({ name }) => readFileSync(join(folder, name), 'utf8').replaceAll('\r\n', '\n').trim()).sort();
}

interface Metadata {
  readonly packages: readonly { id: string; name: string; version: string; license: string | null; repository: string | null; source: string | null; manifest_path: string }[];
  readonly resolve: { readonly nodes: readonly { id: string; deps: readonly { pkg: string; dep_kinds: readonly { kind: string | null }[] }[] }[] };
}

/** Crate of the project with its own build, and the features of it. */
type Build = readonly [crate: string, ...features: readonly string[]];

/** Build contents: wasm files, and npm packages: all dependencies of the project, or some by name. */
export interface Contents {
  readonly builds: readonly Build[];
  readonly packages?: Iterable<string>;
}

const SITE: Contents = { builds: [['web', 'webgpu'], ['web', 'webgl'], ['annotate'], ['avatar'], ['faces'], ['say']] };

/** Crates that are compiled into wasm files. */
function crates(root: string, builds: readonly Build[]): Component[] {
  const found = new Map<string, Component>();
  for (const [crate, ...features] of builds) {
    const { status, stdout, stderr } = spawnSync(
      'cargo',
      [
        'metadata',
        '--locked',
        '--format-version',
        '1',
        '--filter-platform',
        'wasm32-unknown-unknown',
        '--manifest-path',
        join(root, `crate/${crate}/Cargo.toml`),
        ...features.flatMap((feature) => ['--features', feature]),
      ],
      { cwd: root, encoding: 'utf8', maxBuffer: 1e8 },
    );
    if (status !== 0) throw new Error(`cargo metadata failed: ${stderr}`);
    const { packages, resolve } = JSON.parse(stdout) as Metadata;
    const nodes = new Map(resolve.nodes.map((node) => [node.id, node]));
    const start = packages.find(({ name }) => name === `raconteur-${crate}`);
    if (start === undefined) throw new Error(`cargo metadata does not name raconteur-${crate}.`);
    // Packages that only build or test it are not included.
    const reached = new Set([start.id]);
    for (const id of reached) {
      for (const { pkg, dep_kinds } of nodes.get(id)?.deps ?? []) if (dep_kinds.some(({ kind }) => kind === null)) reached.add(pkg);
    }
    for (const { id, name, version, license, repository, source, manifest_path } of packages) {
      if (!reached.has(id) || source === null) continue;
      const texts = textsIn(dirname(manifest_path));
      found.set(id, { name, version, license: license ?? 'see below', source: repository ?? 'https://crates.io', texts });
    }
  }
  return [...found.values()];
}

/** Returns the licence of a package without a licence text: MIT, with the copyright from the start of its script. */
function plainMit(root: string, folder: string, script: string): string[] {
  const [copyright] = /Copyright .*/.exec(readFileSync(join(folder, script), 'utf8').slice(0, 1000)) ?? [];
  if (copyright === undefined) return [];
  const own = readFileSync(join(root, 'LICENSE-MIT'), 'utf8');
  return [`MIT License\n\n${copyright}\n\n${own.slice(own.indexOf('Permission is')).trim()}`];
}

/** Returns the npm package in a folder. */
function packageAt(root: string, folder: string): Component {
  const { name, version, license, repository, main } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as {
    name: string;
    version: string;
    license?: string;
    repository?: string | { url: string };
    main?: string;
  };
  const source = typeof repository === 'string' ? repository : (repository?.url ?? 'https://www.npmjs.com');
  const texts = textsIn(folder);
  const isPlain = texts.length === 0 && license === 'MIT' && main !== undefined;
  return { name, version, license: license ?? 'see below', source, texts: isPlain ? plainMit(root, folder, main) : texts };
}

/** Packages that are bundled into the scripts: the project's dependencies and theirs. */
function packages(root: string): Component[] {
  const found = new Map<string, Component>();
  const visit = (folder: string): void => {
    const { dependencies = {} } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as { dependencies?: Record<string, string> };
    for (const name of Object.keys(dependencies)) {
      const own = join(folder, 'node_modules', name);
      const place = existsSync(own) ? own : join(root, 'node_modules', name);
      if (found.has(place)) continue;
      // Types do not exist at run time.
      if (name.startsWith('@types/')) continue;
      found.set(place, packageAt(root, place));
      visit(place);
    }
  };
  visit(root);
  return [...found.values()];
}

/** Returns the notices for third-party parts of the site, or of `contents`, as one text. Identical licence texts appear once, under all their components. */
export function notices(root: string, contents: Contents = SITE): string {
  const named = contents.packages && [...contents.packages].map((name) => packageAt(root, join(root, 'node_modules', name)));
  const all = [...rustLibrary(root), ...crates(root, contents.builds), ...(named ?? packages(root))].sort((a, b) => (a.name < b.name ? -1 : a.name > b.name ? 1 : 0));
  const list = all.map(({ name, version, license, source }) => `${name} ${version}: ${license} (${source})`);
  const owners = new Map<string, string[]>();
  for (const { name, texts } of all) for (const text of texts) owners.set(text, [...(owners.get(text) ?? []), name]);
  const texts = [...owners].map(([text, names]) => `${'='.repeat(78)}\n${[...new Set(names)].join(', ')}\n${'-'.repeat(78)}\n${text}\n`);
  return ['Raconteur is licensed under MIT or Apache-2.0. What its built files contain of others:\n', ...list, '\nTheir licences and notices:\n', ...texts].join('\n');
}
