/**
 * Text track list of a player (HTML, 4.8.11.11): the story's captions are one track, and pages add others. One of the
 * kinds subtitles and captions is shown at a time, in the language chosen last if there is such a track.
 */

import type { Caption } from '../captions/captions.js';
import { StoryTextTrack, type Step, type TrackAbout } from './text-track.js';

/** Track kinds allowed by the interface. */
const KINDS: readonly string[] = ['subtitles', 'captions', 'descriptions', 'chapters', 'metadata'];

/** Returns true for a track that is shown as text over the picture. */
const isText = ({ kind }: StoryTextTrack): boolean => kind === 'subtitles' || kind === 'captions';

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
  /** The track that is shown. */
  #shown: StoryTextTrack | undefined;
  /** The track of a page that is shown whenever captions are on; undefined for the story's own. */
  #choice: StoryTextTrack | undefined;
  /** Language chosen last. */
  #language: string | undefined;
  /** The captions that the story's track has cues of. */
  #of: readonly Caption[] | undefined;
  readonly #show: (shown: boolean) => void;
  readonly #cueAdded: () => void;
  #isTold = true;

  /** Creates the list; `show` is called when a page shows or hides captions, `cueAdded` when the current cues may be others. */
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

  /** The track that is shown, if captions are on. */
  get shown(): StoryTextTrack | undefined {
    return this.#shown;
  }

  /** The story's own captions, if there is a story. */
  get own(): StoryTextTrack | undefined {
    return this.#own;
  }

  /** The tracks that a user can choose from. */
  get texts(): readonly StoryTextTrack[] {
    return this.#all.filter(isText);
  }

  /** Adds a track of the page. Throws `TypeError` for an unknown kind. */
  add(kind: TextTrackKind, label: string, language: string): StoryTextTrack {
    if (!KINDS.includes(kind)) throw new TypeError(`Failed to execute 'addTextTrack': '${kind}' is not a kind of text track.`);
    return this.#insert(new StoryTextTrack({ kind, label, language }, 'hidden', (...change) => this.#follow(...change)));
  }

  /** Adds a track of a `<track>` element; a default one is shown unless a language was chosen before. */
  addElement(about: TrackAbout, isDefault: boolean): StoryTextTrack {
    const track = this.#insert(new StoryTextTrack(about, 'disabled', (...change) => this.#follow(...change)));
    if (!isText(track)) return track;
    if (isDefault && this.#language === undefined) track.mode = 'showing';
    else {
      this.#return(this.#own?.language);
      this.#switch(this.#chosen(this.#shown !== undefined));
    }
    return track;
  }

  /** Removes a track of a page. */
  remove(track: StoryTextTrack): void {
    this.giveUp(track);
    this.#added = this.#added.filter((one) => one !== track);
    this.#changed('removetrack', track);
  }

  /** Disables a track of a page that has nothing to show; the story's own captions take its place. */
  giveUp(track: StoryTextTrack): void {
    const isShown = track === this.#shown;
    if (track === this.#choice) this.#choice = undefined;
    if (track.disable()) this.#tell();
    if (isShown) this.#switch(this.#own);
  }

  /** Replaces the story's caption track with one in a language; undefined if there is no story. */
  setStory(language: string | undefined, shown: boolean): void {
    const before = this.#own;
    this.#own = this.#of = undefined;
    if (before !== undefined && before === this.#shown) this.#shown = undefined;
    if (before !== undefined) this.#changed('removetrack', before);
    if (language === undefined) return;
    this.#return(language);
    const isShown = shown && this.#choice === undefined;
    this.#own = new StoryTextTrack({ kind: 'captions', label: 'Captions', language, id: 'story' }, isShown ? 'showing' : 'disabled', (...change) => this.#follow(...change));
    this.#switch(this.#chosen(shown));
    this.#changed('addtrack', this.#own);
  }

  /** Sets the parts of the story as chapters in its language; an empty list removes that track. */
  setParts(parts: readonly Part[], language: string): void {
    const before = this.#parts;
    this.#parts = undefined;
    if (before !== undefined) this.#changed('removetrack', before);
    if (parts.length === 0) return;
    const chapters = new StoryTextTrack({ kind: 'chapters', label: 'Parts', language, id: 'parts' }, 'hidden', (...change) => this.#follow(...change));
    chapters.replaceCues(parts.map(({ name, title, startSecs, endSecs }) => Object.assign(new VTTCue(startSecs, endSecs, escaped(title)), { id: name })));
    this.#parts = chapters;
    this.#changed('addtrack', chapters);
  }

  /** Shows or hides captions: those of the track chosen last. */
  setShown(shown: boolean): void {
    if (shown !== (this.#shown !== undefined)) this.#switch(this.#chosen(shown));
  }

  /** Jumps to another time. */
  leap(secs: number): void {
    for (const track of this.#all) track.leap(secs);
  }

  /** Resets all tracks after the story was unloaded. */
  rest(): void {
    for (const track of this.#all) track.rest();
  }

  /**
   * Advances the tracks to a time of the story; `pause` is called, before any event, if a cue has pause-on-exit. Returns
   * true if cues have begun or ended.
   */
  march(captions: readonly Caption[], secs: number, pause: () => void): boolean {
    const all = this.#all.filter(({ mode }) => mode !== 'disabled');
    // What passes while a track is disabled is not reported when it is enabled.
    for (const track of this.#all) if (track.mode === 'disabled') track.leap(secs);
    if (all.length === 0) return false;
    if (captions !== this.#of && this.#own !== undefined) {
      this.#own.replaceCues(captions.map((caption) => new VTTCue(caption.startSecs, caption.endSecs, textOf(caption))));
      this.#of = captions;
    }
    const steps = all.map((track) => track.march(secs)).filter((step): step is Step => step !== undefined);
    if (steps.some(({ pauses }) => pauses)) pause();
    for (const { notify: tell } of steps) tell();
    return steps.length > 0;
  }

  #insert(track: StoryTextTrack): StoryTextTrack {
    this.#added.push(track);
    this.#changed('addtrack', track);
    return track;
  }

  /** Follows a page that sets the mode of a track or adds a cue to it. */
  #follow(track: StoryTextTrack, isCue: boolean): void {
    if (isCue) {
      this.#cueAdded();
      return;
    }
    const isHidden = track === this.#shown && track.mode !== 'showing';
    const isShown = isText(track) && track.mode === 'showing';
    if (isHidden) this.#shown = undefined;
    if (isShown) this.#choose(track);
    if (isHidden || isShown) this.#show(isShown);
    this.#tell();
  }

  #choose(track: StoryTextTrack): void {
    this.#choice = track === this.#own ? undefined : track;
    this.#language = track.language;
    this.#switch(track);
  }

  /** Returns to the language chosen last if another story, whose own language is `own`, does not have it, and a track has. */
  #return(own: string | undefined): void {
    const language = this.#language;
    if (language === undefined || this.#choice !== undefined || isSame(language, own)) return;
    this.#choice = this.#added.find((track) => isText(track) && isSame(language, track.language));
  }

  #chosen(shown: boolean): StoryTextTrack | undefined {
    return shown ? (this.#choice ?? this.#own) : undefined;
  }

  /** Shows a track instead of the one before. */
  #switch(track: StoryTextTrack | undefined): void {
    const before = this.#shown;
    this.#shown = track;
    const isHidden = before !== track && before?.setShown(false);
    const isShown = track?.setShown(true);
    if (isShown || before !== track) this.#cueAdded();
    if (isHidden || isShown) this.#tell();
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

/** Returns true for tags of one language, of whatever region. */
const isSame = (a: string, b: string | undefined): boolean => a.toLowerCase().split('-')[0] === b?.toLowerCase().split('-')[0];

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
