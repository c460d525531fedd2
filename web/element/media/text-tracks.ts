/**
 * Text track list of a player (HTML, 4.8.11.11): the story's captions are one track, and pages add others. As in a
 * `<video>`, a script may show several of them; either the story's own captions are displayed or tracks of the page. A
 * user chooses one, and the language chosen last returns if there is such a track.
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
  /** The tracks that are shown. */
  #shown: readonly StoryTextTrack[] = [];
  /** The tracks of a page that are shown whenever captions are on; empty for the story's own. */
  #choice: readonly StoryTextTrack[] = [];
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

  /** The tracks that are shown, in the order of the list, empty if captions are off: the story's own, or some of a page. */
  get shown(): readonly StoryTextTrack[] {
    return this.#all.filter((track) => this.#shown.includes(track));
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
      this.#switch(this.#chosen(this.#shown.length > 0));
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
    const isShown = this.#shown.includes(track);
    this.#choice = without(this.#choice, track);
    if (track.disable()) this.#tell();
    if (isShown) this.#switch(this.#chosen(true));
  }

  /** Replaces the story's caption track with one in a language; undefined if there is no story. */
  setStory(language: string | undefined, shown: boolean): void {
    const before = this.#own;
    this.#own = this.#of = undefined;
    if (before !== undefined) this.#shown = without(this.#shown, before);
    if (before !== undefined) this.#changed('removetrack', before);
    if (language === undefined) return;
    this.#return(language);
    const isShown = shown && this.#choice.length === 0;
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
    if (shown !== this.#shown.length > 0) this.#switch(this.#chosen(shown));
  }

  /** Shows the track that a user chose instead of all others, or none. */
  select(track: StoryTextTrack | undefined): void {
    if (track === undefined) this.#switch([]);
    else {
      this.#language = track.language;
      this.#choice = track === this.#own ? [] : [track];
      this.#switch([track]);
    }
    this.#show(track !== undefined);
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
    const wasShown = this.#shown.includes(track);
    const isShown = isText(track) && track.mode === 'showing';
    if (isShown) this.#add(track);
    else if (wasShown) this.#leave(track);
    if (wasShown || isShown) this.#show(this.#shown.length > 0);
    this.#tell();
  }

  /** Shows a track that a script shows: with others of the page, or instead of them the story's own. */
  #add(track: StoryTextTrack): void {
    this.#language = track.language;
    this.#choice = track === this.#own ? [] : [...this.#shown.filter((one) => one !== this.#own && one !== track), track];
    this.#switch(this.#choice.length === 0 ? [track] : this.#choice);
  }

  /** Leaves a track out that a script hides; the last one returns with the captions. */
  #leave(track: StoryTextTrack): void {
    this.#shown = without(this.#shown, track);
    if (this.#shown.length > 0) this.#choice = this.#shown;
  }

  /** Returns to the language chosen last if another story, whose own language is `own`, does not have it, and a track has. */
  #return(own: string | undefined): void {
    const language = this.#language;
    if (language === undefined || this.#choice.length > 0 || isSame(language, own)) return;
    this.#choice = this.#added.filter((track) => isText(track) && isSame(language, track.language)).slice(0, 1);
  }

  /** Returns the tracks to show if captions are on, which may be the story's own. */
  #chosen(shown: boolean): readonly StoryTextTrack[] {
    if (!shown) return [];
    return this.#choice.length > 0 || this.#own === undefined ? this.#choice : [this.#own];
  }

  /** Shows tracks instead of those before. */
  #switch(tracks: readonly StoryTextTrack[]): void {
    const before = this.#shown;
    this.#shown = tracks;
    const hidden = before.filter((track) => !tracks.includes(track));
    const changes = [...hidden.map((track) => track.setShown(false)), ...tracks.map((track) => track.setShown(true))];
    if (changes.includes(true) || hidden.length > 0 || tracks.length !== before.length) this.#cueAdded();
    if (changes.includes(true)) this.#tell();
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

const without = (tracks: readonly StoryTextTrack[], track: StoryTextTrack): readonly StoryTextTrack[] => tracks.filter((one) => one !== track);

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
