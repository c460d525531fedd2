/** Subtitles of a page: `<track>` elements between the tags of a player, as in a `<video>`. */

import type { ReactiveController } from 'lit';
import { fetchText, shown } from '../base/fetching.js';
import { PlayerError } from '../base/types.js';
import type { StoryTextTrack } from '../media/text-track.js';
import type { StoryTextTracks } from '../media/text-tracks.js';
import { credentialsOf, type PlayerContext } from '../story/context.js';

/** Limit on the size of a file: subtitles of a whole day have less. */
const MAX_BYTES = 4e6;
/** Attributes that make another track of an element, except the address of its file. */
const ABOUT = ['kind', 'srclang', 'label', 'id'];

/** Track of an element. */
interface Entry {
  readonly track: StoryTextTrack;
  /** The attributes that the track has. */
  readonly about: string;
  /** Address of the file, as written. */
  src: string;
  /** Controller that cancels the request for the file; it stays when the file has come. */
  request?: AbortController | undefined;
}

const aboutOf = (element: HTMLTrackElement): string => JSON.stringify(ABOUT.map((name) => element.getAttribute(name)));

export class TrackElements implements ReactiveController {
  readonly #tracks: StoryTextTracks;
  readonly #context: () => PlayerContext;
  readonly #entries = new Map<HTMLTrackElement, Entry>();
  readonly #observer = new MutationObserver(() => this.#read());

  /** Creates the reader; `context` is called once the player is complete. */
  constructor(tracks: StoryTextTracks, context: () => PlayerContext) {
    this.#tracks = tracks;
    this.#context = context;
    for (const type of ['change', 'addtrack', 'removetrack']) {
      tracks.addEventListener(type, () => {
        this.#load();
        context().player.requestUpdate();
      });
    }
  }

  hostConnected(): void {
    this.#read();
    this.#observer.observe(this.#context().player, { childList: true, subtree: true, attributes: true, attributeFilter: [...ABOUT, 'src'] });
  }

  hostDisconnected(): void {
    this.#observer.disconnect();
  }

  /** The story may have come. */
  hostUpdated(): void {
    this.#load();
  }

  /** Follows the elements: those that are new, gone or changed. */
  #read(): void {
    const all = this.#context().player.querySelectorAll<HTMLTrackElement>(':scope > track');
    const elements = [...all].filter(({ kind }) => kind === 'subtitles' || kind === 'captions');
    for (const [element, entry] of this.#entries) {
      if (elements.includes(element) && entry.about === aboutOf(element)) continue;
      entry.request?.abort();
      this.#entries.delete(element);
      const wasShown = this.#tracks.shown.includes(entry.track);
      this.#tracks.remove(entry.track);
      // The same subtitles under another name.
      if (wasShown && elements.includes(element)) this.#add(element).mode = 'showing';
    }
    for (const element of elements) {
      const entry = this.#entries.get(element);
      const src = element.getAttribute('src') ?? '';
      if (entry === undefined) this.#add(element);
      else if (entry.src !== src) {
        entry.request?.abort();
        entry.track.load([]);
        Object.assign(entry, { src, request: undefined });
      }
    }
    this.#load();
  }

  #add(element: HTMLTrackElement): StoryTextTrack {
    const { kind, label, srclang: language, id } = element;
    const track = this.#tracks.addElement({ kind: kind as TextTrackKind, label, language, id }, element.default);
    this.#entries.set(element, { track, about: aboutOf(element), src: element.getAttribute('src') ?? '' });
    return track;
  }

  /** Fetches the files of tracks that are used, once there is a story, like a `<video>`. */
  #load(): void {
    if (this.#context().show === undefined) return;
    for (const entry of this.#entries.values()) {
      if (entry.track.mode !== 'disabled' && entry.request === undefined) void this.#fetch(entry);
    }
  }

  async #fetch(entry: Entry): Promise<void> {
    const { player, diagnostics } = this.#context();
    const { signal } = (entry.request = new AbortController());
    try {
      const cues = await read(entry.src, signal, player);
      if (signal.aborted) return;
      entry.track.load(cues);
    } catch (error) {
      if (signal.aborted) return;
      entry.request = undefined;
      diagnostics.report({ code: 'subtitles-missing', severity: 'warning', message: error instanceof Error ? error.message : String(error), hints: [] });
      this.#tracks.giveUp(entry.track);
    }
  }
}

/** Fetches a file of subtitles. */
async function read(src: string, signal: AbortSignal, player: PlayerContext['player']): Promise<VTTCue[]> {
  if (!src || !URL.canParse(src, document.baseURI)) throw new PlayerError(`The subtitles have no valid address: ${src || 'the attribute src is missing'}.`);
  const url = new URL(src, document.baseURI);
  const [text, { cuesOf }] = await Promise.all([fetchText(url, { what: 'The subtitle file', most: MAX_BYTES, signal, credentials: credentialsOf(player) }), import('./vtt.js')]);
  const cues = await cuesOf(text);
  if (cues === undefined) throw new PlayerError(`The subtitle file ${shown(url)} is not WebVTT: it does not begin with WEBVTT.`);
  return cues;
}
