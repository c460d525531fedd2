/** A module that is cut in two behaves as before, once its other part has joined. */

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const { cut } = (await import(join(import.meta.dirname, '../tools/split.mjs'))) as { cut(text: string, door: RegExp): [string, string] };
const bin = join(import.meta.dirname, '../../node_modules/binaryen/bin');

/** `rare` and what it alone calls are to go; `shared` stays; `through` is in the table. */
const text = `(module
  (type $two (func (param i32 i32) (result i32)))
  (global $top (mut i32) (i32.const 64))
  (memory $0 1)
  (data (i32.const 8) "\\07")
  (table $0 2 2 funcref)
  (elem (i32.const 1) func $through)
  (export "memory" (memory $0))
  (export "run" (func $run))
  (func $run (param i32 i32) (result i32)
    (if (result i32) (local.get 0) (then (call $"app::motion::rare" (local.get 0) (local.get 1))) (else (call $shared (local.get 1)))))
  (func $"app::motion::rare" (param i32 i32) (result i32)
    (i32.add (call $alone (local.get 0)) (call $shared (local.get 1))))
  (func $alone (param i32) (result i32)
    (global.set $top (i32.add (global.get $top) (i32.const 1)))
    (i32.add (global.get $top) (call_indirect $0 (type $two) (local.get 0) (local.get 0) (i32.const 1))))
  (func $shared (param i32) (result i32) (i32.mul (local.get 0) (i32.load8_u (i32.const 8))))
  (func $through (param i32 i32) (result i32) (i32.mul (local.get 0) (local.get 1))))
`;

type Run = (a: number, b: number) => number;

function program(folder: string, name: string, from: string, to: string): void {
  execFileSync(process.execPath, [join(bin, name), join(folder, from), '-o', join(folder, to), '--enable-mutable-globals', '--enable-reference-types', ...(name === 'wasm-as' ? ['-g'] : [])]);
}

async function instance(bytes: Uint8Array, imports: WebAssembly.Imports = {}): Promise<WebAssembly.Exports> {
  return (await WebAssembly.instantiate(bytes as BufferSource, imports) as unknown as WebAssembly.WebAssemblyInstantiatedSource).instance.exports;
}

test('a module that is cut in two does what it did', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'split-'));
  try {
    writeFileSync(join(folder, 'in.wat'), text);
    program(folder, 'wasm-as', 'in.wat', 'whole.wasm');
    program(folder, 'wasm-dis', 'whole.wasm', 'named.wat');
    const [rest, moved] = cut(readFileSync(join(folder, 'named.wat'), 'utf8'), /::motion::/);
    expect(rest).not.toContain('$alone');
    expect(moved).toContain('$alone');
    expect(moved).not.toContain('(func $run');
    writeFileSync(join(folder, 'rest.wat'), rest);
    writeFileSync(join(folder, 'moved.wat'), moved);
    program(folder, 'wasm-as', 'rest.wat', 'rest.wasm');
    program(folder, 'wasm-as', 'moved.wat', 'moved.wasm');
    const bytes = (name: string) => readFileSync(join(folder, name));
    const whole = (await instance(bytes('whole.wasm')))['run'] as Run;
    const exports = await instance(bytes('rest.wasm'));
    const run = exports['run'] as Run;
    expect(run(0, 6)).toBe(whole(0, 6));
    // What has not joined cannot be called.
    expect(() => run(3, 6)).toThrow(WebAssembly.RuntimeError);
    await instance(bytes('moved.wasm'), { '.': exports as WebAssembly.ModuleImports });
    for (const [a, b] of [[3, 6], [0, 5], [9, 2]] as const) expect(run(a, b)).toBe(whole(a, b));
  } finally {
    rmSync(folder, { recursive: true });
  }
}, 60_000);
