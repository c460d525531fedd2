/** `<raconteur-player>`: a storyteller on a page, used like a media element. */

import { html, LitElement, nothing, unsafeCSS, type PropertyValues } from 'lit';
import { classMap } from 'lit/directives/class-map.js';
import { openVoice, pageSound, voiceMissing } from './audio.js';
import { chooseBackend, warmUp } from './backend.js';
import { castFigure, openOrUsual, USUAL_FIGURE } from './cast.js';
import { captionAt, captionsOf } from './captions.js';
import { actionsOf } from './actions.js';
import * as parts from './controls.js';
import look from './element.css?inline';
import type { MindLink } from './mind.js';
import { handleKey } from './keyboard.js';
import type { FigureFile } from './figure.js';
import { LiveScript } from './live.js';
import { Idle } from './idle.js';
import { PictureKeeper } from './keeper.js';
import { fetchStory, type Progress, type StoryFiles } from './loader.js';
import { addStates, checkedRate, checkedVolume, rateFrom, volumeFrom, type MediaStates } from './media.js';
import type { Picture, PictureEvents } from './picture.js';
import { Playback } from './playback.js';
import { Pulse } from './pulse.js';
import type { Show } from './show.js';
import { Transport, type TransportEvent } from './transport.js';
import { PlayerError, type Answer, type Backend, type Cue, type Diagnostic, type FaceCourse, type Hand, type MindState, type PlayerEventMap, type Quality, type Statistics, type Story, type View } from './types.js';
import { Welcome } from './welcome.js';

/** Senders of fragments, as the engine tells them apart. */
const PAGE = 0;
const MIND = 1;
/** What comes now begins this much later, so that its sound can be fetched. */
const LIVE_LEAD_SECS = 0.1;
/** A mind that sends garbage does not fill the page with complaints. */
const MOST_DIAGNOSTICS = 200;

export interface RaconteurPlayer extends MediaStates {}

/** The custom element. Attributes mirror properties; events follow `HTMLMediaElement`. */
export class RaconteurPlayer extends LitElement {
  /** Where the asset library is when the attribute `assets` does not say: set by the script that a page names. */
  static library = 'assets/';
  static override styles = unsafeCSS(look);
  static override properties = {
    src: { reflect: true },
    figure: { reflect: true },
    handedness: { reflect: true },
    mind: { reflect: true },
    assets: { reflect: true },
    poster: { reflect: true },
    label: { reflect: true },
    backend: { reflect: true },
    quality: { reflect: true },
    loading: { reflect: true },
    controls: { type: Boolean, reflect: true },
    captions: { type: Boolean, reflect: true },
    autoplay: { type: Boolean, reflect: true },
    muted: { type: Boolean, reflect: true },
    loop: { type: Boolean, reflect: true },
    volume: { reflect: true, converter: volumeFrom },
    playbackRate: { reflect: true, attribute: 'playback-rate', converter: rateFrom },
  };

  /** Address of the story's EML file; its voice lies in `voice/` beside it. */
  declare src: string | undefined;
  /**
   * Name of a figure of the library, or the address of a `.glb` or `.vrm`. Without it the figure that
   * the story chooses performs (`r:performer`), else `sofia`; `currentFigure` tells who does. The
   * figure before stays on stage until this one is ready, and for good when it cannot be used.
   */
  declare figure: string | undefined;
  /** The dominant hand of who performs; otherwise the story says it, or else the figure. */
  declare handedness: Hand | undefined;
  /** Address (`ws:` or `wss:`) of a mind: EML that it sends is performed, and it is told what happens. See docs/live.md. */
  declare mind: string | undefined;
  /** Address of the asset library, which holds `figures/`; by default the folder `assets/` beside the script. */
  declare assets: string;
  /** A picture to show before the story is loaded. */
  declare poster: string | undefined;
  /** What the player is called by screen readers; say which story it tells. */
  declare label: string;
  /** Forces a back end; by default WebGPU where the browser has it. */
  declare backend: Backend | undefined;
  /** How much work goes into a picture; `auto`, the default, follows what the device can do. */
  declare quality: Quality;
  /** `lazy` loads when the player comes near the window, `eager` at once. */
  declare loading: 'lazy' | 'eager';
  declare controls: boolean;
  declare captions: boolean;
  /** Plays once loaded, where the browser allows sound and the user has not asked for reduced motion. */
  declare autoplay: boolean;
  declare muted: boolean;
  declare loop: boolean;

  #volume = 1;
  #rate = 1;
  #show: Show | undefined;
  #loading: { readonly abort: AbortController; done: Promise<void>; share: number } | undefined;
  /** The figure that is to come next. */
  #coming: AbortController | undefined;
  #link: MindLink | undefined;
  /** A mind is asked for, and what connects to it is being fetched: an empty story does not end meanwhile. */
  #awaited = false;
  /** A file that the user gave, under its name in `figure`. */
  #given: File | undefined;
  #view: View | undefined;
  /** A text that takes the place of the story's file. */
  #text: string | undefined;
  #error: PlayerError | undefined;
  #diagnostics: readonly Diagnostic[] = [];
  #lost: 'no' | 'recovering' | 'yes' = 'no';
  #started = false;
  #announcement = '';
  #canvas: HTMLCanvasElement | undefined;
  #onScreen = false;
  /** Listeners may be called in the middle of an update. */
  #updating = false;
  readonly #keeper = new PictureKeeper();
  readonly #playback = new Playback(
    pageSound,
    (event) => this.dispatchEvent(new Event(event)),
    () => void this.#ensure(),
  );
  readonly #pulse = new Pulse(
    () => this.#advance(),
    () => {
      // Pictures may come slowly; sound is not to wait for them.
      this.#show?.voice.prepare(this.currentTime);
      if (!this.paused) this.dispatchEvent(new Event('timeupdate'));
      this.requestUpdate();
    },
  );
  readonly #welcome = new Welcome(() => this.#advance());
  readonly #idle = new Idle(
    // Controls that hold the keyboard's focus stay.
    () => this.paused || this.renderRoot.querySelector('.bar :focus-visible') !== null,
    () => this.requestUpdate(),
  );
  #caption: ReturnType<typeof captionAt>;
  readonly #resized = new ResizeObserver(() => this.#resize());
  readonly #seen = new IntersectionObserver((entries) => this.#appeared(entries), { rootMargin: '200px' });

  constructor() {
    super();
    this.quality = 'auto';
    this.assets = RaconteurPlayer.library;
    this.label = 'Story';
    this.loading = 'lazy';
    this.controls = this.captions = this.autoplay = this.muted = this.loop = false;
    this.addEventListener('keydown', (event) => this.#onKey(event));
    for (const type of ['pointermove', 'pointerup', 'focusin']) this.addEventListener(type, () => this.#idle.wake());
    this.addEventListener('fullscreenchange', () => this.requestUpdate());
  }

  // --- as HTMLMediaElement ---

  /** Story time that is heard now, seconds; setting it seeks. */
  get currentTime(): number {
    return this.#show?.transport.position ?? 0;
  }

  set currentTime(secs: number) {
    const show = this.#show;
    if (show === undefined) return;
    this.#started = true;
    show.transport.seek(secs);
  }

  /** Length of the story and of what has joined it, seconds; NaN until it is loaded, infinite while a mind is there. */
  get duration(): number {
    const transport = this.#show?.transport;
    if (transport === undefined) return NaN;
    return transport.openEnded ? Infinity : transport.endSecs;
  }

  get paused(): boolean {
    return this.#playback.paused;
  }

  /** Loudness, 0 to 1. Throws `IndexSizeError` beyond, and `TypeError` for what is not a number. */
  get volume(): number {
    return this.#volume;
  }

  set volume(value: number) {
    this.#volume = checkedVolume(value);
  }

  /** Speed, 0.5 to 2; the pitch stays. Throws `NotSupportedError` beyond, and `TypeError` for what is not a number. */
  get playbackRate(): number {
    return this.#rate;
  }

  set playbackRate(value: number) {
    this.#rate = checkedRate(value);
  }

  get ended(): boolean {
    return this.#show?.transport.ended ?? false;
  }

  /** Why the story cannot be played, or null. */
  get error(): PlayerError | null {
    return this.#error ?? null;
  }

  /** `HAVE_NOTHING` before a story is there, `HAVE_CURRENT_DATA` while its sound is waited for, else `HAVE_ENOUGH_DATA`: as for media elements. */
  get readyState(): number {
    if (this.#show === undefined) return this.HAVE_NOTHING;
    return this.#show.transport.waiting ? this.HAVE_CURRENT_DATA : this.HAVE_ENOUGH_DATA;
  }

  /** `NETWORK_NO_SOURCE` when the story cannot be had, `NETWORK_LOADING` while it is fetched: as for media elements. */
  get networkState(): number {
    if (this.#error !== undefined) return this.NETWORK_NO_SOURCE;
    if (this.#loading !== undefined) return this.NETWORK_LOADING;
    return this.#show === undefined ? this.NETWORK_EMPTY : this.NETWORK_IDLE;
  }

  /** What is wrong with the story; the rest of it plays. */
  get diagnostics(): readonly Diagnostic[] {
    return this.#diagnostics;
  }

  /** Name of the figure on stage; differs from `figure` while that one is loading, and when it could not be used. */
  get currentFigure(): string | undefined {
    return this.#show?.figure;
  }

  /** Times, bytes and draw calls, once a picture was shown. */
  get statistics(): Statistics | undefined {
    const show = this.#show;
    const picture = show?.picture.statistics;
    if (show === undefined || picture === undefined || show.picture.firstShownMs === undefined) return undefined;
    const { eml, bundle, figure } = show.files;
    return {
      ...picture,
      firstFrameMs: show.picture.firstShownMs - show.sinceMs,
      bytes: { story: new TextEncoder().encode(eml).length, voice: bundle?.length ?? 0, figure: figure.glb.length },
    };
  }

  /** Lets a file of the user's own perform, a `.glb` or `.vrm`; it stays on this machine. */
  useFigure(file: File): void {
    this.#given = file;
    // The same name may stand for another file than before.
    if (this.#show?.figure === file.name) this.#show.figure = '';
    this.figure = file.name;
    this.requestUpdate('figure', '');
  }

  /** The build in use, once loaded. */
  get activeBackend(): Backend | undefined {
    return this.#show?.picture.backend;
  }

  /**
   * Begins or goes on; resolves when it plays. Rejects with `AbortError` when `pause()` or another
   * story comes first, with `NotAllowedError` where the browser wants a gesture of the user first, and
   * with `NotSupportedError` when the story cannot be played.
   */
  play(): Promise<void> {
    this.#settleAttributes();
    if (this.#error !== undefined) return Promise.reject(new DOMException(this.#error.message, 'NotSupportedError'));
    return this.#playback.play();
  }

  pause(): void {
    this.#settleAttributes();
    this.#playback.pause();
  }

  /** Lets go of the story and loads it anew, also after an error; a player that comes near the window loads by itself. */
  async load(): Promise<void> {
    this.#settleAttributes();
    this.#close();
    await this.#ensure();
  }

  /** A change of `src` takes effect with the next update: now, for whoever asks for what follows from it. */
  #settleAttributes(): void {
    if (this.hasUpdated && this.isUpdatePending && !this.#updating) this.performUpdate();
  }

  protected override performUpdate(): void {
    this.#updating = true;
    super.performUpdate();
    this.#updating = false;
  }

  /** Loads the story if it is not loaded and there was no error. */
  async #ensure(): Promise<void> {
    // A new src takes effect with the next update.
    await this.updateComplete;
    if (this.#show !== undefined || this.#error !== undefined) return;
    if (this.#loading === undefined) {
      const abort = new AbortController();
      this.#loading = { abort, share: 0, done: Promise.resolve() };
      this.#loading.done = this.#load(abort.signal);
    }
    await this.#loading?.done;
  }

  /**
   * Performs EML now: a list of clauses, or a whole script, whose plain times count from now. Gives
   * what is accepted and what is not; rejects only when there is no story.
   */
  async perform(fragment: string): Promise<readonly Answer[]> {
    await this.#ensure();
    const show = this.#show;
    if (show === undefined) throw this.#error ?? new DOMException('The story was replaced.', 'AbortError');
    await show.picture.equip();
    return this.#perform(show, PAGE, fragment);
  }

  #perform(show: Show, mind: number, fragment: string): readonly Answer[] {
    const nowSecs = show.transport.position + LIVE_LEAD_SECS;
    const performed = show.picture.perform(mind, String(fragment), nowSecs);
    if (performed === undefined) return [{ kind: 'failed', timeSecs: nowSecs, code: 'live::absent', message: 'The storyteller is away for a moment.' }];
    if (performed.utterances.length > 0) show.captions = captionsOf(show.script.add(performed, nowSecs));
    void this.#lendVoice(show);
    this.#hearMusic(show);
    if (performed.endSecs > show.transport.endSecs) {
      show.transport.extend(performed.endSecs);
      this.dispatchEvent(new Event('durationchange'));
    }
    for (const event of performed.events) if (event.kind !== 'accepted') this.#pass(event, show);
    this.requestUpdate();
    return performed.events;
  }

  /** Lets the mind of the attribute in, and the one before go. */
  async #connect(show: Show): Promise<void> {
    this.#link?.close();
    this.#link = undefined;
    const address = this.mind;
    this.#awaited = Boolean(address);
    if (!address) return;
    try {
      const [{ MindLink }] = await Promise.all([import('./mind.js'), show.picture.equip()]);
      if (this.#show !== show || this.mind !== address || this.#link !== undefined) return;
      this.#link = MindLink.open(address, {
        hello: () => ({ timeSecs: this.currentTime, endSecs: show.transport.endSecs, figure: show.figure }),
        perform: (fragment) => this.#perform(show, MIND, fragment),
        report: (diagnostic) => this.#report(diagnostic),
        state: (state) => this.#onMind(state),
      });
    } catch {
      this.#report({ code: 'mind-lost', severity: 'warning', message: 'What connects to minds could not be fetched.', hints: [] });
    }
    this.#awaited = false;
  }

  #onMind(state: MindState): void {
    this.#advance();
    this.#fire('mindchange', { state });
  }

  // --- life ---

  override connectedCallback(): void {
    super.connectedCallback();
    if (!this.hasAttribute('tabindex')) this.tabIndex = 0;
    if (!this.hasAttribute('role')) this.setAttribute('role', 'region');
    this.#resized.observe(this);
    this.#seen.observe(this);
    this.#keepTime();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#resized.disconnect();
    this.#seen.disconnect();
    // Moving an element disconnects it for a moment.
    setTimeout(() => {
      if (this.isConnected) return;
      this.#close();
      this.#keeper.close();
    });
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has('mind') && this.#show !== undefined) void this.#connect(this.#show);
    if (changed.has('src')) this.#text = undefined;
    if (changed.has('label')) this.setAttribute('aria-label', this.label);
    const replaced = (['src', 'backend', 'assets'] as const).some((name) => changed.has(name));
    const figure = (changed.has('figure') || changed.has('handedness')) && this.hasUpdated;
    if (figure && !replaced && this.#show !== undefined) {
      void this.#changeFigure(this.#show);
    } else if ((replaced || figure) && this.hasUpdated) {
      this.#close();
      if ((this.#onScreen || this.loading === 'eager') && this.#hasStory) void this.#ensure();
    } else if (changed.has('loading') && this.loading === 'eager' && this.#hasStory) {
      void this.#ensure();
    }
    this.#show?.voice.setVolume(this.muted ? 0 : this.volume);
    if ((changed.has('volume') || changed.has('muted')) && this.hasUpdated) this.dispatchEvent(new Event('volumechange'));
    if (changed.has('playbackRate') && this.hasUpdated && this.#show === undefined) this.dispatchEvent(new Event('ratechange'));
    if (this.#show !== undefined) {
      this.#show.transport.loop = this.loop;
      this.#show.transport.setRate(this.playbackRate);
      this.#show.picture.setQuality(this.quality);
    }
  }

  #appeared(entries: readonly IntersectionObserverEntry[]): void {
    this.#onScreen = entries.at(-1)?.isIntersecting ?? false;
    if (this.#onScreen && this.#hasStory) void this.#ensure();
    this.#keepTime();
  }

  get #hasStory(): boolean {
    return this.src !== undefined || this.#text !== undefined;
  }

  /** Fetches and opens the story; what goes wrong ends as `error`, never as a rejection. */
  async #load(signal: AbortSignal): Promise<void> {
    const sinceMs = performance.now();
    this.dispatchEvent(new Event('loadstart'));
    const progress = (share: number) => {
      if (this.#loading && !signal.aborted) this.#loading.share = share;
      this.requestUpdate();
    };
    try {
      if (!this.src && this.#text === undefined) throw new PlayerError('No story is given: set the attribute src.');
      const choosing = Promise.resolve(this.backend ?? chooseBackend());
      void choosing.then(warmUp);
      let [files, backend] = await Promise.all([fetchStory({ src: this.src, text: this.#text, expectsLines: this.mind !== undefined }, this.#library, (eml, part) => this.#fetchFigure(eml, choosing, part), signal, progress), choosing]);
      signal.throwIfAborted();
      // An adapter is no promise of a device; WebGL2 may still have one.
      const backends: [Backend, ...Backend[]] = this.backend || backend === 'webgl' ? [backend] : [backend, 'webgl'];
      const events: PictureEvents = {
        canvas: (canvas) => this.#setCanvas(canvas, signal),
        lost: (recovering) => this.#setLost(recovering ? 'recovering' : 'yes', signal),
        back: () => this.#setLost('no', signal),
        retold: (story, live, anew) => (live ? story.diagnostics.forEach((d) => this.#report(d)) : this.#retell(story, anew)),
        failed: (message) => this.#report({ code: 'engine-failed', severity: 'error', message, hints: [] }),
      };
      const open = (figure: FigureFile) => this.#keeper.open(backends, (files = { ...files, figure }), events, signal);
      // Whom the page asks for, nobody else takes the place of.
      const opened = await (this.figure ? open(files.figure) : openOrUsual(open, files.figure, this.#library, (d) => this.#report(d)));
      if (this.#view !== undefined) opened.picture.look(this.#view);
      this.#open(opened.story, opened.picture, files, sinceMs);
      for (const missing of opened.missing) this.#report(missing);
    } catch (error) {
      if (signal.aborted) return;
      this.#fail(error);
    } finally {
      if (!signal.aborted) this.#loading = undefined;
      this.requestUpdate();
    }
  }

  /** The figure that is asked for now: one of the library, of an address, or the user's own; else the one that the story chooses. */
  async #fetchFigure(eml: Promise<string>, backend: Promise<Backend>, progress: Progress): Promise<FigureFile> {
    const { figure, handedness } = this;
    const wish = { figure, handedness, given: this.#given, library: this.#library, story: new URL(this.src ?? '', document.baseURI) };
    return await castFigure(wish, eml, backend, progress, (d) => this.#report(d));
  }

  get #library(): URL {
    return new URL(this.assets.endsWith('/') ? this.assets : `${this.assets}/`, document.baseURI);
  }

  /** The music of what is performed now. */
  #hearMusic({ voice, picture }: Show): void {
    voice.setMusic(picture.music(), new URL('music/', this.#library));
  }

  /**
   * Puts another text in the place of the one on stage; figure, picture, time and whether it plays
   * stay. Works without `src`, too. What is wrong with the text is in the answer and in
   * `diagnostics`, the rest plays; rejects only when there is no stage. Live fragments end.
   */
  async rehearse(eml: string): Promise<readonly Diagnostic[]> {
    await this.updateComplete;
    const text = (this.#text = String(eml));
    this.#keepTime();
    await this.#ensure();
    const show = this.#show;
    if (show === undefined) throw this.#error ?? new DOMException('The story was replaced.', 'AbortError');
    await show.picture.equip(text);
    // The one that came last is being read already.
    if (text !== this.#text || show !== this.#show) return this.#diagnostics;
    const story = show.picture.rehearse(text);
    if (story === undefined) return [{ code: 'live::absent', severity: 'warning', message: 'The storyteller is away for a moment.', hints: [] }];
    show.files = { ...show.files, eml: text };
    this.#retell(story, true);
    return story.diagnostics;
  }

  /** The story has other times, or is another: what is known of it follows. */
  #retell(story: Story, anew: boolean): void {
    const show = this.#show;
    if (show === undefined) return;
    show.story = story;
    const spoken = show.script.replace(story.utterances);
    show.captions = captionsOf(story.utterances);
    show.transport.replace(story.durationSecs, spoken);
    this.#hearMusic(show);
    void this.#lendVoice(show);
    this.#diagnostics = [...this.#diagnostics.filter((d) => !anew || d.start === undefined), ...story.diagnostics].slice(0, MOST_DIAGNOSTICS);
    this.dispatchEvent(new Event('durationchange'));
    if (this.paused) this.#advance();
    if (!this.figure && story.performer.figure !== show.choice) void this.#changeFigure(show);
    this.requestUpdate();
  }

  /** Shows the whole figure from another side, for pages that look behind the scenes. */
  look(view: View): void {
    this.#view = view;
    this.#keepTime();
    this.#show?.picture.look(view);
    if (this.paused) this.#advance();
  }

  /** What a page needs to draw over the picture shown last; read it with `web/pages/pose.ts`. Undefined without a story. */
  pose(): { readonly names: readonly string[]; readonly numbers: Float32Array } | undefined {
    return this.#show?.picture.pose();
  }

  /** What a page needs to draw how the face speaks from one time to another; read it with `web/pages/face/course.ts`. Undefined without a story. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#show?.picture.course(from, to, count);
  }

  /** Fetches and reads another figure while the present one performs; what goes wrong is a diagnostic. */
  async #changeFigure(show: Show): Promise<void> {
    this.#coming?.abort();
    this.#coming = undefined;
    show.choice = show.story.performer.figure;
    // Back to the figure that is still on stage.
    if ((this.figure || show.choice || USUAL_FIGURE) === show.figure && this.handedness === show.files.figure.handedness) return;
    const { signal } = (this.#coming = new AbortController());
    try {
      const figure = await this.#fetchFigure(Promise.resolve(show.files.eml), Promise.resolve(show.picture.backend), () => undefined);
      signal.throwIfAborted();
      // The one who performs where the story's choice cannot is there already.
      if (figure.name === show.figure && figure.handedness === show.files.figure.handedness) return;
      const { story, missing } = await show.picture.setFigure(figure);
      signal.throwIfAborted();
      Object.assign(show, { story, figure: figure.name, files: { ...show.files, figure } });
      // What was live ended with the figure that did it.
      show.script.forget();
      show.captions = captionsOf(story.utterances);
      this.#hearMusic(show);
      // What was wrong with the figure before is gone with it.
      this.#diagnostics = this.#diagnostics.filter((d) => d.code === 'voice-missing' || d.code === 'sound-missing');
      for (const diagnostic of [...story.diagnostics, ...figure.diagnostics, ...missing]) this.#report(diagnostic);
      this.#say('Another storyteller is on stage');
      this.#fire('figurechange', { figure: figure.name });
      this.#advance();
    } catch (error) {
      if (signal.aborted) return;
      const message = error instanceof Error ? error.message : String(error);
      this.#report({ code: 'figure-unusable', severity: 'error', message, hints: ['The figure before stays on stage.'] });
      this.#say(message);
    } finally {
      if (!signal.aborted) this.#coming = undefined;
      this.requestUpdate();
    }
  }

  /** Has the browser's own voice say what has no recording, and tells whether there is one. */
  async #lendVoice(show: Show): Promise<void> {
    if (show.lent || [...show.script].every(({ audio, words }) => audio.length > 0 || words.length === 0)) return;
    show.lent = true;
    const { language, voice } = show.story.performer;
    const name = await show.voice.substitute({ language: this.lang || language || this.closest<HTMLElement>('[lang]')?.lang || navigator.language, voice });
    if (this.#show !== show) return;
    this.#report(voiceMissing(show.files.bundle !== undefined, name));
  }

  #open(story: Story, picture: Picture, files: StoryFiles, sinceMs: number): void {
    const { voiceFolder, figure } = files;
    const script = new LiveScript(story.utterances);
    const voice = openVoice(script, voiceFolder, (message) => this.#report({ code: 'sound-missing', severity: 'warning', message, hints: [] }));
    const transport = new Transport(voice, story.durationSecs, (event) => this.#onTransport(event), this.playbackRate);
    this.#show = { story, figure: figure.name, choice: story.performer.figure, files, sinceMs, picture, voice, transport, script, captions: captionsOf(story.utterances) };
    this.#hearMusic(this.#show);
    this.#started = false;
    this.#resize();
    for (const diagnostic of [...story.diagnostics, ...figure.diagnostics]) this.#report(diagnostic);
    void this.#lendVoice(this.#show);
    this.requestUpdate();
    this.dispatchEvent(new Event('durationchange'));
    for (const event of ['loadedmetadata', 'loadeddata', 'canplay', 'canplaythrough']) this.dispatchEvent(new Event(event));
    // A listener may have asked for another story.
    if (this.#show?.transport !== transport) return;
    this.#playback.attach(transport);
    void this.#connect(this.#show);
    this.#keepTime();
    this.#advance();
    if (this.autoplay && this.#playback.mayAutoplay && !matchMedia('(prefers-reduced-motion: reduce)').matches) {
      this.play().catch(() => this.#say('Press play to begin'));
    }
  }

  /** Lets go of the story; the picture is kept for the next. */
  #close(): void {
    const before = this.networkState;
    this.#loading?.abort.abort();
    this.#loading = undefined;
    this.#coming?.abort();
    this.#coming = undefined;
    this.#link?.close();
    this.#link = undefined;
    this.#awaited = false;
    this.#show?.voice.close();
    this.#show = undefined;
    this.#playback.detach();
    this.#error = undefined;
    this.#diagnostics = [];
    this.#lost = 'no';
    this.#caption = undefined;
    this.#canvas = undefined;
    this.#keepTime();
    this.requestUpdate();
    if (before === this.NETWORK_IDLE || before === this.NETWORK_LOADING) this.dispatchEvent(new Event('abort'));
    if (before !== this.NETWORK_EMPTY) this.dispatchEvent(new Event('emptied'));
  }

  #fail(error: unknown): void {
    this.#error =
      error instanceof PlayerError
        ? error
        : new PlayerError(error instanceof Error ? error.message : String(error), { cause: error });
    this.dispatchEvent(new ErrorEvent('error', { message: this.#error.message, error: this.#error }));
    this.#playback.fail(this.#error.message);
  }

  #report(diagnostic: Diagnostic): void {
    this.#diagnostics = [...this.#diagnostics, diagnostic].slice(-MOST_DIAGNOSTICS);
    this.#fire('diagnostic', diagnostic);
    this.requestUpdate();
  }

  #setCanvas(canvas: HTMLCanvasElement, signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#canvas = canvas;
    this.requestUpdate();
  }

  #setLost(lost: 'no' | 'recovering' | 'yes', signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#lost = lost;
    if (lost !== 'no') this.#say('The picture is lost; the story goes on in sound and captions');
    this.requestUpdate();
    this.#advance();
  }

  // --- time ---

  /** Runs the loops that are needed now, and no others. */
  #keepTime(): void {
    this.#pulse.keep(this.isConnected && this.#show !== undefined && !this.paused, this.#onScreen);
    this.#welcome.keep(this.isConnected && this.#onScreen && this.#waits);
  }

  /** The story has not begun: the figure waits. A page that edits, or looks from elsewhere, wants its first moment. */
  get #waits(): boolean {
    return this.#show !== undefined && this.paused && !this.#started && this.#text === undefined && this.#view === undefined;
  }

  /** Shows what is heard now. */
  #advance(): void {
    const show = this.#show;
    if (show === undefined) return;
    const openEnded = this.#link?.listening ?? this.#awaited;
    if (openEnded !== show.transport.openEnded) {
      show.transport.openEnded = openEnded;
      show.picture.setOpenEnded(openEnded);
      this.dispatchEvent(new Event('durationchange'));
    }
    const secs = show.transport.update();
    if (this.#waits) show.picture.welcome(this.#welcome.secs);
    else for (const cue of show.picture.show(secs, this.paused && !this.ended, this.#pulse.drawing)) this.#pass(cue, show);
    // A picture may have taken long; what is read follows what is heard.
    const now = captionAt(show.captions, show.transport.position);
    if (now?.caption !== this.#caption?.caption || now?.word !== this.#caption?.word) {
      this.#caption = now;
      this.requestUpdate();
    }
  }

  #pass(cue: Cue, show: Show): void {
    this.#link?.tell(cue);
    if (cue.kind === 'word') {
      const word = show.script.at(cue.utterance)?.words[cue.word];
      if (word !== undefined) this.#fire('word', { word, utterance: cue.utterance, index: cue.word });
    } else if (cue.kind === 'clause' || cue.kind === 'storyevent' || cue.kind === 'phone' || cue.kind === 'utterance') {
      this.#fire(cue.kind, cue);
    } else if (cue.kind === 'failed' || cue.kind === 'warning') {
      const { code, message, hints = [] } = cue;
      this.#report({ code, severity: cue.kind === 'failed' ? 'error' : 'warning', message, hints });
    }
  }

  #onTransport(event: TransportEvent): void {
    if (event === 'seeking') {
      this.dispatchEvent(new Event('seeking'));
      return;
    }
    if (event === 'play') this.#started = true;
    if (event === 'play' || event === 'pause') this.#idle.wake();
    if (event === 'play') this.#say('Playing');
    if (event === 'pause') this.#say(this.ended ? 'The story has ended' : 'Paused');
    if (event === 'seeked') {
      this.#show?.picture.seek(this.currentTime);
      this.#advance();
    }
    this.#link?.tell({ kind: 'transport', event, timeSecs: this.currentTime });
    if (event === 'seeked' || event === 'pause') this.dispatchEvent(new Event('timeupdate'));
    this.dispatchEvent(new Event(event));
    if (event === 'playing') this.#playback.started();
    this.#keepTime();
    this.requestUpdate();
  }

  #fire<K extends keyof PlayerEventMap>(type: K, detail: PlayerEventMap[K]['detail']): void {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#show?.picture.resize(clientWidth, clientHeight);
    // While it plays the next frame comes by itself.
    if (this.paused) this.#advance();
  }

  // --- the user ---

  readonly #actions = actionsOf(this, (text) => this.#say(text));

  get #isFullscreen(): boolean {
    return document.fullscreenElement === this;
  }

  #onKey(event: KeyboardEvent): void {
    this.#idle.wake();
    if (event.defaultPrevented || !this.controls) return;
    if (handleKey(event, event.composedPath()[0], this.#actions)) event.preventDefault();
  }

  #say(text: string): void {
    this.#announcement = text;
    this.requestUpdate();
  }

  protected override render() {
    const show = this.#show;
    const before = show !== undefined && this.paused && (!this.#started || this.ended);
    return html`<div class="frame">
      <div class=${classMap({ stage: true, shown: show !== undefined && this.#lost === 'no', 'hide-cursor': this.#idle.is })} part="stage" @pointerdown=${(event: PointerEvent) => this.#idle.tap(event, this.paused)} @click=${() => show && !this.#idle.tapWoke && this.#actions.toggle()}>
        ${this.#canvas}
      </div>
      ${this.poster && !this.#started ? html`<img class="poster" part="poster" src=${this.poster} alt="" />` : nothing}
      ${this.#loading ? parts.loadingProgress(this.#loading.share) : nothing}
      ${show?.transport.waiting || this.#coming ? parts.waitingRing() : nothing}
      ${before ? parts.bigButton(this.ended, this.#actions.toggle) : nothing}
      <div class="lower">
        ${this.captions && !before ? parts.caption(this.#caption) : nothing}
        ${show && this.controls ? this.#bar(show) : nothing}
      </div>
      <div class="notes">
        ${this.#lost !== 'no' ? parts.pictureLost(this.#lost === 'recovering', () => void show?.picture.recover(true)) : nothing}
        ${this.controls && (this.paused || !this.#idle.is) ? parts.diagnosticList(this.#diagnostics) : nothing}
      </div>
      ${this.#error ? parts.failure(this.#error.message, () => void this.load()) : nothing}
      <div class="unseen" role="status">${this.#announcement}</div>
    </div>`;
  }

  #bar(show: Show) {
    return parts.bar(
      {
        paused: this.paused,
        ended: this.ended,
        position: this.currentTime,
        duration: show.transport.endSecs,
        volume: this.volume,
        muted: this.muted,
        rate: show.transport.rate,
        captions: this.captions,
        fullscreen: this.#isFullscreen,
        canFullscreen: document.fullscreenEnabled,
        gone: this.#idle.is && !this.paused,
      },
      this.#actions,
    );
  }
}

addStates(RaconteurPlayer);

declare global {
  interface HTMLElementTagNameMap {
    'raconteur-player': RaconteurPlayer;
  }
}
