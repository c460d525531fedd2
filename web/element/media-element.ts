/** The interface of `HTMLMediaElement` and what of `HTMLVideoElement` applies (HTML, 4.8.8 to 4.8.11), over a player's parts. */

import { mediaAttributes, THEMSELVES } from './media/attributes.js';
import type { PlayerContext } from './story/context.js';
import { addStates, canPlay, checkedRate, checkedVolume, crossOriginOf, finite, preloadOf, type MediaStates } from './media/media.js';
import { dispatch, isPending } from './media/media-events.js';
import { openDevice } from './sound/outlet.js';
import { Outputs } from './sound/outputs.js';
import type { Playback } from './media/playback.js';
import { PromptElement } from './media/prompt-element.js';
import { Ranges, without } from './base/ranges.js';
import type { Lesson } from './lesson/lesson.js';
import type { StoryLoader } from './story/story-loader.js';
import type { StoryTextTrack } from './media/text-track.js';
import { TrackElements } from './subtitles/track-elements.js';
import { StoryTextTracks } from './media/text-tracks.js';
import type { PlayerError } from './base/types.js';

/** The parts of a player that the interface speaks for. */
export interface Parts {
  readonly context: PlayerContext;
  readonly playback: Playback;
  readonly stories: StoryLoader;
  readonly lesson: Lesson;
}

export interface MediaElement extends MediaStates {}

// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: `addStates` gives the class and its instances these constants.
export abstract class MediaElement extends PromptElement {
  static override properties = mediaAttributes;

  #volume = 1;
  #muted = false;
  /** A page has said whether it is silent: the attribute, which says how it begins, has no effect any more. */
  #isMutedSet = false;
  #rate = 1;
  #defaultRate = 1;
  #keepsPitch = true;
  #device = '';
  /** Start position of the story once it is loaded. */
  #startSecs = 0;
  /** A source is being looked for. */
  #looks = false;
  readonly #tracks = new StoryTextTracks(
    (shown) => this.showCaptions(shown),
    () => this.#march(this.currentTime),
  );
  readonly #outputs = new Outputs();

  constructor() {
    super();
    this.addController(new TrackElements(this.#tracks, () => this.parts.context));
  }

  protected abstract get parts(): Parts;

  /** Shows or hides captions when a page switches a track of them. */
  protected abstract showCaptions(shown: boolean): void;

  // --- playback ---

  /**
   * Address of the story's EML file, absolute; its speech bundle is in `voice/` next to it. Without it, `''`, the story is the element's content: plain text,
   * or EML in a `<script type="application/eml+xml">`. With it, the content is for readers without scripts.
   */
  get src(): string {
    const address = this.getAttribute('src');
    if (!address || !URL.canParse(address, document.baseURI)) return address ?? '';
    return new URL(address, document.baseURI).href;
  }

  set src(address: string | undefined | null) {
    this.#set('src', address);
  }

  /** Address of the current story; `''` if it has none. */
  get currentSrc(): string {
    return this.parts.stories.address;
  }

  /** Credentials mode of requests for the story's files to other origins: `use-credentials` includes cookies, `null` and `anonymous` send none. */
  get crossOrigin(): 'anonymous' | 'use-credentials' | null {
    return crossOriginOf(this.getAttribute('crossorigin'));
  }

  set crossOrigin(value: string | null) {
    this.#set('crossorigin', value);
  }

  /** `none`: nothing is fetched before playback is requested. `metadata`, the default, and `auto`: as specified by `loading`. */
  get preload(): 'none' | 'metadata' | 'auto' {
    return preloadOf(this.getAttribute('preload'));
  }

  set preload(value: string) {
    this.setAttribute('preload', value);
  }

  /** Returns how likely the player can play a story of a MIME type: `probably`, `maybe` or `''`. Throws `TypeError` without an argument. */
  canPlayType(type: string): CanPlayTypeResult {
    if ((type as string | undefined) === undefined) throw new TypeError('A MIME type is needed.');
    return canPlay(String(type));
  }

  /** Reason why the story cannot be played, or null. */
  get error(): PlayerError | null {
    return this.parts.stories.error ?? null;
  }

  /** `NETWORK_NO_SOURCE` if the story is unavailable or source selection is pending, `NETWORK_LOADING` while it is fetched. */
  get networkState(): number {
    if (this.error !== null) return this.NETWORK_NO_SOURCE;
    const { network } = this.parts.stories;
    if (network === 'empty' && this.#looks) return this.NETWORK_NO_SOURCE;
    return { empty: this.NETWORK_EMPTY, idle: this.NETWORK_IDLE, loading: this.NETWORK_LOADING }[network];
  }

  /** `HAVE_NOTHING` before a story is loaded, `HAVE_CURRENT_DATA` while its audio is missing, else `HAVE_ENOUGH_DATA`. */
  get readyState(): number {
    const { show } = this.parts.context;
    if (show === undefined) return this.HAVE_NOTHING;
    return show.transport.waiting ? this.HAVE_CURRENT_DATA : this.HAVE_ENOUGH_DATA;
  }

  /**
   * Discards the story and loads it again, also after an error. If there is a `src`, it replaces a text passed to `rehearse`. A player that comes near the
   * viewport loads automatically.
   */
  async load(): Promise<void> {
    this.#look();
    this.settleAttributes();
    if (this.src) this.parts.context.text = undefined;
    this.renew();
    await this.parts.stories.ensure();
  }

  /** Discards the story for another one. */
  protected renew(): void {
    const moved = this.currentTime !== 0;
    this.parts.stories.close();
    if (moved) dispatch(this, 'timeupdate');
    this.#startSecs = 0;
    this.playbackRate = this.#defaultRate;
  }

  // --- time ---

  /** Audible story time in seconds; setting it seeks. Before a story is loaded, its start time. Throws `TypeError` for NaN. */
  get currentTime(): number {
    return this.parts.context.show?.transport.position ?? this.#startSecs;
  }

  set currentTime(value: number) {
    const secs = finite('currentTime', value);
    const { context } = this.parts;
    if (context.show === undefined) {
      this.#startSecs = secs;
      return;
    }
    context.started = true;
    this.#tracks.leap(secs);
    context.show.transport.seek(secs);
  }

  /** Sets `currentTime`, which is equally fast. */
  fastSeek(secs: number): void {
    this.currentTime = secs;
  }

  /** True while a seek is in progress. */
  get seeking(): boolean {
    // Both events report its end.
    return isPending(this, 'timeupdate') && isPending(this, 'seeked');
  }

  /** Length of the story and of additions to it, in seconds; NaN until it is loaded, infinite while a mind is connected. */
  get duration(): number {
    const transport = this.parts.context.show?.transport;
    if (transport === undefined) return NaN;
    return transport.openEnded ? Infinity : transport.endSecs;
  }

  /** Time ranges whose audio is loaded. */
  get buffered(): TimeRanges {
    const { show } = this.parts.context;
    if (show === undefined) return new Ranges([]);
    const missing = show.voice.missing().map(({ startSecs, durationSecs }) => [startSecs, startSecs + durationSecs] as const);
    return new Ranges(without(show.transport.endSecs, missing));
  }

  /** The whole story, once loaded. */
  get seekable(): TimeRanges {
    const { show } = this.parts.context;
    return new Ranges(show === undefined ? [] : [[0, show.transport.endSecs]]);
  }

  /** Time ranges that have been played. */
  get played(): TimeRanges {
    return this.parts.context.show?.transport.played ?? new Ranges([]);
  }

  // --- playing ---

  /** True if the story neither plays nor is about to play. */
  get paused(): boolean {
    return this.parts.playback.paused;
  }

  /** True if the story has reached its end and does not loop. */
  get ended(): boolean {
    // A story without duration does not loop.
    const repeats = this.loop && this.duration > 0;
    return !repeats && (this.parts.context.show?.transport.ended ?? false);
  }

  /** Starts playback after loading, if the browser allows audio and the user does not prefer reduced motion. */
  get autoplay(): boolean {
    return this.hasAttribute('autoplay');
  }

  set autoplay(value: boolean) {
    this.toggleAttribute('autoplay', Boolean(value));
  }

  /** Restarts the story at its end. */
  get loop(): boolean {
    return this.hasAttribute('loop');
  }

  set loop(value: boolean) {
    this.toggleAttribute('loop', Boolean(value));
  }

  /**
   * Starts or resumes playback; resolves when the story plays. Rejects with `AbortError` if `pause()` or another story comes first, with `NotAllowedError` if
   * the browser requires a user gesture first, with `NotSupportedError` if the story cannot be played, and with `InvalidStateError` while a question awaits an
   * answer.
   */
  play(): Promise<void> {
    this.#look();
    this.settleAttributes();
    if (this.error !== null) return Promise.reject(new DOMException(this.error.message, 'NotSupportedError'));
    if (this.parts.lesson.asked !== undefined) return Promise.reject(new DOMException('The story waits for an answer.', 'InvalidStateError'));
    return this.parts.playback.play();
  }

  /** Pauses the story; pending promises of `play()` are rejected. */
  pause(): void {
    this.#look();
    this.settleAttributes();
    this.parts.playback.pause();
  }

  /** Playback speed, 0.25 to 4, or 0, which stops time. Throws `NotSupportedError` outside this range, and `TypeError` for NaN. */
  get playbackRate(): number {
    return this.#rate;
  }

  set playbackRate(value: number) {
    const before = this.#rate;
    this.#rate = checkedRate(value);
    if (before !== this.#rate && this.parts.context.show === undefined) dispatch(this, 'ratechange');
  }

  /** Initial speed of the next story. Throws like `playbackRate`. */
  get defaultPlaybackRate(): number {
    return this.#defaultRate;
  }

  set defaultPlaybackRate(value: number) {
    const before = this.#defaultRate;
    this.#defaultRate = checkedRate(value, 'defaultPlaybackRate');
    if (before !== this.#defaultRate) dispatch(this, 'ratechange');
  }

  /** True if the pitch stays the same at other speeds. */
  get preservesPitch(): boolean {
    return this.#keepsPitch;
  }

  set preservesPitch(value: boolean) {
    const kept = Boolean(value);
    if (kept === this.#keepsPitch) return;
    this.#keepsPitch = kept;
    const { show } = this.parts.context;
    show?.voice.keepPitch(kept);
    if (this.#rate !== 1) show?.transport.replan();
  }

  // --- audio ---

  /** Volume, 0 to 1. Throws `IndexSizeError` outside this range, and `TypeError` for NaN. */
  get volume(): number {
    return this.#volume;
  }

  set volume(value: number) {
    const before = this.#volume;
    this.#volume = checkedVolume(value);
    if (before !== this.#volume) dispatch(this, 'volumechange');
  }

  /** True if the story is silent; does not change `volume`. */
  get muted(): boolean {
    return this.#muted;
  }

  set muted(value: boolean) {
    this.#isMutedSet = true;
    const before = this.#muted;
    this.#muted = Boolean(value);
    if (before !== this.#muted) dispatch(this, 'volumechange');
  }

  /** True if the player is initially silent: the attribute `muted`. */
  get defaultMuted(): boolean {
    return this.hasAttribute('muted');
  }

  set defaultMuted(value: boolean) {
    this.toggleAttribute('muted', Boolean(value));
  }

  /** Audio output device; `''` is the user's default. */
  get sinkId(): string {
    return this.#device;
  }

  /**
   * Selects another audio output device. Rejects with `NotFoundError` if the device does not exist, and with `NotSupportedError` if the browser offers no
   * choice.
   */
  async setSinkId(device: string): Promise<void> {
    await openDevice(String(device));
    this.#device = String(device);
    this.parts.context.show?.voice.setDevice(this.#device);
  }

  // --- display ---

  /** Shows controls. */
  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(value: boolean) {
    this.toggleAttribute('controls', Boolean(value));
  }

  /** Width of the rendered image in device pixels; 0 before the first frame. */
  get videoWidth(): number {
    return this.#outputs.size.width;
  }

  /** Height of the rendered image in device pixels; 0 before the first frame. */
  get videoHeight(): number {
    return this.#outputs.size.height;
  }

  /** The story's captions, if there is a story, those of `<track>` elements between the tags, and tracks added by `addTextTrack`. Those whose mode is `showing` are displayed, if they are subtitles or captions; the story's own captions give way to others. */
  get textTracks(): StoryTextTracks {
    return this.#tracks;
  }

  /** Adds a track for the page's own cues, which fire at their times. Throws `TypeError` for an unknown kind. */
  addTextTrack(kind: TextTrackKind, label = '', language = ''): StoryTextTrack {
    return this.#tracks.add(kind, String(label), String(language));
  }

  /** Calls back when the next frame has been rendered; returns a handle for `cancelVideoFrameCallback`. */
  requestVideoFrameCallback(callback: VideoFrameRequestCallback): number {
    return this.#outputs.frames.request(callback);
  }

  /** Cancels such a callback. */
  cancelVideoFrameCallback(handle: number): void {
    this.#outputs.frames.cancel(handle);
  }

  /** Returns the number of frames rendered since the player was created. */
  getVideoPlaybackQuality(): VideoPlaybackQuality {
    return { creationTime: performance.now(), totalVideoFrames: this.#outputs.frames.count, droppedVideoFrames: 0, corruptedVideoFrames: 0 };
  }

  /** Returns image and audio as a stream, with at most `rate` frames per second; volume and mute apply. */
  captureStream(rate?: number): MediaStream {
    const stream = this.#outputs.capture.open(rate, true);
    this.parts.context.keepTime();
    return stream;
  }

  /** Disables picture-in-picture. */
  get disablePictureInPicture(): boolean {
    return this.hasAttribute('disablepictureinpicture');
  }

  set disablePictureInPicture(value: boolean) {
    this.toggleAttribute('disablepictureinpicture', Boolean(value));
  }

  /** Shows the image in a picture-in-picture window. Rejects like a `<video>`: `InvalidStateError` if there is no image or picture-in-picture is disabled. */
  async requestPictureInPicture(): Promise<PictureInPictureWindow> {
    const opened = await this.#outputs.openWindow(this.renderRoot as ShadowRoot, this.disablePictureInPicture, (event) => this.dispatchEvent(event));
    this.parts.context.keepTime();
    return opened;
  }

  /** Attribute `playsinline`, for scripts that set it on any media element; a story always plays inline. */
  get playsInline(): boolean {
    return this.hasAttribute('playsinline');
  }

  set playsInline(value: boolean) {
    this.toggleAttribute('playsinline', Boolean(value));
  }

  // --- for the parts ---

  /** Prepares a story that is on stage: its start time, and its captions as a track. */
  protected begin(language: string, shown: boolean): void {
    const { show } = this.parts.context;
    this.#tracks.setStory(language, shown);
    this.#tracks.setParts(this.parts.lesson.parts, language);
    show?.voice.keepPitch(this.#keepsPitch);
    if (this.#startSecs > 0) this.currentTime = this.#startSecs;
    this.#startSecs = 0;
  }

  /** Resets the tracks after the story was unloaded. */
  protected end(): void {
    this.#tracks.rest();
    this.#tracks.setStory(undefined, false);
    this.#tracks.setParts([], '');
    this.follow();
  }

  /** Captions are shown, or not. */
  protected setCaptionsShown(shown: boolean): void {
    this.#tracks.setShown(shown);
  }

  /** Follows a frame rendered at the time `drawnSecs`, or another canvas, voice or size. */
  protected follow(drawnSecs?: number): void {
    const { context, stories } = this.parts;
    const { show } = context;
    const isResized = this.#outputs.follow({ canvas: show && stories.canvas, voice: show?.voice });
    if (isResized && this.videoWidth > 0) dispatch(this, 'resize');
    if (drawnSecs === undefined || show === undefined) return;
    this.#outputs.drawn(drawnSecs);
    this.#march(drawnSecs);
  }

  protected get isWatchedElsewhere(): boolean {
    return document.pictureInPictureElement === this || this.#outputs.capture.isTaken;
  }

  /** Reports to captured streams that playing continues or has ended. */
  protected capture(goesOn: boolean): void {
    this.#outputs.capture.setLive(goesOn);
  }

  /** Brings text tracks to a moment. Time passes for them once the story was played or sought. */
  #march(secs: number): void {
    const { show, started } = this.parts.context;
    if (show === undefined || !started) return;
    if (this.#tracks.march(show.captions, secs, () => !this.paused && this.pause())) this.requestUpdate();
  }

  override attributeChangedCallback(name: string, before: string | null, after: string | null, namespace?: string | null): void {
    // The attributes of the element have no namespace.
    if (namespace) return;
    const property = THEMSELVES.get(name);
    if (property !== undefined) {
      // The same story also loads again, and continues without its URL.
      if (name === 'src' ? after !== null : before !== after) this.requestUpdate(property, {});
      if (name === 'src' && after !== null) this.#look();
      if (this.disablePictureInPicture && document.pictureInPictureElement === this) void document.exitPictureInPicture();
    } else if (name === 'muted') {
      if (!this.#isMutedSet && !this.hasUpdated) this.#muted = after !== null;
    } else {
      super.attributeChangedCallback(name, before, after);
      if (name === 'playback-rate') this.#defaultRate = this.playbackRate;
    }
  }

  /** Starts looking for a source, until the running script ends (HTML, the resource selection algorithm, steps 1 and 4). */
  #look(): void {
    this.#looks = true;
    queueMicrotask(() => (this.#looks = false));
  }

  #set(attribute: string, value: string | null | undefined): void {
    if (value === null || value === undefined) this.removeAttribute(attribute);
    else this.setAttribute(attribute, value);
  }
}

addStates(MediaElement);
