/** Declarations for the used part of `@echogarden/espeak-ng-emscripten`, which has no types of its own. */
declare module '@echogarden/espeak-ng-emscripten' {
  /** Event in a piece of audio. */
  export interface EspeakEvent {
    readonly type: string;
    /** ms */
    readonly audio_position: number;
    /** Characters of the text, from 1. */
    readonly text_position: number;
    readonly id: string | number | undefined;
  }

  export interface EspeakWorker {
    /** Returns 0 if the voice exists. */
    set_voice(name: string): number;
    get_samplerate(): number;
    /** The text's mnemonics, as a string in memory. */
    text_to_phonemes(text: string, mode: number): { readonly ptr: number };
    /** Synthesises a text; `take` returns true to stop. */
    synthesize(text: string, take: (samples: Int16Array, events: readonly EspeakEvent[]) => boolean): void;
  }

  export interface EspeakModule {
    readonly HEAPU8: Uint8Array;
    readonly FS: {
      readdir(path: string): string[];
      stat(path: string): { readonly mode: number };
      isDir(mode: number): boolean;
      readFile(path: string, options: { encoding: 'utf8' }): string;
    };
    readonly eSpeakNGWorker: new () => EspeakWorker;
  }

  export default function create(options: { getPreloadedPackage(): ArrayBuffer }): Promise<EspeakModule>;
}
