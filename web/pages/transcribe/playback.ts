/** Playback of the recording and the figure in step: one clock, that of the recording if there is one, else that of the figure. */

import type { RaconteurPlayer } from '../../element/element.js';
import { delayOf } from '../run-up.js';

/** Difference between the clocks from which the figure is set to the recording, seconds. */
const APART_SECS = 0.04;
/** Time that the figure has to show a frame it was set to, before it is compared again, ms. */
const SETTLE_MS = 300;
/** Maximum time by which the figure is set ahead of the recording, because it needs some time to begin there, seconds. */
const MAX_AHEAD_SECS = 0.3;

export class Playback {
  /** Delay of the figure relative to the recording, for its hands to reach the first gesture. */
  #delaySecs = 0;
  #recording: HTMLMediaElement | undefined;
  #setMs = -Infinity;
  /** Time by which the figure is set ahead while it plays: what it was last late by. */
  #aheadSecs = 0;
  #rate = 1;

  constructor(
    readonly player: RaconteurPlayer,
    /** Called when the browser refuses to play. */
    readonly refused: () => void,
  ) {}

  get recording(): HTMLMediaElement | undefined {
    return this.#recording;
  }

  /** Gives the playback a recording, which leads from now on, or takes it away. */
  set recording(recording: HTMLMediaElement | undefined) {
    const { secs } = this;
    this.pause();
    this.#recording = recording;
    // Two voices of the same words are not understood, and the recording does not wait for one to be made.
    this.player.muted = recording !== undefined;
    this.player.speech = recording === undefined ? 'here' : 'browser';
    if (recording !== undefined) recording.playbackRate = this.#rate;
    this.secs = secs;
  }

  /** Sets the delay that the player gives to a script, by the start of its first gesture; the figure stays in step. */
  setFirstGesture(secs: number | undefined): void {
    const delay = secs === undefined ? 0 : delayOf(secs);
    if (delay === this.#delaySecs) return;
    const { secs: now } = this;
    this.#delaySecs = delay;
    this.#setFigure(now);
  }

  /** Time of the recording, seconds. */
  get secs(): number {
    return Math.max(0, this.#recording?.currentTime ?? this.player.currentTime - this.#delaySecs);
  }

  set secs(secs: number) {
    const to = Math.max(0, secs);
    if (this.#recording !== undefined) this.#recording.currentTime = to;
    this.#setFigure(to);
  }

  /** Length of the recording or of the script, seconds. */
  get lengthSecs(): number {
    const { duration } = this.#recording ?? this.player;
    return Number.isFinite(duration) ? duration : 0;
  }

  get paused(): boolean {
    return this.#recording?.paused ?? this.player.paused;
  }

  get rate(): number {
    return this.#rate;
  }

  set rate(rate: number) {
    this.#rate = rate;
    this.#aheadSecs = 0;
    this.player.playbackRate = rate;
    if (this.#recording !== undefined) this.#recording.playbackRate = rate;
  }

  toggle(): void {
    if (!this.paused) {
      this.pause();
      return;
    }
    this.player.play().catch(() => (this.#recording === undefined ? this.refused() : undefined));
    this.#recording?.play().catch(() => {
      this.player.pause();
      this.refused();
    });
  }

  pause(): void {
    this.#recording?.pause();
    this.player.pause();
  }

  /** Keeps the figure in step with the recording; called before each frame. */
  follow(): void {
    const recording = this.#recording;
    if (recording === undefined) return;
    const { player } = this;
    if (recording.paused !== player.paused && !player.ended) {
      if (recording.paused) player.pause();
      else player.play().catch(() => undefined);
    }
    const to = recording.currentTime + this.#delaySecs;
    // After its last clause the figure stands still.
    if (!(to < player.duration) || performance.now() - this.#setMs < SETTLE_MS) return;
    const late = to - player.currentTime;
    if (Math.abs(late) <= APART_SECS) return;
    if (!recording.paused) this.#aheadSecs = Math.min(MAX_AHEAD_SECS, Math.max(0, this.#aheadSecs + late));
    this.#setFigure(recording.currentTime + (recording.paused ? 0 : this.#aheadSecs));
  }

  #setFigure(secs: number): void {
    this.#setMs = performance.now();
    this.player.currentTime = secs + this.#delaySecs;
  }
}
