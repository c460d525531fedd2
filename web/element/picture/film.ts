/**
 * Film of the story, made by `raconteur render --video`, as a fallback without graphics: silent, synchronised with the story's clock. Fetched only by players
 * without graphics.
 */

/** Drift above which the film seeks; below it the playback rate is adjusted. Lip sync errors of this size are visible. */
const JUMP_SECS = 0.3;
/** Duration of a film frame. */
const NEAR_SECS = 0.04;
/** The most by which its speed leaves the story's. */
const MAX_PULL = 0.1;
/** Time allowed for a seek before the next: seeking is slow where decoding is slow. */
const SETTLE_MS = 500;
/** Tolerance while the story is paused: the film is within a frame of its position. */
const REST_SECS = 0.02;

/** Current state of the story. */
export interface FilmTime {
  readonly secs: number;
  /** Time passes. */
  readonly runs: boolean;
  readonly rate: number;
}

/** Returns the correction for a film that is `drift` seconds ahead of the story: a seek, or a playback rate. */
export function steerFilm(drift: number, rate: number): 'set' | number {
  if (Math.abs(drift) > JUMP_SECS) return 'set';
  return Math.abs(drift) < NEAR_SECS ? rate : rate * (1 - Math.min(MAX_PULL, Math.max(-MAX_PULL, drift)));
}

export class Film {
  readonly video = document.createElement('video');
  readonly #addresses: URL[];
  readonly #onMissing: () => void;
  #now: FilmTime = { secs: 0, runs: false, rate: 1 };
  #setMs = -Infinity;

  /** Creates the film; `addresses` are its encodings; `onMissing` is called if none of them can be played. */
  constructor(addresses: readonly URL[], onMissing: () => void) {
    this.#addresses = [...addresses];
    this.#onMissing = onMissing;
    const { video } = this;
    Object.assign(video, { muted: true, playsInline: true, preload: 'auto', disablePictureInPicture: true, disableRemotePlayback: true });
    // Captions and controls provide the accessible text.
    video.setAttribute('aria-hidden', 'true');
    video.tabIndex = -1;
    video.addEventListener('error', () => video.hasAttribute('src') && this.#next());
    for (const type of ['loadedmetadata', 'seeked', 'canplay']) video.addEventListener(type, () => this.#steer());
    this.#next();
  }

  /** Follows the story; called for each frame, and when the story stops or starts. */
  follow(now: FilmTime): void {
    this.#now = now;
    this.#steer();
  }

  close(): void {
    this.video.pause();
    this.video.remove();
    // Ends the download.
    this.video.removeAttribute('src');
    this.video.load();
  }

  #next(): void {
    const url = this.#addresses.shift();
    // Deferred until the caller has the film that is missing.
    if (url === undefined) queueMicrotask(this.#onMissing);
    else this.video.src = url.href;
  }

  #steer(): void {
    const { video } = this;
    const { secs, runs, rate } = this.#now;
    if (video.readyState === 0) return;
    // A story that is longer than its film shows the last frame of it.
    const place = Math.min(secs, video.duration || secs);
    const drift = video.currentTime - place;
    if (!runs || secs >= video.duration) {
      if (!video.paused) video.pause();
      if (Math.abs(drift) > REST_SECS) this.#place(place, true);
      return;
    }
    const todo = steerFilm(drift, rate);
    if (todo === 'set') this.#place(place, false);
    else if (video.playbackRate !== todo) video.playbackRate = todo;
    if (video.paused) {
      // The paused film was at its position; the browser takes a moment to start.
      video.playbackRate = rate;
      video.play().catch(() => undefined);
    }
  }

  #place(secs: number, rests: boolean): void {
    const ms = performance.now();
    // The `seeked` handler calls this function again.
    if (this.video.seeking || (!rests && ms - this.#setMs < SETTLE_MS)) return;
    this.#setMs = ms;
    this.video.currentTime = secs;
  }
}
