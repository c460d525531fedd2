/** What speaks text that has no recording. */

/** What is to be said. */
export interface SpeechRequest {
  /** A script, or a list of clauses. */
  readonly eml: string;
  readonly fragment?: boolean;
  /** The text of the bundle that the script has; what it holds is not said again. */
  readonly known?: string | undefined;
  /** Name of a voice of the source. */
  readonly voice: string;
}

/** What was said so far. */
export interface SpokenAudio {
  /** The text of a bundle, `speech.json`: words, phones, stress, melody; what was known as well. */
  readonly bundle: string;
  /** The sounds that the bundle names and that are new since the last part, as WAV. */
  readonly sounds: ReadonlyMap<string, Uint8Array>;
  /** What could not be said since the last part, in sentences. */
  readonly problems: readonly string[];
}

/** Where it is said and how to end it. */
export interface SpeechJob {
  readonly signal: AbortSignal;
  /** Hears how much of what is needed first is fetched, 0 to 1. */
  readonly progress: (share: number) => void;
  /** Takes each part, of one or more whole utterances in their order, as soon as it is made. */
  readonly take: (said: SpokenAudio) => void;
}

/** Makes speech in the page. */
export interface SpeechSource {
  /** For people. */
  readonly name: string;
  /** What kind of voice it is and whose, in a short sentence for people. */
  readonly about: string;
  /** An expression of SPDX. */
  readonly license: string;
  /** Whether what it needs is here, so that speech comes at once. */
  readonly ready: boolean;
  /** Whether it speaks a language, a tag of BCP 47. */
  speaks(language: string): boolean;
  /** The voice of a figure of the library, in a language; of another name, a usual one. */
  voiceOf(figure: string, language: string): string;
  /** Over when all is said. Rejects with the signal's reason when it is aborted, and with an `Error` that says in a sentence why nothing can be said. */
  speak(request: SpeechRequest, saying: SpeechJob): Promise<void>;
}

/** @deprecated Use `SpokenAudio`. */
export type Said = SpokenAudio;

/** @deprecated Use `SpeechJob`. */
export type Saying = SpeechJob;
