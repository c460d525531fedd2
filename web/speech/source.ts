/** Interface of sources that speak text without a recording. */

/** Speech request. */
export interface SpeechRequest {
  /** A script, or a list of clauses. */
  readonly eml: string;
  readonly fragment?: boolean;
  /** Text of the script's existing bundle; its contents are not spoken again. */
  readonly known?: string | undefined;
  /** Name of a voice of the source. */
  readonly voice: string;
}

/** Newly spoken part. */
export interface SpokenAudio {
  /** Text of a bundle, `speech.json`: words, phones, stress, intonation; including known contents. */
  readonly bundle: string;
  /** The sounds that the bundle names and that are new since the last part, as WAV. */
  readonly sounds: ReadonlyMap<string, Uint8Array>;
  /** Messages about failures since the last part, in sentences. */
  readonly problems: readonly string[];
}

/** Receiver of the results, and a way to cancel. */
export interface SpeechReceiver {
  readonly signal: AbortSignal;
  /** Called with the fetched share of the initially required data, 0 to 1. */
  readonly progress: (share: number) => void;
  /** Called with each part, of one or more complete utterances in order, as soon as it is made. */
  readonly take: (said: SpokenAudio) => void;
}

/** Makes speech in the page. */
export interface SpeechSource {
  /** Display name. */
  readonly name: string;
  /** Short description of the voice for people: its type and origin. */
  readonly about: string;
  /** An expression of SPDX. */
  readonly license: string;
  /** True if all required data is loaded, so that speech starts immediately. */
  readonly ready: boolean;
  /** Returns true if it speaks a language, a BCP 47 tag. */
  speaks(language: string): boolean;
  /** Returns the voice of a figure of the library in a language; for another name, a default voice. */
  voiceOf(figure: string, language: string): string;
  /**
   * Speaks a request; resolves when everything is spoken. Rejects with the signal's reason on abort, and with an `Error` with a readable sentence if nothing
   * can be spoken.
   */
  speak(request: SpeechRequest, saying: SpeechReceiver): Promise<void>;
}

/** @deprecated Use `SpokenAudio`. */
export type Said = SpokenAudio;

/** @deprecated Use `SpeechReceiver`. */
export type Saying = SpeechReceiver;
