/** Play, pause, seek and speed, as a media element understands them, on the voice's clock. */

import { clampRate, StoryClock } from '../base/clock.js';
import { Ranges, united, type Span } from '../base/ranges.js';
import type { Voice } from '../sound/voice.js';

/** Delay from a command to the first sample, so that the browser can schedule it. */
const LEAD_SECS = 0.03;

/** Events of a transport; the names of media events. */
export type TransportEvent = 'play' | 'playing' | 'pause' | 'waiting' | 'seeking' | 'seeked' | 'ratechange' | 'ended';

/** Position and playback state of a performance. */
export class Transport {
  readonly #clock = new StoryClock();
  readonly #voice: Voice;
  #endSecs: number;
  readonly #emit: (event: TransportEvent) => void;
  /** Latest audible time; it never decreases during playback, even if clocks jitter. */
  #latest = 0;
  /** Time of this run up to which everything was ready. */
  #ready = 0;
  #paused = true;
  #waiting = false;
  #ended = false;
  #rate = 1;
  /** Played ranges, except the current run; the next field is its start. */
  #played: Span[] = [];
  #since: number | undefined;
  loop = false;
  /** True if the clock may pass the end, because more content may arrive. */
  openEnded = false;

  constructor(voice: Voice, durationSecs: number, emit: (event: TransportEvent) => void, rate = 1) {
    this.#voice = voice;
    this.#endSecs = durationSecs;
    this.#emit = emit;
    this.#rate = clampRate(rate);
  }

  get paused(): boolean {
    return this.#paused;
  }

  get ended(): boolean {
    return this.#ended;
  }

  /** True if `play` was called but the audio is not available yet. */
  get waiting(): boolean {
    return this.#waiting;
  }

  get rate(): number {
    return this.#rate;
  }

  /** Audible story time. */
  get position(): number {
    if (this.#clock.running) {
      this.#latest = Math.max(this.#latest, this.#clock.storyTimeAt(this.#voice.heard()));
    }
    // An open-ended performance keeps the duration that it has reached.
    if (this.openEnded) this.extend(this.#latest);
    return Math.min(this.#latest, this.#endSecs);
  }

  /** Played ranges. */
  get played(): Ranges {
    return new Ranges(this.#since === undefined ? this.#played : [...this.#played, [this.#since, this.position]]);
  }

  /** End of all known content. */
  get endSecs(): number {
    return this.#endSecs;
  }

  /** Extends the content to a time. */
  extend(endSecs: number): void {
    if (endSecs <= this.#endSecs) return;
    this.#endSecs = endSecs;
    this.#ended = false;
  }

  /** Sets the end of a replaced text; `spoken` is true if its speech changed too and must be scheduled again. */
  replace(endSecs: number, spoken: boolean): void {
    const running = this.#clock.running;
    if (running && spoken) this.#rest();
    this.#endSecs = endSecs;
    if (!running && this.#latest < endSecs) this.#ended = false;
    if (running && spoken) this.#run();
  }

  /** Plays, or waits until there is sound; again from the start after the end. `announced`: `play` was dispatched already. */
  play(announced = false): void {
    if (!this.#paused) return;
    if (this.#ended) this.seek(0);
    this.#ended = false;
    this.#paused = false;
    this.#waiting = announced;
    if (!announced) this.#emit('play');
    this.#run();
  }

  pause(): void {
    if (this.#paused) return;
    this.#rest();
    this.#paused = true;
    this.#waiting = false;
    this.#emit('pause');
  }

  seek(secs: number): void {
    const wasRunning = !this.#paused;
    let target = Number.isFinite(secs) ? Math.min(this.#endSecs, Math.max(0, secs)) : 0;
    this.#emit('seeking');
    const isEnd = target >= this.#endSecs && this.#endSecs > 0 && !this.openEnded;
    // A looping story restarts at its end immediately.
    if (isEnd && this.loop) {
      this.#emit('seeking');
      target = 0;
    }
    this.#moveTo(target);
    // A paused story that is sought to its end has ended; `ended` fires only for playback that
    // reaches it.
    this.#ended = isEnd && !this.loop && !wasRunning;
    if (wasRunning) this.#run();
    else this.#voice.prepare(target);
    this.#emit('seeked');
  }

  setRate(rate: number): void {
    const clamped = clampRate(rate);
    if (clamped === this.#rate) return;
    this.#rate = clamped;
    this.replan();
    this.#emit('ratechange');
  }

  /** Cancels and repeats all scheduling. */
  replan(): void {
    if (this.#paused || this.#waiting) return;
    this.#rest();
    this.#run(false);
  }

  /** Updates the audible story time and returns it; called for each frame and a few times per second without frames. */
  update(): number {
    const position = this.position;
    if (this.#paused) return position;
    this.#voice.prepare(position);
    if (this.#waiting) {
      if (this.#mayRun(position)) this.#run();
    } else if (!this.#mayRun(position)) {
      // Better a pause than sound and lips that drift apart.
      this.#rest(true);
      this.#waiting = true;
      if (this.#voice.running) this.#stopAt(this.#lastReady(position));
      this.#emit('waiting');
    } else if (position >= this.#endSecs && !this.openEnded) {
      this.#finish();
    } else {
      this.#ready = position;
    }
    return this.position;
  }

  /** Returns the time at which playback must stop: frames may be slow, and sounds that start between two of them must not be passed. */
  #lastReady(position: number): number {
    let [ready, not] = [Math.min(this.#ready, position), position];
    for (let i = 0; i < 12 && this.#voice.ready(ready); i++) {
      const middle = (ready + not) / 2;
      if (this.#voice.ready(middle)) ready = middle;
      else not = middle;
    }
    return ready;
  }

  #stopAt(secs: number): void {
    if (this.#since !== undefined) this.#played = united([...this.#played, [this.#since, this.position]]);
    this.#since = undefined;
    this.#latest = secs;
    this.#clock.rest(secs);
  }

  /** Returns true if the audio at a position is ready and its context is running: a browser may suspend or close that at any time. */
  #mayRun(position: number): boolean {
    return this.#voice.running && this.#voice.ready(position);
  }

  /** Starts a run; `told`: the events of playback are dispatched. */
  #run(told = true): void {
    const position = this.#latest;
    this.#voice.prepare(position, this.#rate || 1);
    if (!this.#mayRun(position)) {
      if (!this.#waiting) this.#emit('waiting');
      this.#waiting = true;
      return;
    }
    this.#waiting = false;
    this.#ready = position;
    // At speed 0 the story plays, but time stands still.
    if (this.#rate > 0) {
      const at = this.#voice.now() + LEAD_SECS;
      this.#voice.start(position, this.#rate, at);
      this.#clock.start(position, at, this.#rate);
      this.#since = position;
    }
    if (told) this.#emit('playing');
  }

  #rest(waits = false): void {
    const position = this.position;
    this.#voice.stop(waits);
    this.#stopAt(position);
  }

  #moveTo(secs: number): void {
    this.#voice.stop();
    this.#stopAt(secs);
  }

  #finish(): void {
    // A story without duration cannot loop: it ends.
    if (this.loop && this.#endSecs > 0) {
      this.#emit('seeking');
      // A listener may have gone elsewhere, or paused.
      if (this.position < this.#endSecs) return;
      this.#moveTo(0);
      if (!this.#paused) this.#run();
      this.#emit('seeked');
      return;
    }
    this.#rest();
    this.#paused = true;
    this.#ended = true;
    this.#emit('pause');
    this.#emit('ended');
  }
}
