/** The voice of a performance: what keeps its time and lets it be heard. */

import type { SpeechStyle } from './spoken.js';
import type { Diagnostic, Piece, Utterance } from '../base/types.js';

/** What keeps the time of a performance and lets it be heard. Source time is in seconds. */
export interface Voice {
  /** The moment of the source that would be played now. */
  now(): number;
  /** The moment of the source that the listener hears now. */
  heard(): number;
  /** Whether the source runs; while it does not, its moments stand still. */
  readonly running: boolean;
  /** Plays from story time `position` at `rate`, beginning at the source's moment `at`. */
  start(position: number, rate: number, at: number): void;
  /** Silence; when it only `waits` to be ready, what takes longer than its time may finish. */
  stop(waits?: boolean): void;
  /**
   * Fetches, decodes and plans what comes soon after `position`; called a few times a second, and
   * with the speed just before a start, for what takes time then.
   */
  prepare(position: number, rate?: number): void;
  /** Whether the sound at `position` is there, or known to be missing. */
  ready(position: number): boolean;
  setVolume(volume: number): void;
  /** Whether the pitch stays at other speeds. What is planned already is not changed. */
  keepPitch(kept: boolean): void;
  /** Plays on another device, one that `openDevice` has opened. */
  setDevice(device: string): void;
  /** All that is heard, as a track of a stream; undefined where nothing is. */
  track(): MediaStreamTrack | undefined;
  /** What has a recording that is not here. */
  missing(): readonly Utterance[];
  /** How many recordings have come so far. */
  readonly come: number;
  /** The music under the words; `library` is the folder of its pieces. */
  setMusic(pieces: readonly Piece[], library: URL): void;
  /** Takes sounds that were made here, by the names that the utterances have for them. */
  give(sounds: ReadonlyMap<string, Uint8Array>): void;
  /** Lets go of all that was given, and of sounds that nothing says any more. */
  forget(): void;
  /** Ends utterances at a story time: each becomes a shorter one, or nothing where it has not begun. */
  cut(changes: ReadonlyMap<Utterance, Utterance | undefined>, atSecs: number): void;
  /** What has no recording yet is being spoken: until that is over its moments are not ready. */
  hold(speaking: Promise<unknown>): void;
  /**
   * Has the browser's own voice say what has no recording, `usual` being how, where the story does
   * not tell. Its name, or undefined where the browser has none that speaks the language.
   */
  substitute(usual: SpeechStyle): Promise<string | undefined>;
  close(): void;
}

/** Keeps the time where there is no Web Audio: the captions and the picture play on. */
export class SilentVoice implements Voice {
  now(): number {
    return performance.now() / 1000;
  }

  heard(): number {
    return this.now();
  }

  readonly running = true;

  start(): void {}
  stop(): void {}
  prepare(): void {}

  ready(): boolean {
    return true;
  }

  readonly come = 0;
  setVolume(): void {}
  keepPitch(): void {}
  setDevice(): void {}

  track(): undefined {
    return undefined;
  }

  missing(): readonly Utterance[] {
    return [];
  }

  setMusic(): void {}
  give(): void {}
  forget(): void {}
  cut(): void {}
  hold(): void {}

  substitute(): Promise<undefined> {
    return Promise.resolve(undefined);
  }

  close(): void {}
}

/** Tells that a story has no recorded voice, or not for all that it says, and whose voice speaks instead, if any does. */
export function voiceMissing(some: boolean, name: string | undefined): Diagnostic {
  const what = some ? 'Some of the speech has no recording' : 'This story has no recorded voice';
  const how = name === undefined ? 'captions show its text' : `the browser's voice “${name}” speaks it, at guessed times`;
  return { code: 'voice-missing', severity: 'warning', message: `${what}; ${how}.`, hints: ['Run “raconteur bake” on the story to make one.'] };
}
