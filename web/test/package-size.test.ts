import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { checkContents, checkSize } from '../tools/package-size.mjs';

let own: string;
const lay = (name: string, mb: number): void => writeFileSync(join(own, 'dist', name), Buffer.alloc(mb * 1e6));

beforeEach(() => {
  own = mkdtempSync(join(tmpdir(), 'raconteur-package-'));
  mkdirSync(join(own, 'dist'));
});
afterEach(() => rmSync(own, { recursive: true }));

test('no engine of a voice is in the package of the player', () => {
  expect(() => checkContents(new Set(['lit']))).not.toThrow();
  expect(() => checkContents(new Set(['lit', 'onnxruntime-web']))).toThrow('onnxruntime-web');
});

test('the player that ships has a bound, and what one page plays with has another', () => {
  // The larger back end counts, and of the scripts those that are in a page.
  for (const [name, mb] of [
    ['webgl-1.wasm', 3],
    ['webgpu-1.wasm', 2],
    ['player.js', 0.5],
    ['standalone.js', 0.5],
  ] as const)
    lay(name, mb);
  expect(() => checkSize(own)).not.toThrow();
  lay('player.js', 1.5);
  expect(() => checkSize(own)).toThrow(/page.*4\.50 MB of 4/);
  lay('player.js', 0.5);
  lay('say-1.wasm', 6);
  expect(() => checkSize(own)).toThrow(/all.*12\.00 MB of 10/);
});
