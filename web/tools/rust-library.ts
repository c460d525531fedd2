// Collects the licences of Rust's standard library, which is part of every wasm file, and of the
// crates in it, as included with the compiler.

import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Component } from './notices.js';

/** Third-party crates in the standard library of `wasm32-unknown-unknown`. */
const CRATES = ['cfg-if', 'dlmalloc', 'foldhash', 'hashbrown', 'rustc-demangle'];

/** Statements of the compiler's own licence list about files in the library's repository. */
const OWN = [
  { license: 'MIT', holder: 'The Rust Project Developers (see https://thanks.rust-lang.org)' },
  { license: 'Apache-2.0', holder: 'The Rust Project Developers (see https://thanks.rust-lang.org)' },
  { license: 'Unicode-3.0', holder: '1991-2024 Unicode, Inc (library/core/src/unicode/unicode_data.rs)' },
];

const ENTITIES: { readonly [entity: string]: string } = { '&#60;': '<', '&#62;': '>', '&#34;': '"', '&#39;': "'", '&#38;': '&' };

const plain = (html: string) => html.replace(/&#\d+;/g, (entity) => ENTITIES[entity] ?? entity).trim();

/** Returns the library and its crates as components. */
export function rustLibrary(root: string): Component[] {
  const { status, stdout, stderr } = spawnSync('rustc', ['--print', 'sysroot'], { cwd: root, encoding: 'utf8' });
  if (status !== 0) throw new Error(`rustc does not tell where it is: ${stderr}`);
  const folder = join(stdout.trim(), 'share/doc/rust');
  const read = (name: string) => readFileSync(join(folder, name), 'utf8').replaceAll('\r\n', '\n').trim();
  const library: Component = {
    name: 'The Rust standard library',
    version: 'as in rust-toolchain.toml',
    license: '(MIT OR Apache-2.0) AND Unicode-3.0',
    source: 'https://github.com/rust-lang/rust',
    texts: OWN.map(({ license, holder }) => `Copyright: ${holder}\n\n${read(`licenses/${license}.txt`)}`),
  };
  const entries = read('COPYRIGHT-library.html').split('<h3>📦 ').slice(1);
  const crates = CRATES.map((name) => {
    const entry = entries.find((one) => one.startsWith(`${name}-`) && /\d/.test(one[name.length + 1] ?? ''));
    if (entry === undefined) throw new Error(`The compiler's list of licences does not name ${name}.`);
    const [, version = ''] = /^[\w-]+?-(\d[^<]*)</.exec(entry) ?? [];
    const [, license = 'see below'] = /<b>License:<\/b> ([^<]+)</.exec(entry) ?? [];
    const texts = [...entry.matchAll(/<pre>(.*?)<\/pre>/gs)].map(([, text = '']) => plain(text));
    return { name, version, license: plain(license), source: `https://crates.io/crates/${name}/${version}`, texts };
  });
  return [library, ...crates];
}
