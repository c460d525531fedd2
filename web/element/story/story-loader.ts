/** Loading of a story: opens it, reads edited texts, and closes it; holds its error and the state of the picture. */

import { openVoice } from '../sound/audio.js';
import { chooseBackends, decodeScript, warmUp } from '../engine/backend.js';
import { captionsOf } from '../captions/captions.js';
import { openOrUsual } from './cast.js';
import type { FigureLoader } from './figure-loader.js';
import { credentialsOf, languageAround, languageOf, libraryOf, wordsFor, type PlayerContext } from './context.js';
import type { FigureFile } from '../engine/figure.js';
import { PictureKeeper, type OpenedPicture } from '../picture/keeper.js';
import { LiveScript } from '../engine/live.js';
import { fetchStory, type StoryFiles, type StoryRequest } from '../engine/loader.js';
import { dispatch, takeBack } from '../media/media-events.js';
import type { InlineStory } from './inline-story.js';
import type { PictureEvents } from '../picture/picture-events.js';
import type { Show } from './show.js';
import { substituteVoice, updateMusic } from './sound.js';
import { Transport, type TransportEvent } from '../media/transport.js';
import { PlayerError, type Backend, type Diagnostic, type Story } from '../base/types.js';
import { SilentVoice } from '../sound/voice.js';

/** Story used before there is any content. */
const EMPTY = "<eml><body><null time='0'/></body></eml>";

/** The answer where there is no engine to read an edited text. */
const ABSENT: Diagnostic = { code: 'live::absent', severity: 'warning', message: 'The storyteller is temporarily unavailable.', hints: [] };

/** Minimum interval of `progress` events, ms. */
const PROGRESS_MS = 350;
/** Time without data before a `stalled` event, ms. */
const STALLED_MS = 3000;

/** There is nothing to load. */
class NoStoryError extends PlayerError {}

/** Callbacks of the element when a story opens, fails, or closes. */
export interface StoryLoaderEvents {
  /** Called when a story is on stage, before the page is notified. */
  opened(show: Show): void;
  /** Called after the page has been notified. */
  ready(show: Show): void;
  failed(message: string): void;
  /** Called when the story is gone. */
  closed(): void;
  transport(event: TransportEvent): void;
}

export class StoryLoader {
  readonly #context: PlayerContext;
  readonly #figures: FigureLoader;
  readonly #events: StoryLoaderEvents;
  readonly #keeper = new PictureKeeper();
  #loading: { done: Promise<void>; share: number } | undefined;
  /** Controller of the fetches for the current story. */
  #wanted: AbortController | undefined;
  #error: PlayerError | undefined;
  #canvas: HTMLCanvasElement | undefined;
  #lost: 'no' | 'recovering' | 'yes' = 'no';
  /** True if live lines are performed without a story. */
  #bare = false;
  /** The story between the tags. */
  readonly #own: InlineStory;
  /** True if a story was chosen that loads on playback. */
  #waits = false;
  #address = '';
  /** The story is there, and its sound is waited for. */
  #lingers = false;
  /** Time of the last `progress` event; the next field is the stall timer. */
  #toldMs = 0;
  #silence: ReturnType<typeof setTimeout> | undefined;

  constructor(context: PlayerContext, figures: FigureLoader, own: InlineStory, events: StoryLoaderEvents) {
    this.#context = context;
    this.#figures = figures;
    this.#own = own;
    this.#events = events;
  }

  /** Loaded share, 0 to 1; undefined if nothing is being loaded. */
  get share(): number | undefined {
    return this.#loading?.share;
  }

  /** Reason why the story cannot be played. */
  get error(): PlayerError | undefined {
    return this.#error;
  }

  /** Network state: nothing chosen, chosen, or loading. */
  get network(): 'empty' | 'idle' | 'loading' {
    if (this.#loading !== undefined) return 'loading';
    return this.#waits || this.#context.show !== undefined ? 'idle' : 'empty';
  }

  /** Address of the last chosen story. */
  get address(): string {
    return this.#address;
  }

  /** True if a story was chosen that loads on playback. */
  get waits(): boolean {
    return this.#waits;
  }

  get canvas(): HTMLCanvasElement | undefined {
    return this.#canvas;
  }

  /** State of the picture, while the story continues. */
  get lost(): 'no' | 'recovering' | 'yes' {
    return this.#lost;
  }

  /** True if there is something to load. */
  get hasStory(): boolean {
    const { player, text } = this.#context;
    return player.hasAttribute('src') || text !== undefined || this.#bare || Boolean(player.mind) || this.#own.isThere;
  }

  /** Loads the story unless it is loaded or failed; errors are stored in `error`, never rejected. */
  async ensure(): Promise<void> {
    // A new src takes effect with the next update.
    await this.#context.player.updateComplete;
    if (this.#context.show !== undefined || this.#error !== undefined) return;
    if (this.#loading === undefined) {
      this.#wanted = new AbortController();
      this.#loading = { share: 0, done: Promise.resolve() };
      this.#loading.done = this.#load(this.#wanted.signal);
    }
    await this.#loading?.done;
  }

  /** Does the same as `ensure`, unless the page defers loading until `play()`. */
  async come(): Promise<void> {
    const { player, show } = this.#context;
    await player.updateComplete;
    if (player.preload !== 'none' || player.autoplay) return await this.ensure();
    if (this.#waits || this.network !== 'empty' || show !== undefined || this.#error !== undefined) return;
    this.#choose();
    this.#waits = true;
    dispatch(player, 'suspend');
    player.requestUpdate();
  }

  /** Starts the selection of a story. */
  #choose(): void {
    const { player } = this.#context;
    this.#address = player.src;
    dispatch(player, 'loadstart');
  }

  /** Does the same as `ensure`; returns the show, and throws if there is none. */
  async require(): Promise<Show> {
    await this.ensure();
    const { show } = this.#context;
    if (show === undefined) throw this.#error ?? new DOMException('The story was replaced.', 'AbortError');
    return show;
  }

  /** Does the same as `require`; without any story, returns an empty stage, whose time has no end. */
  async stage(): Promise<Show> {
    await this.#context.player.updateComplete;
    if (!this.hasStory) this.#bare = true;
    this.#comeBack();
    return await this.require();
  }

  /** Resumes playback that had nothing to play. */
  #comeBack(): void {
    if (this.#error instanceof NoStoryError) this.#error = undefined;
  }

  async #load(signal: AbortSignal): Promise<void> {
    const sinceMs = performance.now();
    const { player } = this.#context;
    if (!this.#waits) this.#choose();
    this.#waits = false;
    player.requestUpdate();
    this.#listen();
    try {
      const { opened, files } = await this.#fetchAndOpen(signal);
      if (this.#context.view !== undefined) opened.picture.look(this.#context.view);
      this.#open(opened, files, sinceMs);
      for (const missing of opened.missing) this.#context.diagnostics.report(missing);
    } catch (error) {
      if (signal.aborted) return;
      this.#fail(error);
    } finally {
      if (!signal.aborted) {
        this.#loading = undefined;
        clearTimeout(this.#silence);
      }
      player.requestUpdate();
    }
  }

  /** Starts the stall timer. */
  #listen(): void {
    clearTimeout(this.#silence);
    this.#silence = setTimeout(() => dispatch(this.#context.player, 'stalled'), STALLED_MS);
  }

  /** Reports the loaded share. */
  #hasCome(share: number): void {
    const { player } = this.#context;
    if (this.#loading === undefined) return;
    this.#loading.share = share;
    this.#listen();
    const now = performance.now();
    if (now - this.#toldMs > PROGRESS_MS) {
      this.#toldMs = now;
      dispatch(player, 'progress');
    }
    player.requestUpdate();
  }

  async #fetchAndOpen(signal: AbortSignal): Promise<{ opened: OpenedPicture; files: StoryFiles }> {
    const { player, diagnostics } = this.#context;
    const library = libraryOf(player);
    const progress = (share: number) => {
      if (!signal.aborted) this.#hasCome(share);
    };
    const ranking = player.backend ? Promise.resolve([player.backend] as const) : chooseBackends();
    const choosing = ranking.then(([best]) => best);
    void choosing.then(warmUp);
    const wish = await this.#wish(choosing);
    signal.throwIfAborted();
    const fetching = fetchStory(
      wish,
      library,
      (bytes) => decodeScript(choosing, bytes),
      (eml, part) => this.#figures.fetch(eml, choosing, { signal, progress: part }),
      signal,
      progress,
    );
    let [files, backends] = await Promise.all([fetching, ranking]);
    signal.throwIfAborted();
    const events = this.#pictureEvents(signal);
    const open = (figure: FigureFile) => this.#keeper.open(backends, (files = { ...files, figure }), events, signal);
    // A figure that the page sets is not replaced by the default one.
    const opened = await (player.figure ? open(files.figure) : openOrUsual(open, files.figure, library, signal, (d) => diagnostics.report(d)));
    return { opened, files };
  }

  /**
   * Returns the story to load: a text that replaces the story's file, otherwise that file, otherwise the content between the tags; for live lines, an empty
   * story.
   */
  async #wish(backend: Promise<Backend>): Promise<StoryRequest> {
    const { player, text, diagnostics } = this.#context;
    const { src, mind } = player;
    const wish = { src, text, edited: text !== undefined, language: languageAround(player), expectsLines: mind !== undefined, credentials: credentialsOf(player) };
    if (src || text !== undefined) return wish;
    const own = await this.#own.eml(wish.language, backend, (d) => diagnostics.report(d));
    if (own !== undefined) return { ...wish, text: own };
    if (this.#bare || mind) return { ...wish, text: EMPTY };
    throw new NoStoryError('No story is given: set the attribute src, or write one between the tags.');
  }

  #pictureEvents(signal: AbortSignal): PictureEvents {
    const { diagnostics } = this.#context;
    return {
      canvas: (canvas) => this.#setCanvas(canvas, signal),
      lost: (recovering) => this.#setLost(recovering ? 'recovering' : 'yes', signal),
      back: () => this.#setLost('no', signal),
      retold: (story, live, anew) => {
        if (signal.aborted) return;
        if (live) story.diagnostics.forEach((d) => diagnostics.report(d));
        else this.#retell(story, anew);
      },
      failed: (message) => diagnostics.report({ code: 'engine-failed', severity: 'error', message, hints: [] }),
    };
  }

  #open({ story, picture }: OpenedPicture, files: StoryFiles, sinceMs: number): void {
    const { player, diagnostics } = this.#context;
    const { voiceFolder, figure } = files;
    const script = new LiveScript(story.utterances);
    const voice = openVoice(script, { folder: voiceFolder, credentials: credentialsOf(player), device: player.sinkId }, (message, isSpeech) => {
      const { show } = this.#context;
      if (isSpeech && show !== undefined) show.unheard = true;
      diagnostics.report({ code: 'sound-missing', severity: 'warning', message, hints: [] });
    });
    const transport = new Transport(voice, story.durationSecs, (event) => this.#pass(event), player.playbackRate);
    const captions = captionsOf(story.utterances, languageOf(player, story));
    const show: Show = {
      story,
      figure: figure.name,
      choice: story.performer.figure,
      files,
      sinceMs,
      picture,
      voice,
      transport,
      script,
      captions,
      recorded: files.bundle,
      turn: new AbortController(),
      openEnded: this.#bare,
      unheard: voice instanceof SilentVoice,
      tellings: 0,
      end: new AbortController(),
    };
    this.#context.show = show;
    this.#context.questioner.take(story, 0);
    dispatch(player, 'durationchange');
    updateMusic(this.#context, show);
    this.#context.started = false;
    this.#events.opened(show);
    for (const diagnostic of [...story.diagnostics, ...figure.diagnostics]) diagnostics.report(diagnostic);
    this.giveVoice();
    player.requestUpdate();
    this.#context.drawn();
    dispatch(player, 'loadedmetadata', 'loadeddata', 'progress', 'canplay');
    this.#events.ready(show);
    this.#lingers = transport.waiting;
    if (!this.#lingers) dispatch(player, 'canplaythrough', 'suspend');
  }

  /** Forwards a transport event; a story that plays immediately is reported before `canplaythrough`. */
  #pass(event: TransportEvent): void {
    this.#events.transport(event);
    if (!this.#lingers || (event !== 'playing' && event !== 'pause')) return;
    this.#lingers = false;
    dispatch(this.#context.player, 'canplaythrough', 'suspend');
  }

  /** Replaces the text on stage by another; returns its problems. */
  async rehearse(eml: string, motion: number | undefined, roomy: boolean): Promise<readonly Diagnostic[]> {
    const context = this.#context;
    await context.player.updateComplete;
    const text = (context.text = String(eml));
    context.keepTime();
    this.#comeBack();
    const show = await this.require();
    // The latest text is loading already.
    if (text !== context.text || show !== context.show) return context.diagnostics.list;
    const story = show.picture.rehearse(text, motion, roomy);
    if (story === undefined) return [ABSENT];
    show.files = { ...show.files, eml: text };
    this.#retell(story, true);
    return story.diagnostics;
  }

  /** Updates derived data after the story or its times changed. */
  #retell(story: Story, anew: boolean): void {
    const { player, show, diagnostics, advance } = this.#context;
    if (show === undefined) return;
    show.story = story;
    this.#context.questioner.take(story, show.transport.position);
    const spoken = show.script.replace(story.utterances);
    show.captions = captionsOf(story.utterances, languageOf(player, story));
    show.transport.replace(story.durationSecs, spoken);
    updateMusic(this.#context, show);
    this.giveVoice();
    diagnostics.addStory(story.diagnostics, anew);
    dispatch(player, 'durationchange');
    if (player.paused) advance();
    if (!player.figure && story.performer.figure !== show.choice) void this.#figures.change(show).then(() => this.giveVoice());
    player.requestUpdate();
  }

  /** Starts the speech for utterances without a recording, if it is allowed. */
  giveVoice(): void {
    const { show } = this.#context;
    if (show !== undefined) void substituteVoice(this.#context, show, (story) => this.#retell(story, true));
  }

  #fail(error: unknown): void {
    const known = error instanceof PlayerError ? error : new PlayerError(error instanceof Error ? error.message : String(error), { cause: error });
    this.#error = known;
    dispatch(this.#context.player, 'error');
    this.#events.failed(known.message);
  }

  /** Unloads the story; the picture is kept for the next. */
  close(): void {
    const { player, diagnostics } = this.#context;
    // Unreported events belong to the story that is replaced.
    takeBack(player);
    const { network } = this;
    const isUnderWay = network === 'loading' || this.#waits;
    const hadStory = network !== 'empty' || this.#error !== undefined;
    this.#wanted?.abort();
    this.#loading = undefined;
    this.#waits = this.#lingers = false;
    clearTimeout(this.#silence);
    this.#figures.cancel();
    this.#context.show?.voice.close();
    this.#context.show?.end.abort();
    this.#context.show = undefined;
    this.#context.questioner.clear();
    this.#events.closed();
    this.#error = undefined;
    diagnostics.clear();
    this.#lost = 'no';
    this.#bare = false;
    this.#canvas = undefined;
    this.#context.keepTime();
    player.requestUpdate();
    if (isUnderWay || network === 'idle') dispatch(player, 'abort');
    if (hadStory) dispatch(player, 'emptied');
  }

  /** Releases the picture as well; the error is kept. */
  release(): void {
    if (this.#error === undefined) this.close();
    this.#keeper.close();
  }

  #setCanvas(canvas: HTMLCanvasElement, signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#canvas = canvas;
    this.#context.drawn();
    this.#context.player.requestUpdate();
  }

  #setLost(lost: 'no' | 'recovering' | 'yes', signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#lost = lost;
    if (lost !== 'no') this.#context.say(wordsFor(this.#context.player).pictureLost);
    this.#context.player.requestUpdate();
    this.#context.advance();
  }
}
