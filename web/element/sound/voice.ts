/** Interface of a performance's clock and audio. */

import type { SpeechStyle } from './spoken.js';
import type { Diagnostic, Piece, Utterance } from '../base/types.js';

/** Clock and audio of a performance. Source time is in seconds. */
export interface Voice {
  /** Returns the current source time for scheduling. */
  now(): number;
  /** Returns the audible source time. */
  heard(): number;
  /** True if the source runs; otherwise its time stands still. */
  readonly running: boolean;
  /** Plays from story time `position` at `rate`, starting at source time `at`. */
  start(position: number, rate: number, at: number): void;
  /** Stops the audio; if it only `waits` to be ready, overdue speech may finish. */
  stop(waits?: boolean): void;
  /**
   * Fetches, decodes and schedules the audio soon after `position`; called a few times per second, and with the rate just before a start, for preparations
   * that take time.
   */
  prepare(position: number, rate?: number): void;
  /** Returns true if the audio at `position` is available, or known to be missing. */
  ready(position: number): boolean;
  setVolume(volume: number): void;
  /** Enables pitch preservation at other rates. Audio already scheduled does not change. */
  keepPitch(kept: boolean): void;
  /** Plays on another device, one that `openDevice` has opened. */
  setDevice(device: string): void;
  /** Returns all audio as a track of a stream; undefined if there is none. */
  track(): MediaStreamTrack | undefined;
  /** Returns the utterances whose recordings are not loaded. */
  missing(): readonly Utterance[];
  /** Number of received recordings. */
  readonly come: number;
  /** Sets the music under the words; `library` is the folder of its pieces. */
  setMusic(pieces: readonly Piece[], library: URL): void;
  /** Adds sounds generated here, by the file names in the utterances. */
  give(sounds: ReadonlyMap<string, Uint8Array>): void;
  /** Discards added sounds, and those that no utterance uses any more. */
  forget(): void;
  /** Ends utterances at a story time: each is replaced by a shorter one, or removed if it has not started. */
  cut(changes: ReadonlyMap<Utterance, Utterance | undefined>, atSecs: number): void;
  /** Marks utterances without a recording as being synthesised: their times are not ready until then. */
  hold(speaking: Promise<unknown>): void;
  /**
   * Uses browser speech for utterances without a recording, with the defaults `usual`. Resolves with the name of the voice, or undefined if the browser has
   * none for the language.
   */
  substitute(usual: SpeechStyle): Promise<string | undefined>;
  close(): void;
}

/** Silent clock for browsers without Web Audio: captions and picture continue. */
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

/** Returns the diagnostic for a story without a recorded voice, or with a partial one, and the substitute voice, if any. */
export function voiceMissing(some: boolean, name: string | undefined): Diagnostic {
  const what = some ? 'Some of the speech has no recording' : 'This story has no recorded voice';
  const how = name === undefined ? 'captions show its text' : `the browser's voice “${name}” speaks it, at guessed times`;
  return { code: 'voice-missing', severity: 'warning', message: `${what}; ${how}.`, hints: ['Run “raconteur bake” on the story to make one.'] };
}
