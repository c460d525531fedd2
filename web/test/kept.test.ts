import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, utimesSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { carry } from '../tools/kept.mjs';

let folder = '';
beforeEach(() => void (folder = mkdtempSync(join(tmpdir(), 'kept-'))));
afterEach(() => rmSync(folder, { recursive: true }));

/** Writes a file of a target folder, a day old. */
function put(target: string, path: string, text = path): void {
  const file = join(folder, target, path);
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
  const yesterday = Date.now() / 1000 - 86_400;
  utimesSync(file, yesterday, yesterday);
}

/** Simulates cargo's output for a package: its fingerprint, its artefacts, and the output of its build script. */
function compiled(target: string, profile: string, name: string, hash: string): void {
  put(target, `${profile}/.fingerprint/${name}-${hash}/lib-${name}`);
  put(target, `${profile}/deps/lib${name.replaceAll('-', '_')}-${hash}.rlib`);
  put(target, `${profile}/deps/${name.replaceAll('-', '_')}-${hash}.d`);
  put(target, `${profile}/build/${name}-${hash}/out/made.rs`);
}

const files = (target: string): string[] =>
  readdirSync(join(folder, target), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name).slice(join(folder, target).length + 1))
    .sort();

test('crates of others are carried with their times, for every profile and platform, and none of the workspace', () => {
  compiled('a', 'debug', 'serde-json', '0123456789abcdef');
  compiled('a', 'wasm32-unknown-unknown/wasm-quick', 'glam', 'fedcba9876543210');
  const others = files('a');
  compiled('a', 'debug', 'raconteur-base', '1111111111111111');
  put('a', 'debug/deps/sweep-2222222222222222');
  put('a', 'debug/raconteur');
  put('a', 'debug/incremental/x/y');
  expect(carry(join(folder, 'a'), join(folder, 'b'))).toBe(2);
  expect(files('b')).toEqual(others);
  for (const path of others) {
    expect(readFileSync(join(folder, 'b', path), 'utf8')).toBe(path);
    expect(Math.abs(statSync(join(folder, 'b', path)).mtimeMs - statSync(join(folder, 'a', path)).mtimeMs)).toBeLessThan(1);
  }
});

test('what is there already stays, and what is new is added', () => {
  compiled('a', 'debug', 'glam', '0123456789abcdef');
  carry(join(folder, 'a'), join(folder, 'b'));
  put('b', 'debug/deps/libglam-0123456789abcdef.d', 'its own');
  compiled('a', 'debug', 'glam', '3333333333333333');
  expect(carry(join(folder, 'a'), join(folder, 'b'))).toBe(1);
  expect(readFileSync(join(folder, 'b/debug/deps/libglam-0123456789abcdef.d'), 'utf8')).toBe('its own');
  expect(files('b')).toContain('debug/deps/libglam-3333333333333333.rlib');
  expect(carry(join(folder, 'a'), join(folder, 'b'))).toBe(0);
});

test('what cargo rewrites of one is not rewritten in the other', () => {
  compiled('a', 'debug', 'glam', '0123456789abcdef');
  carry(join(folder, 'a'), join(folder, 'b'));
  put('b', 'debug/.fingerprint/glam-0123456789abcdef/lib-glam', 'another');
  put('b', 'debug/build/glam-0123456789abcdef/out/made.rs', 'another');
  expect(readFileSync(join(folder, 'a/debug/.fingerprint/glam-0123456789abcdef/lib-glam'), 'utf8')).not.toBe('another');
  expect(readFileSync(join(folder, 'a/debug/build/glam-0123456789abcdef/out/made.rs'), 'utf8')).not.toBe('another');
});
