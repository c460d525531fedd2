/**
 * Browser speech for utterances without a recording. Fetched only by stories that need it. The story's clock stays the master: each utterance is passed to the
 * browser at its time, and the story waits for late ones, within bounds. The browser does not announce durations, so the next utterance gets a rate adjusted
 * by the error of the preceding ones.
 */

import type { Utterance } from '../base/types.js';

/** Timeout for loading voices: browsers load them on the first request and report them later; one without voices reports nothing. */
const VOICES_MS = 1000;
/** Maximum wait for an utterance past its end: this time, and this share of its own length. */
const MAX_WAIT = { secs: 1.5, share: 0.5 } as const;
/** Polling interval of an idle page. */
const LOOK_MS = 300;
/** Limits of the rate correction from earlier utterances. */
const PACE = { min: 0.6, max: 1.8 } as const;
/** Allowance for the browser's start-up time. */
const EARLY_SECS = 0.05;
/** Maximum lateness at which an utterance is spoken from its first word. */
const LATE_SECS = 0.3;

/** Default language and voice of utterances. */
export interface SpeechStyle {
  /** BCP 47 tag. */
  readonly language: string;
  /** Name of a voice of the browser, where one is chosen. */
  readonly voice?: string | undefined;
}

/** The present utterance. */
interface CurrentUtterance {
  readonly utterance: Utterance;
  readonly speech: SpeechSynthesisUtterance;
  /** Length of the utterance, seconds of the page's time. */
  readonly secs: number;
  /** Start time, on the page's clock. */
  startedMs?: number;
  /** Time of the last wait for it. */
  lateMs?: number;
  /** Total waiting time for it. */
  waitedMs: number;
}

/** Speaks utterances without a recording, one after another. */
export class SpokenSource {
  readonly #utterances: Iterable<Utterance>;
  readonly #voices: readonly SpeechSynthesisVoice[];
  readonly #usual: SpeechStyle;
  readonly #onMissing: (message: string) => void;
  #rate: number | undefined;
  /** Story time up to which due utterances have been searched, while the story plays. */
  #from: number | undefined;
  #volume = 1;
  #pace = 1;
  #now: CurrentUtterance | undefined;
  readonly #over = new Set<Utterance>();
  #complained = false;

  private constructor(utterances: Iterable<Utterance>, voices: readonly SpeechSynthesisVoice[], usual: SpeechStyle, onMissing: (message: string) => void) {
    this.#utterances = utterances;
    this.#voices = voices;
    this.#usual = usual;
    this.#onMissing = onMissing;
  }

  /** Waits until the browser's voices are known. `usual` applies to utterances without their own language or voice. */
  static async find(utterances: Iterable<Utterance>, usual: SpeechStyle, onMissing: (message: string) => void): Promise<SpokenSource> {
    let voices = speechSynthesis.getVoices();
    if (voices.length === 0) {
      await new Promise<void>((done) => {
        speechSynthesis.addEventListener('voiceschanged', () => done(), { once: true });
        setTimeout(done, VOICES_MS);
      });
      voices = speechSynthesis.getVoices();
    }
    return new SpokenSource(utterances, voices, usual, onMissing);
  }

  /** Name of the voice of the first utterance that can be spoken; undefined if there is none. */
  get name(): string | undefined {
    for (const utterance of this.#utterances) {
      const voice = isSilent(utterance) ? this.#voiceOf(utterance) : undefined;
      if (voice !== undefined) return voice.name;
    }
    return undefined;
  }

  setVolume(volume: number): void {
    const muted = volume === 0;
    // The current utterance keeps its volume, which cannot be changed. Muting ends it immediately;
    // unmuting restarts it at the current word.
    if (muted && this.#volume > 0) this.#cancel();
    this.#volume = volume;
  }

  start(rate: number): void {
    this.#rate = rate;
  }

  /** Ends the present utterance, unless the story only waits. */
  stop(waits = false): void {
    this.#rate = undefined;
    if (waits) return;
    this.#from = undefined;
    this.#cancel();
    this.#over.clear();
  }

  /** Begins the utterance that is due at the story time `position`. */
  prepare(position: number): void {
    const rate = this.#rate;
    if (rate === undefined) return;
    // A page that was busy for long may find an utterance that was due and should have ended: it is
    // spoken as well, and the story waits for it.
    const from = Math.min(position, this.#from ?? position);
    this.#from = position;
    if (this.#now !== undefined || this.#volume === 0) return;
    const due = position + EARLY_SECS * rate;
    for (const utterance of this.#utterances) {
      const { startSecs, durationSecs } = utterance;
      if (startSecs > due || startSecs + durationSecs <= from || this.#over.has(utterance) || !isSilent(utterance)) continue;
      this.#say(utterance, startSecs >= from ? Math.min(position, startSecs) : position, rate);
      return;
    }
  }

  /** Shortens or cancels utterances: each is replaced by a shorter one, or removed. */
  cut(changes: ReadonlyMap<Utterance, Utterance | undefined>): void {
    if (this.#now !== undefined && changes.has(this.#now.utterance)) this.#cancel();
    for (const shorter of changes.values()) if (shorter !== undefined) this.#over.add(shorter);
  }

  /** Returns false while the current utterance exceeds its time in the story. */
  ready(position: number): boolean {
    const now = this.#now;
    if (now === undefined || position < now.utterance.startSecs + now.utterance.durationSecs) return true;
    const ms = performance.now();
    // A busy page could not receive the end event: that counts as one check.
    now.waitedMs += Math.min(ms - (now.lateMs ?? ms), LOOK_MS);
    now.lateMs = ms;
    if (now.waitedMs < (MAX_WAIT.secs + MAX_WAIT.share * now.secs) * 1000) return false;
    this.#cancel();
    return true;
  }

  /** Speaks an utterance, from the word at `position` if that is in its middle. */
  #say(utterance: Utterance, position: number, rate: number): void {
    const words = utterance.words.filter((word) => word.endSecs > position || position < utterance.startSecs + LATE_SECS);
    const voice = this.#voiceOf(utterance);
    if (words.length === 0 || voice === undefined) {
      this.#over.add(utterance);
      return;
    }
    const speech = new SpeechSynthesisUtterance(words.map((word) => word.text).join(' '));
    speech.voice = voice;
    speech.lang = voice.lang;
    speech.volume = this.#volume;
    speech.rate = rate * this.#pace;
    const end = utterance.startSecs + utterance.durationSecs;
    const from = Math.max(position, utterance.startSecs);
    const now: CurrentUtterance = { utterance, speech, secs: (end - from) / rate, waitedMs: 0 };
    speech.onstart = () => (now.startedMs = performance.now());
    speech.onend = () => this.#ended(now);
    speech.onerror = ({ error }) => {
      const known = this.#now === now;
      this.#ended(now);
      // Another player of the page may have spoken instead.
      if (!known || this.#complained || error === 'canceled' || error === 'interrupted') return;
      this.#complained = true;
      this.#onMissing(`The browser's own voice does not speak (${error}); the captions are shown.`);
    };
    this.#now = now;
    speechSynthesis.speak(speech);
  }

  #ended(now: CurrentUtterance): void {
    if (this.#now !== now) return;
    this.#now = undefined;
    this.#over.add(now.utterance);
    if (now.startedMs === undefined) return;
    const took = (performance.now() - now.startedMs) / 1000;
    // The pauses of one or two words are not significant.
    if (now.secs < 1 || took < 0.2) return;
    // Moves half the way (geometric mean), so that one odd utterance does not reverse the next one.
    this.#pace = Math.min(PACE.max, Math.max(PACE.min, this.#pace * Math.sqrt(took / now.secs)));
  }

  #cancel(): void {
    if (this.#now === undefined) return;
    this.#now = undefined;
    speechSynthesis.cancel();
  }

  #voiceOf({ language, voice: named = this.#usual.voice }: Utterance): SpeechSynthesisVoice | undefined {
    // The one that is named, unless the utterance is in another language.
    const name = named?.toLowerCase();
    const own = this.#voices.find((voice) => voice.name.toLowerCase() === name);
    if (own !== undefined && (language === undefined || primary(own.lang) === primary(language))) return own;
    const wanted = tag(language ?? this.#usual.language);
    /** Returns the rank of a voice: the same region counts most; then a local voice, which does not send the text to a server. */
    const rank = (voice: SpeechSynthesisVoice) => 4 * Number(tag(voice.lang) === wanted) + 2 * Number(voice.localService) + Number(voice.default);
    const able = this.#voices.filter((voice) => primary(voice.lang) === primary(wanted));
    return able.sort((a, b) => rank(b) - rank(a))[0];
  }
}

/** Returns a language tag in lower case with hyphens; some systems write underscores. */
const tag = (language: string) => language.toLowerCase().replaceAll('_', '-');
const primary = (language: string) => tag(language).split('-')[0];

function isSilent({ audio, words }: Utterance): boolean {
  return audio.length === 0 && words.length > 0;
}
