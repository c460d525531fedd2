/** Voice: the utterances' recordings, played through Web Audio at their times in the story. */

import { fetchBytes, type Credentials } from '../base/fetching.js';
import type { Music } from './music.js';
import { contextOf, hasAudio, heardOf, wake } from './outlet.js';
import type { SpeechStyle, SpokenSource } from './spoken.js';
import type { Piece, Utterance } from '../base/types.js';
import { SilentVoice, type Voice } from './voice.js';

/** Recordings this far ahead are fetched and planned; a hidden page's timers may be a second late. */
const AHEAD_SECS = 20;
/** Decoded recordings further away than this are dropped: a minute of sound is 11 MB. */
const KEEP_SECS = 60;
/** Timeout of a recording without data; the story then continues with captions. */
const PATIENCE_MS = 20_000;
/** Maximum size of an utterance's audio, bytes: ten minutes of uncompressed samples. */
const MAX_SOUND_BYTES = 64e6;
/** Time before a passage that is still being synthesised at which the story stops: enough to decode and schedule its audio. */
const BEFORE_SPEAKING_SECS = 0.05;
/** Fade for a start or stop inside a sound, to avoid clicks. */
const FADE_SECS = 0.006;
/** An utterance that is interrupted fades out in this, as a voice that stops. */
const INTERRUPT_SECS = 0.06;
/**
 * Duration of silence after a fade-out. Browsers render audio in blocks of up to some tens of milliseconds, so a call may take effect that much later: the
 * fade then starts late, whereas a sound whose end has passed would be cut off abruptly.
 */
const CUT_SECS = 0.25;

interface Playing {
  readonly source: AudioBufferSourceNode;
  readonly gain: GainNode;
}

interface PlayingSource {
  /** Context of the times: audio scheduled on a closed context is inaudible. */
  readonly audio: AudioContext;
  readonly position: number;
  readonly rate: number;
  readonly at: number;
}

/** Missing audio: a recording, speech without a recording, or only sounds within speech. */
type MissingHandler = Utterance | 'speech' | 'sound';

/** Playback of a story's utterances. */
/** Location of recordings, and the settings for fetching and playing them. */
export interface Recordings {
  readonly folder: URL;
  readonly credentials: Credentials;
  /** Output device that `openDevice` has opened, or `''` for the default one. */
  readonly device: string;
}

export class RecordedVoice implements Voice {
  readonly #utterances: Iterable<Utterance>;
  readonly #folder: URL;
  readonly #credentials: Credentials;
  readonly #onMissing: (what: MissingHandler, message: string) => void;
  readonly #abort = new AbortController();
  /** Decoded sounds; null for one that cannot be had. */
  readonly #sounds = new Map<Utterance, AudioBuffer | null | 'pending'>();
  /** Stretched copies for the present rate. */
  readonly #stretched = new Map<Utterance, AudioBuffer>();
  #stretchedRate = 1;
  /** Time stretcher that preserves the pitch at rates other than 1, loaded with the first of them; null if it cannot be loaded. */
  #stretcher: ((sound: AudioBuffer, rate: number) => AudioBuffer) | null | undefined;
  #stretching = false;
  /** The speed that was set last. */
  #rate = 1;
  readonly #playing = new Map<Utterance, Playing>();
  #run: PlayingSource | undefined;
  #master: GainNode | undefined;
  /** Audio destination of captured streams. */
  #recorded: MediaStreamAudioDestinationNode | undefined;
  #device: string;
  #keepsPitch = true;
  /** Number of received recordings. */
  #come = 0;
  /** The context on which `resume` was called. */
  #asked: AudioContext | undefined;
  #volume = 1;
  #music: Music | undefined;
  /** Music to play. */
  #score: { readonly pieces: readonly Piece[]; readonly library: URL } | undefined;
  /** True while the music player is being fetched. */
  #awaited = false;
  /** Browser speech for utterances without a recording, once its availability is known. */
  #spoken: SpokenSource | undefined;
  #finding: Promise<void> | undefined;
  #found = true;
  /** Sounds that were made here, by file. */
  readonly #given = new Map<string, Uint8Array>();
  /** Number of pending syntheses. */
  #speaking = 0;
  /** Interrupted utterances that were replaced. */
  readonly #gone = new WeakSet<Utterance>();

  /**
   * Creates the voice; `utterances` may change at any time, in any order; `onMissing` is called for each one that cannot be played, and for other missing
   * audio.
   */
  constructor(utterances: Iterable<Utterance>, { folder, credentials, device }: Recordings, onMissing: (what: MissingHandler, message: string) => void) {
    this.#device = device;
    this.#utterances = utterances;
    this.#folder = folder;
    this.#credentials = credentials;
    this.#onMissing = onMissing;
  }

  /** Returns the current audio context: a new one if the previous was closed, or if the output device changed. */
  #context(): AudioContext {
    return contextOf(this.#device);
  }

  now(): number {
    return this.#context().currentTime;
  }

  heard(): number {
    return heardOf(this.#context());
  }

  get running(): boolean {
    const audio = this.#context();
    // `resume` was not yet called on a new context; it may run after a user activation.
    if (audio !== this.#asked) {
      this.#asked = audio;
      void wake(audio);
    }
    return audio.state === 'running' && (this.#run === undefined || this.#run.audio === audio);
  }

  /** Returns the output of all speech audio, recreated with the context. */
  #output(): GainNode {
    const audio = this.#context();
    if (this.#master?.context !== audio) {
      this.#master = audio.createGain();
      this.#master.gain.value = this.#volume;
      this.#master.connect(audio.destination);
      this.#recorded = undefined;
    }
    return this.#master;
  }

  track(): MediaStreamTrack | undefined {
    const output = this.#output();
    if (this.#recorded === undefined) {
      this.#recorded = this.#context().createMediaStreamDestination();
      output.connect(this.#recorded);
    }
    return this.#recorded.stream.getAudioTracks()[0];
  }

  setDevice(device: string): void {
    this.#device = device;
  }

  keepPitch(kept: boolean): void {
    this.#keepsPitch = kept;
    this.#music?.keepPitch(kept);
  }

  get come(): number {
    return this.#come;
  }

  missing(): readonly Utterance[] {
    return [...this.#utterances].filter((utterance) => {
      const sound = this.#sounds.get(utterance);
      return utterance.audio.length > 0 && (sound === undefined || sound === 'pending');
    });
  }

  setVolume(volume: number): void {
    this.#volume = volume;
    this.#master?.gain.setTargetAtTime(volume, this.#master.context.currentTime, 0.015);
    this.#spoken?.setVolume(volume);
  }

  setMusic(pieces: readonly Piece[], library: URL): void {
    this.#score = { pieces, library };
    if (this.#music !== undefined) this.#music.set(pieces);
    else if (pieces.length > 0) void this.#accompany(pieces, library);
  }

  async #accompany(pieces: readonly Piece[], library: URL): Promise<void> {
    this.#awaited = true;
    try {
      const { Music } = await import('./music.js');
      if (this.#abort.signal.aborted) return;
      const from = { story: new URL('../', this.#folder), library, credentials: this.#credentials };
      this.#music = new Music(this.#output(), from, (why) => this.#onMissing('sound', why));
      this.#music.keepPitch(this.#keepsPitch);
      this.#music.set(pieces);
    } catch {
      this.#onMissing('sound', 'The module that plays music could not be fetched.');
    }
    this.#awaited = false;
  }

  /** Discards the music of a closed context, which is inaudible. */
  #replaceMusic(): void {
    this.#music?.close();
    this.#music = undefined;
    if (this.#score !== undefined) void this.#accompany(this.#score.pieces, this.#score.library);
  }

  give(sounds: ReadonlyMap<string, Uint8Array>): void {
    for (const [file, wave] of sounds) this.#given.set(file, wave);
  }

  forget(): void {
    this.#given.clear();
    const present = new Set(this.#utterances);
    for (const utterance of this.#sounds.keys()) {
      if (present.has(utterance)) continue;
      this.#sounds.delete(utterance);
      this.#stretched.delete(utterance);
    }
  }

  cut(changes: ReadonlyMap<Utterance, Utterance | undefined>, atSecs: number): void {
    this.#spoken?.cut(changes);
    for (const [utterance, shorter] of changes) {
      this.#gone.add(utterance);
      const playing = this.#playing.get(utterance);
      if (playing !== undefined) this.#fade(playing, atSecs);
      for (const map of [this.#sounds, this.#stretched, this.#playing] as Map<Utterance, unknown>[]) {
        const had = map.get(utterance);
        map.delete(utterance);
        // An entry that is still loading is fetched again when it is needed.
        if (shorter !== undefined && had !== undefined && had !== 'pending') map.set(shorter, had);
      }
    }
  }

  hold(speaking: Promise<unknown>): void {
    this.#speaking += 1;
    const over = () => {
      this.#speaking -= 1;
    };
    speaking.then(over, over);
  }

  async substitute(usual: SpeechStyle): Promise<string | undefined> {
    if ('speechSynthesis' in window) await (this.#finding ??= this.#findVoice(usual));
    return this.#spoken?.name;
  }

  async #findVoice(usual: SpeechStyle): Promise<void> {
    this.#found = false;
    try {
      const { SpokenSource } = await import('./spoken.js');
      const spoken = await SpokenSource.find(this.#utterances, usual, (why) => this.#onMissing('speech', why));
      if (!this.#abort.signal.aborted) this.#spoken = spoken;
      spoken.setVolume(this.#volume);
      if (this.#run) spoken.start(this.#run.rate);
    } catch {
      this.#finding = undefined;
    }
    this.#found = true;
  }

  start(position: number, rate: number, at: number): void {
    this.#silence();
    this.#run = { audio: this.#context(), position, rate, at };
    this.#rate = rate;
    if (rate !== 1) void this.#fetchStretcher();
    this.prepare(position);
    if (this.#music !== undefined && this.#music.audio !== this.#context()) this.#replaceMusic();
    this.#music?.start(position, rate, at);
    this.#spoken?.start(rate);
    this.#spoken?.prepare(position);
  }

  stop(waits = false): void {
    this.#run = undefined;
    this.#music?.stop();
    this.#spoken?.stop(waits);
    this.#silence();
  }

  #silence(): void {
    for (const [, { source, gain }] of this.#playing) {
      const now = gain.context.currentTime;
      gain.gain.cancelScheduledValues(now);
      gain.gain.setTargetAtTime(0, now, FADE_SECS / 3);
      source.stop(now + CUT_SECS);
    }
    this.#playing.clear();
  }

  prepare(position: number, soon = 1): void {
    this.#music?.prepare(position);
    this.#spoken?.prepare(position);
    const rate = this.#run?.rate ?? soon;
    for (const utterance of this.#utterances) {
      const end = utterance.startSecs + utterance.durationSecs;
      if (end >= position && utterance.startSecs <= position + AHEAD_SECS * rate) {
        const sound = this.#sounds.get(utterance);
        if (sound === undefined) void this.#fetch(utterance);
        else if (sound !== null && sound !== 'pending') {
          if (this.#run) this.#plan(utterance, sound);
          else if (utterance.startSecs <= position) this.#paced(utterance, sound, rate);
        }
      } else if (end < position - KEEP_SECS || utterance.startSecs > position + KEEP_SECS * rate) {
        if (this.#sounds.get(utterance) !== 'pending') this.#sounds.delete(utterance);
        this.#stretched.delete(utterance);
        this.#playing.delete(utterance);
      }
    }
  }

  ready(position: number): boolean {
    for (const utterance of this.#utterances) {
      const offset = position - utterance.startSecs;
      if (offset >= utterance.durationSecs) continue;
      // The story stops before the current utterance; otherwise its first phones would be skipped.
      if (this.#speaking > 0 && utterance.audio.length === 0 && offset >= -BEFORE_SPEAKING_SECS) return false;
      if (offset < 0) continue;
      const sound = this.#sounds.get(utterance);
      if (sound === undefined || sound === 'pending' || (!this.#found && utterance.audio.length === 0)) return false;
    }
    if (this.#rate !== 1 && this.#stretcher === undefined) return false;
    return !this.#awaited && (this.#music?.ready(position) ?? true) && (this.#spoken?.ready(position) ?? true);
  }

  close(): void {
    this.#abort.abort();
    this.stop();
    this.#music?.close();
    this.#spoken?.stop();
    this.#sounds.clear();
    this.#stretched.clear();
    // The fade of stop() completes before the voice is disconnected.
    const master = this.#master;
    setTimeout(() => master?.disconnect(), 100);
    this.#master = undefined;
  }

  /** Fetches and decodes the first recording of an utterance that the browser can play. */
  async #fetch(utterance: Utterance): Promise<void> {
    if (utterance.audio.length === 0) {
      this.#sounds.set(utterance, null);
      return;
    }
    this.#sounds.set(utterance, 'pending');
    const probe = document.createElement('audio');
    // Types that the browser reports as unsupported are tried last, because decodeAudioData
    // supports more.
    const ranked = [...utterance.audio].sort((a, b) => Number(probe.canPlayType(b.mime) !== '') - Number(probe.canPlayType(a.mime) !== ''));
    let reason = '';
    for (const { file } of ranked) {
      const url = new URL(file, this.#folder);
      if (!url.href.startsWith(this.#folder.href)) {
        reason = `${file} lies outside the story's folder`;
        continue;
      }
      try {
        const sound = await this.#context().decodeAudioData(await this.#bytes(file, url));
        if (this.#abort.signal.aborted || this.#gone.has(utterance)) return;
        this.#sounds.set(utterance, sound);
        this.#come += 1;
        if (this.#run) this.#plan(utterance, sound);
        return;
      } catch (error) {
        if (this.#abort.signal.aborted || this.#gone.has(utterance)) return;
        reason = `${file}: ${(error instanceof Error ? error.message : String(error)).replace(/\.$/, '')}`;
      }
    }
    this.#sounds.set(utterance, null);
    this.#onMissing(utterance, reason);
  }

  /** Returns the bytes of a sound: generated here, or from the server. */
  async #bytes(file: string, url: URL): Promise<ArrayBuffer> {
    const given = this.#given.get(file);
    // Decoding detaches the bytes.
    if (given !== undefined) return given.slice().buffer;
    return (await fetchBytes(url, { what: 'The recording', most: MAX_SOUND_BYTES, signal: this.#abort.signal, credentials: this.#credentials, silenceMs: PATIENCE_MS })).buffer;
  }

  /** Plans a decoded sound on the audio clock, once for each run. */
  #plan(utterance: Utterance, sound: AudioBuffer): void {
    const run = this.#run;
    if (run === undefined || this.#playing.has(utterance)) return;
    if (run.rate !== 1 && this.#stretcher === undefined) return;
    // This takes a while and must be complete before the time is read.
    const buffer = this.#paced(utterance, sound, run.rate);
    // Without the stretcher, a voice at another speed is still audible, with a changed pitch.
    const speed = buffer === sound ? run.rate : 1;
    const audio = this.#context();
    // Times are whole samples: between samples a browser interpolates, which dulls the audio, and
    // adjoining audio would not be continuous.
    const whole = (secs: number) => Math.round(secs * audio.sampleRate) / audio.sampleRate;
    let when = whole(run.at + (utterance.startSecs - run.position) / run.rate);
    let offset = 0;
    // A little lead time, so that the browser receives the start before it is due: a late start
    // begins late, and in the middle of its fade.
    const earliest = whole(Math.max(run.at, audio.currentTime + 0.02));
    if (when < earliest) {
      offset = earliest - when;
      when = earliest;
    }
    if (offset * speed >= buffer.duration) return;
    const gain = audio.createGain();
    gain.connect(this.#output());
    if (offset > 0) {
      // Silent until then as well, because the ramp may begin a moment after the sample.
      gain.gain.value = 0;
      gain.gain.setValueAtTime(0, when);
      gain.gain.linearRampToValueAtTime(1, when + FADE_SECS);
    }
    const source = audio.createBufferSource();
    source.buffer = buffer;
    source.playbackRate.value = speed;
    source.connect(gain);
    source.onended = () => gain.disconnect();
    source.start(when, offset * speed);
    const playing = { source, gain };
    this.#playing.set(utterance, playing);
    if (utterance.cut) this.#fade(playing, utterance.startSecs + utterance.durationSecs);
  }

  /** Fades a sound out from a story time, or immediately if that has passed. */
  #fade({ source, gain }: Playing, storySecs: number): void {
    const run = this.#run;
    if (run === undefined) return;
    const at = Math.max(gain.context.currentTime, run.at + (storySecs - run.position) / run.rate);
    gain.gain.cancelScheduledValues(at);
    // A fifth of the time is a fade to a hundredth in all of it.
    gain.gain.setTargetAtTime(0, at, INTERRUPT_SECS / 5);
    source.stop(at + CUT_SECS);
  }

  async #fetchStretcher(): Promise<void> {
    if (this.#stretching) return;
    this.#stretching = true;
    try {
      this.#stretcher = (await import('./stretch.js')).paced;
    } catch {
      this.#stretcher = null;
      this.#onMissing('sound', 'The module that keeps the pitch at other speeds could not be fetched.');
    }
    if (this.#run && !this.#abort.signal.aborted) {
      for (const [utterance, sound] of this.#sounds) if (sound !== null && sound !== 'pending') this.#plan(utterance, sound);
    }
  }

  /** Returns the audio of an utterance at a speed. */
  #paced(utterance: Utterance, sound: AudioBuffer, rate: number): AudioBuffer {
    if (rate !== this.#stretchedRate) {
      this.#stretched.clear();
      this.#stretchedRate = rate;
    }
    if (rate === 1 || !this.#keepsPitch || !this.#stretcher) return sound;
    const known = this.#stretched.get(utterance);
    if (known !== undefined) return known;
    const buffer = this.#stretcher(sound, rate);
    this.#stretched.set(utterance, buffer);
    return buffer;
  }
}

/** Opens the audio of a story, or a silent clock without Web Audio; `report` is called for audio that cannot be played, with a flag for speech. */
export function openVoice(utterances: Iterable<Utterance>, recordings: Recordings, report: (message: string, isSpeech: boolean) => void): Voice {
  if (!hasAudio()) return new SilentVoice();
  const missed = (what: MissingHandler, why: string): void => {
    if (typeof what === 'string') {
      report(why, what === 'speech');
      return;
    }
    const words = what.words.slice(0, 4).map((w) => w.text);
    report(`The recording of “${words.join(' ')} …” cannot be played (${why}); its captions are shown.`, true);
  };
  return new RecordedVoice(utterances, recordings, missed);
}
