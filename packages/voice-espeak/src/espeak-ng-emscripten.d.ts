/** What is used of `@echogarden/espeak-ng-emscripten`, which comes without types. */
declare module '@echogarden/espeak-ng-emscripten' {
  /** Something that happens in a sound. */
  export interface EspeakEvent {
    readonly type: string;
    /** ms */
    readonly audio_position: number;
    /** Characters of the text, from 1. */
    readonly text_position: number;
    readonly id: string | number | undefined;
  }

  export interface EspeakWorker {
    /** 0 where there is such a voice. */
    set_voice(name: string): number;
    get_samplerate(): number;
    /** The text's mnemonics, as a string in memory. */
    text_to_phonemes(text: string, mode: number): { readonly ptr: number };
    /** `take` returns true to stop. */
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
