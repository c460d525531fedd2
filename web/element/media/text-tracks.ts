/** Text track list of a player (HTML, 4.8.11.11): the story's captions are one track, and pages add others. */

import type { Caption } from '../captions/captions.js';
import { StoryTextTrack, type Step } from './text-track.js';

/** Track kinds allowed by the interface. */
const KINDS: readonly string[] = ['subtitles', 'captions', 'descriptions', 'chapters', 'metadata'];

/** A part of a story that has a title. */
export interface Part {
  readonly name: string;
  readonly title: string;
  readonly startSecs: number;
  readonly endSecs: number;
}

type ListHandler = ((event: Event) => unknown) | null;

/** The tracks of a player, the story's own first. */
export class StoryTextTracks extends EventTarget {
  [index: number]: StoryTextTrack;
  onaddtrack: ListHandler = null;
  onremovetrack: ListHandler = null;
  onchange: ListHandler = null;
  #own: StoryTextTrack | undefined;
  /** The parts of the story, where it has some. */
  #parts: StoryTextTrack | undefined;
  #added: StoryTextTrack[] = [];
  /** The captions that the story's track has cues of. */
  #of: readonly Caption[] | undefined;
  readonly #show: (shown: boolean) => void;
  readonly #cueAdded: () => void;
  #isTold = true;

  /** Creates the list; `show` is called when a page shows or hides the story's own captions, `cueAdded` when a cue is added. */
  constructor(show: (shown: boolean) => void, cueAdded: () => void) {
    super();
    this.#show = show;
    this.#cueAdded = cueAdded;
    this.addEventListener('addtrack', (event) => this.onaddtrack?.(event));
    this.addEventListener('removetrack', (event) => this.onremovetrack?.(event));
    this.addEventListener('change', (event) => this.onchange?.(event));
  }

  get length(): number {
    return this.#all.length;
  }

  get #all(): StoryTextTrack[] {
    return [this.#own, this.#parts, ...this.#added].filter((track) => track !== undefined);
  }

  [Symbol.iterator](): Iterator<StoryTextTrack> {
    return this.#all[Symbol.iterator]();
  }

  getTrackById(id: string): StoryTextTrack | null {
    return this.#all.find((track) => id !== '' && track.id === id) ?? null;
  }

  /** Adds a track of the page. Throws `TypeError` for an unknown kind. */
  add(kind: TextTrackKind, label: string, language: string): StoryTextTrack {
    if (!KINDS.includes(kind)) throw new TypeError(`Failed to execute 'addTextTrack': '${kind}' is not a kind of text track.`);
    const track = new StoryTextTrack({ kind, label, language }, 'hidden', (_, isCue) => (isCue ? this.#cueAdded() : this.#tell()));
    this.#added.push(track);
    this.#changed('addtrack', track);
    return track;
  }

  /** Replaces the story's caption track with one in a language; undefined if there is no story. */
  setStory(language: string | undefined, shown: boolean): void {
    const before = this.#own;
    this.#own = this.#of = undefined;
    if (before !== undefined) this.#changed('removetrack', before);
    if (language === undefined) return;
    const own = new StoryTextTrack({ kind: 'captions', label: 'Captions', language, id: 'story' }, shown ? 'showing' : 'disabled', ({ mode }, isCue) => {
      if (isCue) return this.#cueAdded();
      this.#show(mode === 'showing');
      this.#tell();
    });
    this.#own = own;
    this.#changed('addtrack', own);
  }

  /** Sets the parts of the story as chapters in its language; an empty list removes that track. */
  setParts(parts: readonly Part[], language: string): void {
    const before = this.#parts;
    this.#parts = undefined;
    if (before !== undefined) this.#changed('removetrack', before);
    if (parts.length === 0) return;
    const chapters = new StoryTextTrack({ kind: 'chapters', label: 'Parts', language, id: 'parts' }, 'hidden', (_, isCue) => (isCue ? this.#cueAdded() : this.#tell()));
    chapters.replaceCues(parts.map(({ name, title, startSecs, endSecs }) => Object.assign(new VTTCue(startSecs, endSecs, escaped(title)), { id: name })));
    this.#parts = chapters;
    this.#changed('addtrack', chapters);
  }

  /** Shows or hides the captions of the story. */
  setShown(shown: boolean): void {
    if (this.#own?.setShown(shown)) this.#tell();
  }

  /** Jumps to another time. */
  leap(secs: number): void {
    for (const track of this.#all) track.leap(secs);
  }

  /** Resets all tracks after the story was unloaded. */
  rest(): void {
    for (const track of this.#all) track.rest();
  }

  /** Advances the tracks to a time of the story; `pause` is called, before any event, if a cue has pause-on-exit. */
  march(captions: readonly Caption[], secs: number, pause: () => void): void {
    const all = this.#all.filter(({ mode }) => mode !== 'disabled');
    if (all.length === 0) return;
    if (captions !== this.#of && this.#own !== undefined) {
      this.#own.replaceCues(captions.map((caption) => new VTTCue(caption.startSecs, caption.endSecs, textOf(caption))));
      this.#of = captions;
    }
    const steps = all.map((track) => track.march(secs)).filter((step): step is Step => step !== undefined);
    if (steps.some(({ pauses }) => pauses)) pause();
    for (const { notify: tell } of steps) tell();
  }

  #changed(type: 'addtrack' | 'removetrack', track: StoryTextTrack): void {
    const all = this.#all;
    for (let i = 0; i <= all.length; i++) {
      const at = all[i];
      if (at === undefined) delete this[i];
      else this[i] = at;
    }
    // The `track` that it is made with may only be one of the browser's own.
    queueMicrotask(() => this.dispatchEvent(Object.defineProperty(new TrackEvent(type), 'track', { value: track })));
  }

  /** Dispatches `change` once for all modes that a script sets. */
  #tell(): void {
    if (!this.#isTold) return;
    this.#isTold = false;
    queueMicrotask(() => {
      this.#isTold = true;
      this.dispatchEvent(new Event('change'));
    });
  }
}

const escaped = (text: string): string => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

/** Returns a caption as WebVTT text, on separate lines. */
function textOf({ words, second }: Caption): string {
  const line = (from: number, to: number) =>
    words
      .slice(from, to)
      .map(({ text }) => escaped(text))
      .join(' ');
  return second < words.length ? `${line(0, second)}\n${line(second, words.length)}` : line(0, words.length);
}
