/** Speech synthesis with espeak-ng. */

import createEspeak, { type EspeakModule, type EspeakWorker } from '@echogarden/espeak-ng-emscripten';
import dataUrl from '@echogarden/espeak-ng-emscripten/espeak-ng.data?url';
import { fetched, type Host, serve } from '../../../web/speech/serve.js';

/** Version of the package's build; the library reports none. */
const VERSION = '1.52.0';
const DATA = '/usr/share/espeak-ng-data';
/** Maximum length of a text, characters; the baker passes sentences. */
const MAX_CHARACTERS = 100_000;

/** Event at a sample: `Event` of `crate/voice`. */
type Event = { readonly sample: number } & ({ readonly kind: 'word'; readonly position: number } | { readonly kind: 'phone'; readonly symbol: string } | { readonly kind: 'end' });

/** The library. */
class Espeak implements Host {
  readonly #module: EspeakModule;
  readonly #worker: EspeakWorker;
  /** Initial memory of the library, before any speech. */
  readonly #fresh: Uint8Array;

  constructor(module: EspeakModule) {
    this.#module = module;
    this.#worker = new module.eSpeakNGWorker();
    // The module keeps a buffer for strings and enlarges it with the second string that did not
    // fit. From then on the longest strings fit, and the buffer is part of the new memory.
    for (let i = 0; i < 2; i++) this.#worker.set_voice('x'.repeat(4 * MAX_CHARACTERS));
    this.#fresh = module.HEAPU8.slice();
  }

  pending(): undefined {
    return undefined;
  }

  version(): string {
    return VERSION;
  }

  files(folder: string): string[] {
    const { FS } = this.#module;
    const names = (path: string): string[] => FS.readdir(path).filter((name) => name !== '.' && name !== '..');
    const all = names(`${DATA}/${folder}`).flatMap((name) => {
      const path = `${DATA}/${folder}/${name}`;
      return FS.isDir(FS.stat(path).mode) ? names(path).map((file) => `${name}/${file}`) : [name];
    });
    return all.sort();
  }

  text(path: string): string {
    return this.#module.FS.readFile(`${DATA}/${path}`, { encoding: 'utf8' });
  }

  /** Synthesises a text. The library carries noise and flutter over from text to text, so its initial memory is restored. */
  say(voice: string, text: string): { samples: Int16Array; rateHz: number; events: Event[]; marked: string } {
    if (text.length > MAX_CHARACTERS) throw new Error('the sentence is too long');
    this.#module.HEAPU8.set(this.#fresh);
    const worker = this.#worker;
    if (worker.set_voice(voice) !== 0) throw new Error(`espeak-ng has no voice ${voice}`);
    const marked = this.#string(worker.text_to_phonemes(text, 0).ptr);
    const rateHz = worker.get_samplerate();
    const pieces: Int16Array[] = [];
    const events: Event[] = [];
    worker.synthesize(text, (samples, told) => {
      pieces.push(samples);
      for (const { type, audio_position, text_position, id } of told) {
        const sample = Math.round((audio_position * rateHz) / 1000);
        if (type === 'word') events.push({ kind: 'word', sample, position: text_position });
        else if (type === 'phoneme') events.push({ kind: 'phone', sample, symbol: String(id ?? '') });
        else if (type === 'end') events.push({ kind: 'end', sample });
      }
      return false;
    });
    const samples = new Int16Array(pieces.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const piece of pieces) {
      samples.set(piece, at);
      at += piece.length;
    }
    return { samples, rateHz, events, marked };
  }

  /** Returns a string from its memory, up to the terminating 0. */
  #string(start: number): string {
    const memory = this.#module.HEAPU8;
    return new TextDecoder().decode(memory.slice(start, memory.indexOf(0, start)));
  }
}

serve('espeak-ng', async () => {
  const data = await (await fetched(new URL(dataUrl, import.meta.url))).arrayBuffer();
  return new Espeak(await createEspeak({ getPreloadedPackage: () => data }));
});
