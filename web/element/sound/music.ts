/** Background music: files streamed by the browser, synchronised with the story's clock. Fetched only by players whose story has music. */

import type { Credentials } from '../base/fetching.js';
import type { Piece } from '../base/types.js';

/** Pieces this far ahead are fetched. */
const AHEAD_SECS = 20;
/** Time after which a missing piece no longer delays the story. */
const PATIENCE_MS = 10_000;
/** Drift above which a piece seeks; below it the playback rate is adjusted. */
const JUMP_SECS = 0.06;
/** Inaudible, and clocks of browsers wobble that much. */
const NEAR_SECS = 0.012;
/** The most by which the speed of a piece leaves the story's; 1.5 % is inaudible, since the pitch stays. */
const MAX_PULL = 0.015;
/** Time allowed for a seek before the next. */
const SETTLE_MS = 400;
/** Time constant of level changes. */
const FOLLOW_SECS = 0.02;
/** Time constant of the fade-in of a late piece, and its duration. */
const LATE_SECS = 0.4;
const LATE_MS = 2000;

/** Returns the level of a line of points at a story time, by linear interpolation. */
export function levelAt(line: Piece['level'], secs: number): number {
  const after = line.findIndex(([at]) => at > secs);
  const [from, to] = [line.at(after < 0 ? -1 : after - 1), line[after < 0 ? line.length - 1 : after]];
  if (after === 0 || from === undefined || to === undefined) return line[0]?.[1] ?? 0;
  return to[0] > from[0] ? from[1] + ((to[1] - from[1]) * (secs - from[0])) / (to[0] - from[0]) : to[1];
}

/** Returns the correction for a piece that is `drift` seconds ahead of the story: a seek, or a playback rate. */
export function steer(drift: number, rate: number): 'set' | number {
  if (Math.abs(drift) > JUMP_SECS) return 'set';
  // Corrects a quarter of the drift in each quarter of a second.
  return Math.abs(drift) < NEAR_SECS ? rate : rate * (1 - Math.min(MAX_PULL, Math.max(-MAX_PULL, drift)));
}

interface Playing {
  readonly piece: Piece;
  readonly sound: HTMLAudioElement;
  readonly gain: GainNode;
  readonly sinceMs: number;
  /** True if it is audible, or has failed. */
  settled: boolean;
  missing: boolean;
  /** Time of the last seek. */
  setMs: number;
  /** True once it has been in time: from then on it is audible. */
  inTime: boolean;
  /** Time since which the piece is audible, ms. */
  heardMs: number;
}

/** The folders that files are looked for in, and how they are fetched. */
interface MusicStart {
  readonly story: URL;
  readonly library: URL;
  readonly credentials: Credentials;
}

/** Plays the music of a story. */
export class Music {
  /** Audio context. */
  readonly audio: AudioContext;
  readonly #from: MusicStart;
  readonly #onMissing: (message: string) => void;
  readonly #output: AudioNode;
  #keepsPitch = true;
  readonly #playing = new Map<string, Playing>();
  #pieces: readonly Piece[] = [];
  #run: { readonly position: number; readonly rate: number; readonly at: number } | undefined;

  /** Plays into `output`. */
  constructor(output: AudioNode, from: MusicStart, onMissing: (message: string) => void) {
    this.audio = output.context as AudioContext;
    this.#output = output;
    this.#from = from;
    this.#onMissing = onMissing;
  }

  /** Sets all pieces; those already playing continue. */
  set(pieces: readonly Piece[]): void {
    this.#pieces = pieces;
    const kept = new Set(pieces.map(keyOf));
    for (const [key, playing] of this.#playing) if (!kept.has(key)) this.#drop(key, playing);
  }

  /** Enables pitch preservation at other playback rates. */
  keepPitch(kept: boolean): void {
    this.#keepsPitch = kept;
    for (const { sound } of this.#playing.values()) sound.preservesPitch = kept;
  }

  start(position: number, rate: number, at: number): void {
    this.#run = { position, rate, at };
    for (const playing of this.#playing.values()) playing.inTime = false;
    this.prepare(position);
  }

  stop(): void {
    this.#run = undefined;
    for (const { sound, gain } of this.#playing.values()) {
      gain.gain.setTargetAtTime(0, this.audio.currentTime, FOLLOW_SECS / 4);
      sound.pause();
    }
  }

  /** Fetches pieces due soon and keeps playing ones synchronised; called at least a few times per second. */
  prepare(position: number): void {
    const rate = this.#run?.rate ?? 1;
    for (const piece of this.#pieces) {
      const key = keyOf(piece);
      let playing = this.#playing.get(key);
      const wanted = piece.startSecs <= position + AHEAD_SECS * rate && piece.endSecs > position;
      if (!wanted) {
        if (playing !== undefined) this.#drop(key, playing);
        continue;
      }
      if (playing === undefined) this.#playing.set(key, (playing = this.#open(piece)));
      if (this.#run !== undefined) this.#follow(playing, this.#run);
    }
  }

  ready(position: number): boolean {
    return this.#pieces.every((piece) => {
      // The story waits for music that is danced to; a loop for atmosphere starts when it has
      // loaded.
      if (piece.loops || position < piece.startSecs || position >= piece.endSecs) return true;
      const playing = this.#playing.get(keyOf(piece));
      return playing !== undefined && (playing.settled || performance.now() - playing.sinceMs > PATIENCE_MS);
    });
  }

  close(): void {
    this.stop();
    this.#pieces = [];
    for (const [key, playing] of this.#playing) this.#drop(key, playing);
  }

  #drop(key: string, { sound, gain }: Playing): void {
    sound.pause();
    // Ends the download.
    sound.removeAttribute('src');
    sound.load();
    gain.disconnect();
    this.#playing.delete(key);
  }

  /** Starts fetching a piece: the first of its files that the browser can play. */
  #open(piece: Piece): Playing {
    const sound = new Audio();
    // Without it the sound of another origin is silence to an audio graph.
    sound.crossOrigin = this.#from.credentials === 'include' ? 'use-credentials' : 'anonymous';
    sound.preload = 'auto';
    sound.loop = piece.loops;
    sound.preservesPitch = this.#keepsPitch;
    const gain = this.audio.createGain();
    gain.gain.value = 0;
    this.audio.createMediaElementSource(sound).connect(gain).connect(this.#output);
    const playing: Playing = { piece, sound, gain, sinceMs: performance.now(), settled: false, missing: false, setMs: 0, inTime: false, heardMs: 0 };
    const root = piece.library ? this.#from.library : this.#from.story;
    const files = piece.file.endsWith('.opus') ? [piece.file, piece.file.replace(/opus$/, 'mp3')] : [piece.file];
    if (!sound.canPlayType('audio/ogg; codecs=opus')) files.reverse();
    const next = (): void => {
      const file = files.shift();
      const url = file === undefined ? undefined : new URL(file, root);
      if (url?.href.startsWith(root.href)) {
        sound.src = url.href;
        return;
      }
      playing.settled = playing.missing = true;
      this.#onMissing(`The music ${piece.file} cannot be played; the story continues without it.`);
    };
    sound.addEventListener('error', () => sound.hasAttribute('src') && next());
    sound.addEventListener('canplay', () => (playing.settled = true));
    next();
    return playing;
  }

  /** Synchronises a piece with the story. */
  #follow(playing: Playing, run: { position: number; rate: number; at: number }): void {
    const { piece, sound, gain } = playing;
    if (!playing.settled || playing.missing) return;
    const now = this.audio.currentTime;
    const story = run.position + run.rate * (now - run.at);
    const place = placeIn(story - piece.startSecs, sound.duration, piece.loops);
    const over = !piece.loops && place >= sound.duration;
    if (now < run.at || place < 0 || over || story >= piece.endSecs) {
      if (!sound.paused) sound.pause();
      playing.inTime = false;
      if (!over) this.#place(playing, Math.max(0, place));
      gain.gain.setTargetAtTime(0, now, FOLLOW_SECS);
      return;
    }
    if (sound.paused) {
      this.#place(playing, place);
      sound.play().catch(() => undefined);
    }
    const todo = steer(sound.currentTime - place, run.rate);
    if (todo === 'set') {
      this.#place(playing, place);
    } else {
      if (sound.playbackRate !== todo) sound.playbackRate = todo;
      if (!playing.inTime && !sound.seeking && sound.readyState > 2) {
        playing.inTime = true;
        playing.heardMs = performance.now();
      }
    }
    const follow = piece.loops && performance.now() - playing.heardMs < LATE_MS ? LATE_SECS : FOLLOW_SECS;
    gain.gain.setTargetAtTime(playing.inTime ? levelAt(piece.level, story) : 0, now, playing.inTime ? follow : FOLLOW_SECS);
  }

  #place(playing: Playing, secs: number): void {
    const now = performance.now();
    if (playing.sound.seeking || now - playing.setMs < SETTLE_MS || Math.abs(playing.sound.currentTime - secs) < NEAR_SECS) return;
    playing.setMs = now;
    playing.sound.currentTime = secs;
  }
}

/**
 * Returns the position in a piece after a number of seconds: a loop restarts once its length is known. A server without range support gives no length
 * (Infinity).
 */
export function placeIn(secs: number, durationSecs: number, loops: boolean): number {
  if (!loops || !Number.isFinite(durationSecs) || durationSecs <= 0) return secs;
  return ((secs % durationSecs) + durationSecs) % durationSecs;
}

/** Returns the identity of a piece: a changed level does not require another fetch. */
function keyOf(piece: Piece): string {
  return `${piece.startSecs} ${piece.library} ${piece.file}`;
}
