/** `<raconteur-player>`: a storyteller on a page, used like a media element. */

import { unsafeCSS, type PropertyValues } from 'lit';
import { actionsOf } from './actions.js';
import { Arrival } from './story/arrival.js';
import { VisibilityPause } from './story/visibility-pause.js';
import { FigureLoader } from './story/figure-loader.js';
import { fire, languageOf, libraryOf, wordsFor, type PlayerContext } from './story/context.js';
import { passTransport } from './story/cues.js';
import type { ElementEventMap, Listener } from './base/events.js';
import { Diagnostics } from './base/diagnostics.js';
import look from './element.css?inline';
import { interrupt, perform, Sender } from './story/fragments.js';
import { template } from './template.js';
import { CaptionRoom } from './captions/caption-room.js';
import { Idle } from './controls/idle.js';
import { handleKey } from './controls/keyboard.js';
import type { Parts } from './media-element.js';
import { PlayerAttributes } from './player-attributes.js';
import { after, dispatch } from './media/media-events.js';
import { MindConnection } from './mind/mind-connection.js';
import { soundOf } from './sound/outlet.js';
import { InlineStory } from './story/inline-story.js';
import { Playback } from './media/playback.js';
import { hasCaptions, statisticsOf } from './story/show.js';
import { FallbackFilm } from './story/fallback-film.js';
import { StoryLoader } from './story/story-loader.js';
import { startNarration } from './story/narration-handle.js';
import { reducesMotion, Surroundings } from './base/surroundings.js';
import { spare } from './base/fetching.js';
import type { Answered, Score } from './base/answers.js';
import questionLook from './lesson/question.css?inline';
import { Questioner } from './lesson/questioner.js';
import type { Span } from './base/ranges.js';
import type { Part } from './media/text-tracks.js';
import { FrameLoop } from './story/frame-loop.js';
import type { FaceCourse, FaceSpot, FigureFace, NaturalHair } from './base/face-types.js';
import type { Answer } from './base/performance.js';
import type { Question } from './base/questions.js';
import {
  PlayerError,
  type Backend,
  type Diagnostic,
  type Light,
  type PlayerState,
  type PoseNumbers,
  type Statistics,
  type NarrationHandle,
  type View,
  type Words,
  type EnvironmentExpression,
} from './base/types.js';

/**
 * The custom element: a media element whose medium is a story performed by a figure. Attributes set properties. The player
 * sets no attributes on itself, so the markup stays as the page, or its server, wrote it. `ElementInternals` exposes its
 * role and name to assistive technology; an author's `role` and `aria-label` override them.
 *
 * @tag raconteur-player
 * @cssprop --raconteur-accent - Colour of selections, the played part of the time line and the focus ring
 * @cssprop --raconteur-control-color - Colour of icons and text
 * @cssprop --raconteur-background - Background of the stage, also before the first frame
 * @cssprop --raconteur-bar-background - Background of the controls
 * @cssprop --raconteur-radius - Radius of the corners
 * @cssprop --raconteur-caption-size - Font size of captions
 * @cssprop --raconteur-caption-color - Colour of captions
 * @cssprop --raconteur-caption-background - Background of captions
 * @cssprop --raconteur-caption-word - Colour of the current word in captions
 * @csspart stage - The whole image area
 * @csspart poster - The image shown before playback
 * @csspart big-play - The play button over the stage
 * @csspart controls - The control bar
 * @csspart button - Each button of the control bar, and the retry buttons
 * @csspart play - The play and pause button
 * @csspart seek - The time line
 * @csspart time - Current time and duration
 * @csspart mute - The mute button
 * @csspart volume - The volume slider
 * @csspart speed - The list of speeds
 * @csspart captions-button - The captions button
 * @csspart captions-menu - The list of languages, where there is more than one
 * @csspart captions-choice - Each language of the list
 * @csspart fullscreen - The full-screen button
 * @csspart captions - The captions
 * @csspart caption-word - The current word in captions
 * @csspart question - The form of a question
 * @csspart option - Each answer option
 * @csspart picture - Each image of a question
 * @csspart submit - The submit button of a question
 * @csspart more - The button that gives more time
 * @csspart feedback - The feedback on an answer, in a form and while the story continues
 * @csspart marker - Each marker of a place that can be pointed at
 * @csspart diagnostics - The list of `remarks`
 * @csspart error - The message shown if the story cannot be played
 * @csspart picture-lost - The message shown if rendering fails
 * @csspart retry - The retry button
 */
// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the interface types the listeners of events that the class dispatches.
export class RaconteurPlayer extends PlayerAttributes {
  /** Address of the asset library without the attribute `assets`; set by the script that the page loads. */
  static library = 'assets/';
  /** The inner frame receives keys: `focus()` and clicks on the player move the focus there. */
  static override shadowRootOptions: ShadowRootInit = { ...PlayerAttributes.shadowRootOptions, delegatesFocus: true };
  static override styles = [unsafeCSS(look), unsafeCSS(questionLook)];

  /** Default semantics of the element; absent when a page is rendered without a browser. */
  readonly #internals = this.attachInternals?.() as ElementInternals | undefined;
  #announcement = '';
  readonly #captionRoom = new CaptionRoom(this);

  readonly #questioner = new Questioner(() => this.#context);
  readonly #diagnostics = new Diagnostics((diagnostic) => {
    fire(this, 'diagnostic', diagnostic);
    this.requestUpdate();
  });
  readonly #context: PlayerContext = {
    player: this,
    diagnostics: this.#diagnostics,
    show: undefined,
    text: undefined,
    view: undefined,
    started: false,
    onScreen: false,
    say: (text) => this.#say(text),
    notify: (event) => this.#mind.send(event),
    follow: () => this.#standIn.follow(),
    drawn: (secs) => this.follow(secs),
    advance: () => this.#frames.advance(),
    questioner: this.#questioner,
    isWatchedElsewhere: () => this.isWatchedElsewhere,
    keepTime: () => this.#frames.keep(),
  };
  readonly #playback = new Playback(
    soundOf(this),
    (event) => dispatch(this, event),
    () => void this.#stories.ensure(),
    (work) => after(this, work),
  );
  readonly #mind = new MindConnection(this.#context);
  readonly #frames = new FrameLoop(this.#context, this.#mind);
  readonly #figures = new FigureLoader(this.#context);
  readonly #standIn = new FallbackFilm(this.#context);
  readonly #away = new VisibilityPause(this, () => this.#stories.release());
  readonly #own = new InlineStory(this, () => this.#arrival.changeOwn());
  readonly #stories = new StoryLoader(this.#context, this.#figures, this.#own, {
    opened: () => this.#resize(),
    ready: (show) => {
      const kept = this.#away.take();
      if (kept !== undefined) this.#questioner.lesson.restore(kept);
      this.begin(languageOf(this, show.story), hasCaptions(this, show));
      this.#playback.attach(show.transport);
      void this.#mind.connect(show);
      this.#frames.keep();
      this.#frames.advance();
      if (this.autoplay && this.#playback.mayAutoplay && !reducesMotion()) {
        this.play().catch(() => this.#say(wordsFor(this).pressPlay));
      }
      this.#away.count();
    },
    failed: (message) => this.#playback.fail(message),
    closed: () => {
      this.#away.take();
      this.#mind.close();
      this.end();
      this.#playback.detach();
      this.#frames.clearCaption();
    },
    transport: (event) => {
      if (event === 'play' || event === 'pause') this.#idle.wake();
      if (event === 'play') this.#stories.giveVoice();
      passTransport(this.#context, event);
      this.#standIn.follow();
      if (event === 'playing') this.#playback.started();
      if (event === 'play' || event === 'seeking' || event === 'ended') this.capture(event !== 'ended');
      if (event === 'pause') this.#away.count();
    },
  });
  readonly #arrival = new Arrival(this.#context, this.#stories, this.#figures, () => this.renew());
  readonly #idle = new Idle(
    // Controls with keyboard focus or an open list stay visible.
    () => this.paused || this.renderRoot.querySelector('.bar :is(:focus-visible, [aria-expanded="true"])') !== null,
    () => this.requestUpdate(),
  );
  readonly #actions = actionsOf(this, this.#context);
  readonly #around = new Surroundings(
    () => this.#resize(),
    (isNear) => this.#arrival.appear(isNear),
  );

  constructor() {
    super();
    this.assets = RaconteurPlayer.library;
    if (this.#internals !== undefined) this.#internals.role = 'region';
    this.addEventListener('keydown', (event) => this.#onKey(event));
    for (const type of ['pointermove', 'pointerup', 'focusin']) this.addEventListener(type, () => this.#idle.wake());
    this.addEventListener('fullscreenchange', () => this.requestUpdate());
  }

  protected override get parts(): Parts {
    return { context: this.#context, playback: this.#playback, stories: this.#stories, lesson: this.#questioner.lesson };
  }

  protected override showCaptions(shown: boolean): void {
    if (this.#context.show !== undefined) this.#context.show.refusesCaptions = !shown;
    this.captions = shown;
    this.requestUpdate();
  }

  /** Problems of the story; the rest of it plays. */
  get diagnostics(): readonly Diagnostic[] {
    return this.#diagnostics.list;
  }

  /** Name of the figure on stage; differs from `figure` while that one is loading, and if it could not be used. */
  get currentFigure(): string | undefined {
    return this.#context.show?.figure;
  }

  /** Times, bytes and draw calls, once a frame has been shown. */
  get statistics(): Statistics | undefined {
    const { show } = this.#context;
    return show && statisticsOf(show);
  }

  /** Expression of the current emotion by camera, light and music (GEVH 3.5.4), once a story is loaded. */
  get expressed(): EnvironmentExpression | undefined {
    return this.#context.show?.picture.environmentExpression(this.currentTime);
  }

  /** Uses a file of the user, a `.glb` or `.vrm`, as the figure; it stays on this machine. */
  useFigure(file: File): void {
    this.#figures.given = file;
    // The same name may refer to another file than before.
    const { show } = this.#context;
    if (show?.figure === file.name) show.figure = '';
    this.figure = file.name;
    this.requestUpdate('figure', '');
  }

  /** The rendering back end in use, once loaded. */
  get activeBackend(): Backend | undefined {
    return this.#context.show?.picture.backend;
  }

  /**
   * Performs EML now: a list of clauses, or a whole script, whose plain times count from now. Returns accepted and refused clauses; rejects only if there is
   * no stage. Without a story, an empty stage of unlimited duration opens: the figure waits for lines, and speaks them while the player plays. A speaking
   * fragment waits until nobody else speaks, or with `interrupt` ends the speech and actions of earlier fragments.
   */
  async perform(fragment: string, { interrupt = false }: { readonly interrupt?: boolean } = {}): Promise<readonly Answer[]> {
    const show = await this.#stories.stage();
    if (interrupt) this.interrupt();
    return await perform(this.#context, show, Sender.Page, String(fragment));
  }

  /**
   * Gives the figure on stage a face of a face model, as made by `Faces` of `faces.js`, or with `undefined` its own again; playback continues. The face
   * belongs to the figure: another figure has its own. Resolves when the face is shown; rejects if there is no stage, or if the figure's head is not the
   * model's.
   */
  async setFace(face: FigureFace | undefined): Promise<void> {
    const { show, advance } = this.#context;
    if (show === undefined) throw new PlayerError('No figure is on stage.');
    await show.picture.setFace(face, await this.#figures.lent(face));
    advance();
  }

  /** Returns the position on the skin at a point of the viewport, once the figure has been given a face; undefined outside the head. */
  pickFace(clientX: number, clientY: number): FaceSpot | undefined {
    const { left, top, width, height } = this.getBoundingClientRect();
    return this.#context.show?.picture.pickFace((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
  }

  /** Returns the natural hair colours, from dark to pale; empty while no figure is on stage. */
  naturalHair(): readonly NaturalHair[] {
    return this.#context.show?.picture.naturalHair() ?? [];
  }

  /** Sets the lighting of the stage; `turn` rotates the lamps around the figure to its left, in radians. */
  light(name: Light, turn = 0): void {
    this.#context.show?.picture.light(name, turn);
    if (this.paused) this.#frames.advance();
  }

  /**
   * Returns the figure with the face set by `setFace`, as a figure file for `figure` and `useFigure`; voice and body are those of the figure on stage. Rejects
   * while the figure has its own face.
   */
  async figureFile(name: string): Promise<Blob> {
    const file = await this.#context.show?.picture.faceFile(name);
    if (file === undefined) throw new PlayerError('The figure on stage has its own face.');
    return new Blob([file as Uint8Array<ArrayBuffer>], { type: 'model/gltf-binary' });
  }

  /** Returns a copy of the image on stage at its rendered size; with a `view`, from there, as in `look`. Undefined if there is none. */
  snapshot(view?: View): HTMLCanvasElement | undefined {
    if (view !== undefined) this.#view(view);
    this.#frames.advance();
    return this.#context.show?.picture.copy();
  }

  /**
   * Ends the speech and actions of fragments, including waiting ones and texts of `tell`; the story continues. The voice fades out, hands and face ease back.
   * A new performance may start immediately.
   */
  interrupt(): void {
    const { show } = this.#context;
    if (show !== undefined) interrupt(this.#context, show);
  }

  /**
   * Speaks plain words that arrive piece by piece, for example from a language model: clause by clause, each as soon as it is complete, with gestures and
   * emotions derived from punctuation and function words. Speaks nothing while the player is paused.
   */
  tell(words: Words): NarrationHandle {
    return startNarration(this.#context, this.#stories.stage(), words, () => this.interrupt());
  }

  /**
   * Replaces the text on stage; figure, view, time and playback state stay. Also works without `src`. Problems of the text are in the result and in
   * `diagnostics`, and the rest plays; rejects only if there is no stage. Live fragments end. `motion` is the amount of idle motion, 0 to 1, of this and later
   * texts; by default the user's preference. The framing leaves space for every position that a hand may reach, for editors; `roomy: false` frames it as a
   * story.
   */
  rehearse(eml: string, { motion, roomy = true }: { readonly motion?: number; readonly roomy?: boolean } = {}): Promise<readonly Diagnostic[]> {
    return this.#stories.rehearse(eml, motion, roomy);
  }

  /** Titled parts of the story, by time; they are also chapters among its text tracks. */
  get chapters(): readonly Part[] {
    return this.#questioner.lesson.parts;
  }

  /** All questions of the story, by time. */
  get questions(): readonly Question[] {
    const all = this.#context.show?.story.questions ?? [];
    return all.filter((question) => this.#questioner.lesson.isDrawn(question));
  }

  /** The current question, while the story halts for it. */
  get question(): Question | undefined {
    return this.#questioner.lesson.asked;
  }

  /**
   * Answers the current question, as specified by `QuestionKind`: by the names of options, or by text. Returns undefined if there is no question, or if that
   * is no answer. The story continues once the question is answered for good.
   */
  answer(...given: readonly string[]): Answered | undefined {
    return this.#questioner.answer(given);
  }

  /** Points so far, and the maximum. */
  get score(): Score {
    return this.#questioner.lesson.score;
  }

  /** Spans, in seconds, that not every learner reaches: those that depend on answers or conditions, and those that this learner skipped. */
  get optional(): readonly Span[] {
    return this.#questioner.lesson.optional;
  }

  /** Returns the learner's position and answers as data for `restore`, for pages that store it themselves. */
  state(): PlayerState {
    return { placeSecs: this.currentTime, ...this.#questioner.lesson.state() };
  }

  /**
   * Restores data returned by `state`, once the story is loaded. Data that does not fit the story is left out. Without a position (`NaN`) the learner stays,
   * and the data is added to what they have done here.
   */
  restore({ placeSecs, ...lesson }: PlayerState): void {
    const stays = !Number.isFinite(placeSecs);
    this.#questioner.restore(lesson, stays ? this.currentTime : undefined);
    if (!stays) this.currentTime = placeSecs;
    this.requestUpdate();
  }

  /** Shows the whole figure from another side, for behind-the-scenes views. */
  look(view: View): void {
    this.#view(view);
    if (this.paused) this.#frames.advance();
  }

  #view(view: View): void {
    this.#context.view = view;
    this.#frames.keep();
    this.#context.show?.picture.look(view);
  }

  /** Returns the data for drawing over the last frame shown; `readPose` of `pose.ts` decodes it. Undefined without a story. */
  pose(): PoseNumbers | undefined {
    return this.#context.show?.picture.pose();
  }

  /** Returns the data for plotting the face's speech movements from one time to another; `course.ts` decodes it. Undefined without a story. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#context.show?.picture.course(from, to, count);
  }

  /** Moves the keyboard focus to the player, so its keys work. */
  override focus(options?: FocusOptions): void {
    // The control that receives the focus is rendered a moment after the element was inserted into
    // the page.
    if (this.isConnected && !this.hasUpdated) this.performUpdate();
    // The browser leaves the focus inside the player, for example on a button that is removed.
    const frame = this.renderRoot.querySelector<HTMLElement>('.frame');
    if (this.shadowRoot?.activeElement != null && frame !== null) frame.focus(options);
    else super.focus(options);
  }

  // --- life ---

  override connectedCallback(): void {
    super.connectedCallback();
    spare.library ??= libraryOf(this);
    this.#around.watch(this);
    this.#own.watch();
    this.#frames.keep();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#around.rest();
    this.#own.rest();
    // Moving an element disconnects it for a moment; an element that stays disconnected pauses, as
    // a video does.
    setTimeout(() => !this.isConnected && this.#playback.pause());
    this.#away.count();
  }

  protected override updated(): void {
    this.#captionRoom.follow();
    this.#makeRoom();
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has('mind') && this.#context.show !== undefined) void this.#mind.connect(this.#context.show);
    if (changed.has('src')) this.#context.text = undefined;
    if (changed.has('label') && this.#internals !== undefined) this.#internals.ariaLabel = this.label;
    this.#arrival.change(changed);
    this.#standIn.keep(this.#stories.lost === 'yes');
    this.#context.show?.voice.setVolume(this.muted ? 0 : this.volume);
    const { show } = this.#context;
    if (show === undefined) return;
    this.setCaptionsShown(hasCaptions(this, show));
    show.transport.loop = this.loop;
    show.transport.setRate(this.playbackRate);
    show.picture.setQuality(this.quality);
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#context.show?.picture.resize(clientWidth, clientHeight);
    this.follow();
    this.#captionRoom.measure();
    this.#makeRoom();
    // During playback the next frame comes automatically.
    if (this.paused) this.#frames.advance();
  }

  /** Makes shots keep hands and feet above captions. */
  #makeRoom(): void {
    const isNew = this.#context.show?.picture.setCaptions(this.#captionRoom.share);
    if (isNew && this.paused) this.#frames.advance();
  }

  // --- the user ---

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
    const { show, started } = this.#context;
    const state = { player: this, show, started, stories: this.#stories, idle: this.#idle, film: this.#standIn.video, questioner: this.#questioner, changing: this.#figures.busy };
    return template({ ...state, caption: this.#frames.caption, announcement: this.#announcement }, this.#actions);
  }
}

export interface RaconteurPlayer {
  addEventListener<K extends keyof ElementEventMap>(type: K, listener: Listener<this, K>, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject | null, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<K extends keyof ElementEventMap>(type: K, listener: Listener<this, K>, options?: boolean | EventListenerOptions): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject | null, options?: boolean | EventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    'raconteur-player': RaconteurPlayer;
  }
}
