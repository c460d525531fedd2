/** The reader of annotations, a wasm file that only this page fetches. */

import instantiate from '../../pkg/annotate/raconteur.js';
import wasmUrl from '../../pkg/annotate/raconteur_bg.wasm?url';
import { fetchModule, SCRIPT } from '../../element/base/fetching.js';
import type { Anchoring, Lists, Opened, Script, Statistics, Transcription } from './types.js';

/** Maximum size of the WebAssembly module, bytes. */
const MAX_BYTES = 16e6;

/** Functions of `crate/annotate/src/bindings.rs`. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  open(bytes: Uint8Array, mapping: string | undefined): Opened;
  toEml(transcription: Transcription, anchoring: Anchoring): Script;
  toAnvil(transcription: Transcription): string;
  statistics(transcription: Transcription): Statistics;
  lists(): Lists;
  panicMessage(): string | undefined;
}

export class Annotations {
  #module: Promise<WebAssembly.Module> | undefined;
  #instance: Promise<Instance> | undefined;

  /** Reads a file; without a mapping, the tiers of ELAN are guessed. */
  open(bytes: Uint8Array, mapping: string | undefined): Promise<Opened> {
    return this.#use((instance) => instance.open(bytes, mapping));
  }

  toEml(transcription: Transcription, anchoring: Anchoring): Promise<Script> {
    return this.#use((instance) => instance.toEml(transcription, anchoring));
  }

  toAnvil(transcription: Transcription): Promise<string> {
    return this.#use((instance) => instance.toAnvil(transcription));
  }

  statistics(transcription: Transcription): Promise<Statistics> {
    return this.#use((instance) => instance.statistics(transcription));
  }

  lists(): Promise<Lists> {
    return this.#use((instance) => instance.lists());
  }

  /** Returns the result of the instance, which the first call fetches. A panic's message becomes the error, and the next call has a fresh instance. */
  async #use<T>(work: (instance: Instance) => T): Promise<T> {
    const instance = await (this.#instance ??= this.#begin());
    try {
      return work(instance);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      this.#instance = undefined;
      const panic = instance.panicMessage();
      throw panic === undefined ? error : new Error(panic, { cause: error });
    }
  }

  async #begin(): Promise<Instance> {
    try {
      this.#module ??= fetchModule(new URL(wasmUrl, SCRIPT), { what: 'The part that reads annotations', most: MAX_BYTES });
      const instance = instantiate() as unknown as Instance;
      await instance({ module_or_path: await this.#module });
      return instance;
    } catch (error) {
      // The next call fetches it again.
      this.#module = undefined;
      this.#instance = undefined;
      throw error;
    }
  }
}
