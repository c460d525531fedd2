/** Speech worker with Kokoro; the worker's name is the address of its folder. */

import { fetchText } from '../element/base/fetching.js';
import { Flite } from './flite-program.js';
import { type Model, openModel, type ModelOutput, styleFor } from './kokoro-model.js';
import { DeferredAnswers } from './deferred-answers.js';
import { type Host, serve } from './serve.js';

/** Maximum size of a table of a voice, bytes; the dictionaries have some megabytes. */
const MAX_TABLE_BYTES = 64e6;

/** Letters of a word, with variants for some words by part of speech, and at the end of a phrase (`None`). */
type Entry = string | { readonly DEFAULT: string; readonly None?: string };

class Kokoro implements Host {
  readonly #model: Model;
  readonly #voices: readonly string[];
  /** Numbers of letters. */
  readonly #tokens: ReadonlyMap<string, number>;
  /** The smaller and better dictionary first. */
  readonly #words: readonly Readonly<Record<string, Entry | null>>[];
  readonly #styles = new Map<string, Float32Array>();
  readonly #spoken = new DeferredAnswers<ModelOutput>();
  readonly #flite = new DeferredAnswers<Flite>();

  private constructor(model: Model, voices: readonly string[], tokens: Record<string, number>, words: readonly Record<string, Entry | null>[]) {
    this.#model = model;
    this.#voices = voices;
    this.#tokens = new Map(Object.entries(tokens));
    this.#words = words;
  }

  static async open(folder: URL): Promise<Kokoro> {
    const json = async <T>(name: string): Promise<T> => JSON.parse(await fetchText(new URL(name, folder), { what: `${name} of the voice`, most: MAX_TABLE_BYTES })) as T;
    const [voices, { vocab }, gold, silver, model] = await Promise.all([
      json<string[]>('voices.json'),
      json<{ vocab: Record<string, number> }>('vocab.json'),
      json<Record<string, Entry | null>>('us_gold.json'),
      json<Record<string, Entry | null>>('us_silver.json'),
      openModel(folder),
    ]);
    const kokoro = new Kokoro(model, voices, vocab, [gold, silver]);
    // The first run is slow, because the browser improves its code meanwhile.
    await kokoro.#speak(voices[0] ?? '', 'ə', 1);
    return kokoro;
  }

  pending(): Promise<unknown> | undefined {
    return this.#spoken.pending() ?? this.#flite.pending();
  }

  voices(): readonly string[] {
    return this.#voices;
  }

  /** Returns the letters of a word, and those at the end of a phrase; empty if no dictionary has it. */
  word(word: string): readonly string[] {
    for (const words of this.#words) {
      const entry = Object.hasOwn(words, word) ? words[word] : undefined;
      if (typeof entry === 'string') return [entry];
      if (entry) return entry.None === undefined ? [entry.DEFAULT] : [entry.DEFAULT, entry.None];
    }
    return [];
  }

  /** Returns the phones of a word as flite reads it; undefined until flite is available. */
  guess(word: string): string | undefined {
    const flite = this.#flite.ask('', () => Flite.open());
    return flite?.run(['-voice', 'slt', '-t', word, '-ps', '-o', 'none'], [], undefined).printed.replace(/\bpau\b/g, ' ');
  }

  /** Returns the audio for letters; undefined until it is available. */
  infer(voice: string, letters: string, pace: number): ModelOutput | undefined {
    return this.#spoken.ask(`${voice} ${pace} ${letters}`, () => this.#speak(voice, letters, pace));
  }

  async #speak(voice: string, letters: string, pace: number): Promise<ModelOutput> {
    let styles = this.#styles.get(voice);
    if (styles === undefined) this.#styles.set(voice, (styles = await this.#model.voice(voice)));
    const tokens = [...letters].map((letter) => {
      const token = this.#tokens.get(letter);
      if (token === undefined) throw new Error(`Kokoro has no letter ${letter}`);
      return token;
    });
    return await this.#model.infer(tokens, styleFor(styles, tokens.length), pace);
  }
}

serve('kokoro', () => Kokoro.open(new URL(self.name)));
