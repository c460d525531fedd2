/**
 * A text track of a player (HTML, 4.8.11.11). The browser's own class belongs to its own media elements, so this is
 * like it; its cues are the browser's `VTTCue`.
 */

const MODES: readonly string[] = ['disabled', 'hidden', 'showing'];
/** Tolerance that includes a cue exactly at the starting time. */
const AT_ONCE_SECS = 1e-9;

/** Cues by time, and by their `id`. */
export class CueList extends Array<TextTrackCue> {
  getCueById(id: string): TextTrackCue | null {
    return this.find((cue) => id !== '' && cue.id === id) ?? null;
  }
}

/** Changes of a track at a time. */
export interface Step {
  /** A cue that ends wants the story to pause. */
  readonly pauses: boolean;
  /** Dispatches the events of the cues and the track. */
  notify(): void;
}

interface CueChange {
  readonly cue: TextTrackCue;
  readonly type: 'enter' | 'exit';
  readonly secs: number;
}

/** Cues in order of time; of two that begin together the longer one is first. */
const byTime = (a: TextTrackCue, b: TextTrackCue): number => a.startTime - b.startTime || b.endTime - a.endTime;

/** Kind, label and language of a track. */
export interface TrackAbout {
  readonly kind: TextTrackKind;
  readonly label: string;
  readonly language: string;
  readonly id?: string;
}

/** A row of timed texts. */
export class StoryTextTrack extends EventTarget {
  readonly kind: TextTrackKind;
  readonly label: string;
  readonly language: string;
  readonly id: string;
  oncuechange: ((event: Event) => unknown) | null = null;
  /** Callback for a mode that a page sets, or a cue that it adds. */
  readonly #changed: (track: StoryTextTrack, isCue: boolean) => void;
  #mode: TextTrackMode;
  readonly #cues = new CueList();
  readonly #active = new CueList();
  /** Time after which cues have not been dispatched. */
  #toldSecs = -AT_ONCE_SECS;

  constructor(about: TrackAbout, mode: TextTrackMode, changed: (track: StoryTextTrack, isCue: boolean) => void) {
    super();
    this.kind = about.kind;
    this.label = about.label;
    this.language = about.language;
    this.id = about.id ?? '';
    this.#mode = mode;
    this.#changed = changed;
    this.addEventListener('cuechange', (event) => this.oncuechange?.(event));
  }

  /** Mode of the track. `disabled`: inactive; `hidden`: its cues are dispatched; `showing`: they are also displayed, if they are subtitles or captions, and hide the story's own captions. */
  get mode(): TextTrackMode {
    return this.#mode;
  }

  set mode(mode: TextTrackMode) {
    // As for every enumerated attribute, an invalid value changes nothing.
    if (!MODES.includes(mode) || mode === this.#mode) return;
    this.#become(mode);
    this.#changed(this, false);
  }

  /** Shows or hides the track on behalf of the player, not the page; returns true if the mode changed. */
  setShown(shown: boolean): boolean {
    if (shown === (this.#mode === 'showing')) return false;
    this.#become(shown ? 'showing' : 'disabled');
    return true;
  }

  /** Disables the track on behalf of the player; returns true if the mode changed. */
  disable(): boolean {
    if (this.#mode === 'disabled') return false;
    this.#become('disabled');
    return true;
  }

  #become(mode: TextTrackMode): void {
    this.#mode = mode;
    if (mode === 'disabled') this.#active.splice(0);
  }

  /** Cues in order of time; null while the track is disabled. */
  get cues(): CueList | null {
    return this.#mode === 'disabled' ? null : this.#cues.sort(byTime);
  }

  /** Current cues; null while the track is disabled. */
  get activeCues(): CueList | null {
    return this.#mode === 'disabled' ? null : this.#active;
  }

  /** Adds a cue, which leaves the track where it was before. */
  addCue(cue: TextTrackCue): void {
    cue.track?.removeCue(cue);
    this.#cues.push(cue);
    setTrack(cue, this);
    this.#changed(this, true);
  }

  /** Throws `NotFoundError` for a cue of another track. */
  removeCue(cue: TextTrackCue): void {
    const at = this.#cues.indexOf(cue);
    if (at < 0) throw new DOMException('The cue is not in this track.', 'NotFoundError');
    this.#cues.splice(at, 1);
    if (this.#active.includes(cue)) this.#active.splice(this.#active.indexOf(cue), 1);
    setTrack(cue, null);
  }

  /** Replaces all cues. */
  replaceCues(cues: readonly TextTrackCue[]): void {
    this.#cues.splice(0, Infinity, ...cues);
    for (const cue of cues) setTrack(cue, this);
  }

  /** Replaces all cues by those of a file. */
  load(cues: readonly TextTrackCue[]): void {
    this.replaceCues(cues);
    this.#changed(this, true);
  }

  /** Jumps to a time: cues between are not dispatched. */
  leap(secs: number): void {
    this.#toldSecs = secs - AT_ONCE_SECS;
  }

  /** Resets the track after the story was unloaded. */
  rest(): void {
    this.#active.splice(0);
    this.leap(0);
  }

  /** Advances to a time (HTML, “time marches on”): cues that start and end, including those that did both since the last time. */
  march(secs: number): Step | undefined {
    if (this.#mode === 'disabled') return undefined;
    if (secs < this.#toldSecs) this.leap(secs);
    const cues = this.#cues.sort(byTime);
    const now = cues.filter(({ startTime, endTime }) => startTime <= secs && secs < endTime);
    const missed = cues.filter(({ startTime, endTime }) => startTime > this.#toldSecs && startTime <= secs && endTime <= secs);
    const over = [...this.#active.filter((cue) => !now.includes(cue)), ...missed];
    const begun = [...now.filter((cue) => !this.#active.includes(cue)), ...missed];
    this.#toldSecs = secs;
    if (over.length + begun.length === 0) return undefined;
    this.#active.splice(0, Infinity, ...now);
    const told: CueChange[] = [
      ...begun.map((cue) => ({ cue, type: 'enter' as const, secs: cue.startTime })),
      ...over.map((cue) => ({ cue, type: 'exit' as const, secs: Math.max(cue.startTime, cue.endTime) })),
    ];
    // At one time the cues come in their order, and the start of each is reported first.
    told.sort((a, b) => a.secs - b.secs || byTime(a.cue, b.cue));
    const tell = (): void => {
      for (const { cue, type } of told) cue.dispatchEvent(new Event(type));
      this.dispatchEvent(new Event('cuechange'));
    };
    return { pauses: over.some(({ pauseOnExit }) => pauseOnExit), notify: tell };
  }
}

/** Sets the track of a cue; the browser's own property only supports native tracks. */
function setTrack(cue: TextTrackCue, value: StoryTextTrack | null): void {
  Object.defineProperty(cue, 'track', { value, configurable: true });
}
