/**
 * Text tracks of a player (HTML, 4.8.11.11): the story's captions are one, and pages add others. The browser's own
 * classes belong to its own media elements, so these are like them; cues are the browser's `VTTCue`.
 */

import type { Caption } from './captions.js';

/** What the interface allows. */
const KINDS: readonly string[] = ['subtitles', 'captions', 'descriptions', 'chapters', 'metadata'];
const MODES: readonly string[] = ['disabled', 'hidden', 'showing'];

/** Cues by time, and by their `id`. */
export class CueList extends Array<TextTrackCue> {
  getCueById(id: string): TextTrackCue | null {
    return this.find((cue) => id !== '' && cue.id === id) ?? null;
  }
}

/** A row of timed texts. */
export class StoryTextTrack extends EventTarget {
  readonly kind: TextTrackKind;
  readonly label: string;
  readonly language: string;
  readonly id: string;
  oncuechange: ((event: Event) => unknown) | null = null;
  /** Called when a page sets another mode. */
  readonly #changed: (track: StoryTextTrack) => void;
  #mode: TextTrackMode;
  readonly #cues = new CueList();
  readonly #active = new CueList();

  constructor(about: { kind: TextTrackKind; label: string; language: string; id?: string }, mode: TextTrackMode, changed: (track: StoryTextTrack) => void) {
    super();
    this.kind = about.kind;
    this.label = about.label;
    this.language = about.language;
    this.id = about.id ?? '';
    this.#mode = mode;
    this.#changed = changed;
    this.addEventListener('cuechange', (event) => this.oncuechange?.(event));
  }

  /** `disabled`: nobody looks at it; `hidden`: its cues are told; `showing`: and seen, where it is the story's own. */
  get mode(): TextTrackMode {
    return this.#mode;
  }

  set mode(mode: TextTrackMode) {
    // As for any attribute of an enumeration, another text changes nothing.
    if (!MODES.includes(mode) || mode === this.#mode) return;
    this.#mode = mode;
    this.#changed(this);
  }

  /** The player, not the page, shows it or not; whether that is new. */
  setShown(shown: boolean): boolean {
    if (shown === (this.#mode === 'showing')) return false;
    this.#mode = shown ? 'showing' : 'disabled';
    return true;
  }

  /** In order of time; null while the track is disabled. */
  get cues(): CueList | null {
    return this.#mode === 'disabled' ? null : this.#cues;
  }

  /** Those of the present moment; null while the track is disabled. */
  get activeCues(): CueList | null {
    return this.#mode === 'disabled' ? null : this.#active;
  }

  addCue(cue: TextTrackCue): void {
    if (this.#cues.includes(cue)) this.#cues.splice(this.#cues.indexOf(cue), 1);
    const after = this.#cues.findIndex(({ startTime, endTime }) => startTime > cue.startTime || (startTime === cue.startTime && endTime < cue.endTime));
    this.#cues.splice(after < 0 ? this.#cues.length : after, 0, cue);
  }

  /** Throws `NotFoundError` for a cue of another track. */
  removeCue(cue: TextTrackCue): void {
    const at = this.#cues.indexOf(cue);
    if (at < 0) throw new DOMException('The cue is not in this track.', 'NotFoundError');
    this.#cues.splice(at, 1);
  }

  /** Other cues in the place of all. */
  replaceCues(cues: readonly TextTrackCue[]): void {
    this.#cues.splice(0, Infinity, ...cues);
  }

  /** Tells which cues begin and end at a moment; whether one of them wants the story to pause there. */
  march(secs: number): boolean {
    if (this.#mode === 'disabled') return false;
    const now = this.#cues.filter(({ startTime, endTime }) => startTime <= secs && secs < endTime);
    const over = this.#active.filter((cue) => !now.includes(cue));
    const begun = now.filter((cue) => !this.#active.includes(cue));
    if (over.length + begun.length === 0) return false;
    this.#active.splice(0, Infinity, ...now);
    for (const cue of over) cue.dispatchEvent(new Event('exit'));
    for (const cue of begun) cue.dispatchEvent(new Event('enter'));
    this.dispatchEvent(new Event('cuechange'));
    return over.some(({ pauseOnExit }) => pauseOnExit);
  }
}

type ListHandler = ((event: Event) => unknown) | null;

/** The tracks of a player, the story's own first. */
export class StoryTextTracks extends EventTarget {
  [index: number]: StoryTextTrack;
  onaddtrack: ListHandler = null;
  onremovetrack: ListHandler = null;
  onchange: ListHandler = null;
  #own: StoryTextTrack | undefined;
  #added: StoryTextTrack[] = [];
  /** The captions that the story's track has cues of. */
  #of: readonly Caption[] | undefined;
  readonly #show: (shown: boolean) => void;
  #isTold = true;

  /** `show` hears whether a page wants the story's own captions on screen. */
  constructor(show: (shown: boolean) => void) {
    super();
    this.#show = show;
    this.addEventListener('addtrack', (event) => this.onaddtrack?.(event));
    this.addEventListener('removetrack', (event) => this.onremovetrack?.(event));
    this.addEventListener('change', (event) => this.onchange?.(event));
  }

  get length(): number {
    return this.#all.length;
  }

  get #all(): StoryTextTrack[] {
    return this.#own === undefined ? this.#added : [this.#own, ...this.#added];
  }

  [Symbol.iterator](): Iterator<StoryTextTrack> {
    return this.#all[Symbol.iterator]();
  }

  getTrackById(id: string): StoryTextTrack | null {
    return this.#all.find((track) => id !== '' && track.id === id) ?? null;
  }

  /** A track of a page's own. Throws `TypeError` for a kind that there is not. */
  add(kind: TextTrackKind, label: string, language: string): StoryTextTrack {
    if (!KINDS.includes(kind)) throw new TypeError(`Failed to execute 'addTextTrack': '${kind}' is not a kind of text track.`);
    const track = new StoryTextTrack({ kind, label, language }, 'hidden', () => this.#tell());
    this.#added.push(track);
    this.#changed('addtrack', track);
    return track;
  }

  /** The story has captions in a language; undefined: there is no story. */
  setStory(language: string | undefined, shown: boolean): void {
    const before = this.#own;
    this.#own = this.#of = undefined;
    if (before !== undefined) this.#changed('removetrack', before);
    if (language === undefined) return;
    const own = new StoryTextTrack({ kind: 'captions', label: 'Captions', language, id: 'story' }, shown ? 'showing' : 'disabled', ({ mode }) => {
      this.#show(mode === 'showing');
      this.#tell();
    });
    this.#own = own;
    this.#changed('addtrack', own);
  }

  /** The captions of the story are shown, or not. */
  setShown(shown: boolean): void {
    if (this.#own?.setShown(shown)) this.#tell();
  }

  /** Brings the tracks to a moment of the story; whether a cue wants it to pause there. */
  march(captions: readonly Caption[], secs: number): boolean {
    const all = this.#all.filter(({ mode }) => mode !== 'disabled');
    if (all.length === 0) return false;
    if (captions !== this.#of && this.#own !== undefined) {
      this.#own.replaceCues(captions.map((caption) => new VTTCue(caption.startSecs, caption.endSecs, textOf(caption))));
      this.#of = captions;
    }
    return all.map((track) => track.march(secs)).includes(true);
  }

  #changed(type: 'addtrack' | 'removetrack', track: StoryTextTrack): void {
    const all = this.#all;
    for (let i = 0; i <= all.length; i++) {
      const at = all[i];
      if (at === undefined) delete this[i];
      else this[i] = at;
    }
    // Its `track` may only be one of the browser's own.
    queueMicrotask(() => this.dispatchEvent(Object.defineProperty(new Event(type), 'track', { value: track })));
  }

  /** Once for all modes that a script sets. */
  #tell(): void {
    if (!this.#isTold) return;
    this.#isTold = false;
    queueMicrotask(() => {
      this.#isTold = true;
      this.dispatchEvent(new Event('change'));
    });
  }
}

/** A caption as text of WebVTT, its lines apart. */
function textOf({ words, second }: Caption): string {
  const line = (from: number, to: number) =>
    words
      .slice(from, to)
      .map(({ text }) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;'))
      .join(' ');
  return second < words.length ? `${line(0, second)}\n${line(second, words.length)}` : line(0, words.length);
}
