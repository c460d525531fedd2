/** `<raconteur-player>`: a storyteller on a page, used like a media element. */

import { unsafeCSS, type PropertyValues } from 'lit';
import { actionsOf } from './actions.js';
import { Arrival } from './story/arrival.js';
import { Away } from './story/away.js';
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
import { OwnText } from './story/own-text.js';
import { Playback } from './media/playback.js';
import { hasCaptions, statisticsOf } from './story/show.js';
import { StandIn } from './story/stand-in.js';
import { StoryLoader } from './story/story-loader.js';
import { telling } from './story/telling.js';
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
  type Telling,
  type View,
  type Words,
  type EnvironmentExpression,
} from './base/types.js';

/**
 * The custom element: a media element whose medium is a story that somebody performs. Attributes set properties; the player writes
 * none of its own, so that the markup stays as the page, or its server, wrote it. What it is to screen readers it tells by
 * `ElementInternals`, which an author's `role` and `aria-label` override.
 *
 * @tag raconteur-player
 * @cssprop --raconteur-accent - Of what is chosen, the played part of the time line and the ring of the focus
 * @cssprop --raconteur-control-color - Of signs and texts
 * @cssprop --raconteur-background - Behind the stage, and before there is a picture
 * @cssprop --raconteur-bar-background - Behind the controls
 * @cssprop --raconteur-radius - Of the corners
 * @cssprop --raconteur-caption-size - Of the letters of captions
 * @cssprop --raconteur-caption-color - Of captions
 * @cssprop --raconteur-caption-background - Behind captions
 * @cssprop --raconteur-caption-word - Of the word that is being said
 * @csspart stage - All that the picture takes
 * @csspart poster - The picture before the story is played
 * @csspart big-play - The button over the stage
 * @csspart controls - The bar below
 * @csspart button - Each button of it, and those that try again
 * @csspart play - Its button that plays and pauses
 * @csspart seek - Its time line
 * @csspart time - Its times
 * @csspart mute - Its button that mutes
 * @csspart volume - Its slider of loudness
 * @csspart speed - Its list of speeds
 * @csspart captions-button - Its button of captions
 * @csspart fullscreen - Its button of the whole screen
 * @csspart captions - The captions
 * @csspart caption-word - The word that is being said
 * @csspart question - The form of a question
 * @csspart option - What one may answer there
 * @csspart picture - Each picture there
 * @csspart submit - Its button
 * @csspart more - Its button that gives more time
 * @csspart feedback - What is read of an answer, in a form and while the story goes on
 * @csspart marker - Each mark of what may be pointed at
 * @csspart diagnostics - The list of `remarks`
 * @csspart error - What is shown where the story cannot be played
 * @csspart picture-lost - What is shown where the picture is lost
 * @csspart retry - The button that tries again
 */
// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the interface types the listeners of events that the class dispatches.
export class RaconteurPlayer extends PlayerAttributes {
  /** Where the asset library is when the attribute `assets` does not say: set by the script that a page names. */
  static library = 'assets/';
  /** What takes the keys is the frame within: it has the focus that the player is given by `focus()` or a click. */
  static override shadowRootOptions: ShadowRootInit = { ...PlayerAttributes.shadowRootOptions, delegatesFocus: true };
  static override styles = [unsafeCSS(look), unsafeCSS(questionLook)];

  /** What the element is by itself; there is none where a page is made without a browser. */
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
    tell: (event) => this.#mind.tell(event),
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
  readonly #standIn = new StandIn(this.#context);
  readonly #away = new Away(this, () => this.#stories.release());
  readonly #own = new OwnText(this, () => this.#arrival.changeOwn());
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
    // Controls that hold the keyboard's focus stay.
    () => this.paused || this.renderRoot.querySelector('.bar :focus-visible') !== null,
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

  /** Name of the figure on stage; differs from `figure` while that one is loading, and when it could not be used. */
  get currentFigure(): string | undefined {
    return this.#context.show?.figure;
  }

  /** Times, bytes and draw calls, once a picture was shown. */
  get statistics(): Statistics | undefined {
    const { show } = this.#context;
    return show && statisticsOf(show);
  }

  /** How camera, light and music express what is felt at the present moment (GEVH 3.5.4), once a story is loaded. */
  get expressed(): EnvironmentExpression | undefined {
    return this.#context.show?.picture.environmentExpression(this.currentTime);
  }

  /** Lets a file of the user's own perform, a `.glb` or `.vrm`; it stays on this machine. */
  useFigure(file: File): void {
    this.#figures.given = file;
    // The same name may stand for another file than before.
    const { show } = this.#context;
    if (show?.figure === file.name) show.figure = '';
    this.figure = file.name;
    this.requestUpdate('figure', '');
  }

  /** The build in use, once loaded. */
  get activeBackend(): Backend | undefined {
    return this.#context.show?.picture.backend;
  }

  /**
   * Performs EML now: a list of clauses, or a whole script, whose plain times count from now. Gives
   * accepted and refused clauses; rejects only when there is no stage. Where there is no story an empty stage is
   * opened, whose time has no end: a figure that waits for lines, and says them while the player plays. What speaks waits until nobody
   * else does, or with `interrupt` ends what fragments before it say and do.
   */
  async perform(fragment: string, { interrupt = false }: { readonly interrupt?: boolean } = {}): Promise<readonly Answer[]> {
    const show = await this.#stories.stage();
    if (interrupt) this.interrupt();
    return await perform(this.#context, show, Sender.Page, String(fragment));
  }

  /**
   * Gives the figure on stage a face of a face model, as `Faces` of `faces.js` makes it, or its own again
   * by `undefined`; what is played goes on. It goes with the figure: another one comes with its own. Resolves
   * when it is shown; rejects where there is no stage, or the figure's head is not the model's.
   */
  async setFace(face: FigureFace | undefined): Promise<void> {
    const { show, advance } = this.#context;
    if (show === undefined) throw new PlayerError('Nobody is on stage.');
    await show.picture.setFace(face, await this.#figures.lent(face));
    advance();
  }

  /** The place of the skin that is seen at a place of the window, once the figure has got a face; undefined beside the head. */
  pickFace(clientX: number, clientY: number): FaceSpot | undefined {
    const { left, top, width, height } = this.getBoundingClientRect();
    return this.#context.show?.picture.pickFace((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
  }

  /** The natural colours of hair, from dark to pale; empty while nobody is on stage. */
  naturalHair(): readonly NaturalHair[] {
    return this.#context.show?.picture.naturalHair() ?? [];
  }

  /** Lights the stage, the lamps turned about the figure to its left, radians. */
  light(name: Light, turn = 0): void {
    this.#context.show?.picture.light(name, turn);
    if (this.paused) this.#frames.advance();
  }

  /**
   * The figure with the face that `setFace` gave it, as a figure file for `figure` and `useFigure`; its voice and
   * body are those of the figure on stage. Rejects while that has its own face.
   */
  async figureFile(name: string): Promise<Blob> {
    const file = await this.#context.show?.picture.faceFile(name);
    if (file === undefined) throw new PlayerError('The figure on stage has its own face.');
    return new Blob([file as Uint8Array<ArrayBuffer>], { type: 'model/gltf-binary' });
  }

  /** A copy of the picture on stage, as large as it is drawn; with a `view` from there, as `look` has it. Undefined where there is none. */
  snapshot(view?: View): HTMLCanvasElement | undefined {
    if (view !== undefined) this.#view(view);
    this.#frames.advance();
    return this.#context.show?.picture.copy();
  }

  /**
   * Ends what fragments say and do, those that wait and texts of `tell` included; the story goes on. The
   * voice fades out, hands and face ease back. Something new may be performed at once.
   */
  interrupt(): void {
    const { show } = this.#context;
    if (show !== undefined) interrupt(this.#context, show);
  }

  /**
   * Says plain words that come piece by piece, for example from a language model: clause by clause, each as
   * soon as it is whole, with hands and feelings from its signs and small words. Says nothing while the
   * player is paused.
   */
  tell(words: Words): Telling {
    return telling(this.#context, this.#stories.stage(), words, () => this.interrupt());
  }

  /**
   * Puts another text in the place of the one on stage; figure, picture, time and whether it plays
   * stay. Works without `src`, too. What is wrong with the text is in the answer and in
   * `diagnostics`, the rest plays; rejects only when there is no stage. Live fragments end.
   * `motion` is the amount of idle life, 0 to 1, of this text and those that come later; the user's wish without.
   * The picture has room for every place that a hand may be brought to, for those who edit; `roomy: false` frames it as a story.
   */
  rehearse(eml: string, { motion, roomy = true }: { readonly motion?: number; readonly roomy?: boolean } = {}): Promise<readonly Diagnostic[]> {
    return this.#stories.rehearse(eml, motion, roomy);
  }

  /** The parts of the story that have titles, by time; they are chapters among its text tracks, too. */
  get chapters(): readonly Part[] {
    return this.#questioner.lesson.parts;
  }

  /** All that the story asks, by time. */
  get questions(): readonly Question[] {
    const all = this.#context.show?.story.questions ?? [];
    return all.filter((question) => this.#questioner.lesson.isDrawn(question));
  }

  /** What the story asks now, while it rests for that. */
  get question(): Question | undefined {
    return this.#questioner.lesson.asked;
  }

  /** Answers what is asked, as `QuestionKind` has it: by the names of options, or by what is written; undefined where nothing is, or where that is no answer. The story goes on once it is answered for good. */
  answer(...given: readonly string[]): Answered | undefined {
    return this.#questioner.answer(given);
  }

  /** Points so far, and the most that there are. */
  get score(): Score {
    return this.#questioner.lesson.score;
  }

  /** What not everybody comes to, from one second to another: what follows from answers, or under conditions, and what this learner was led over. */
  get optional(): readonly Span[] {
    return this.#questioner.lesson.optional;
  }

  /** Where the learner is and what they have answered, as data for `restore`: for pages that keep it themselves. */
  state(): PlayerState {
    return { placeSecs: this.currentTime, ...this.#questioner.lesson.state() };
  }

  /** Brings back what `state` told, once the story is there. What does not fit the story is left out. Without a place (`NaN`) the learner stays, and what they have done here is added to. */
  restore({ placeSecs, ...lesson }: PlayerState): void {
    const stays = !Number.isFinite(placeSecs);
    this.#questioner.restore(lesson, stays ? this.currentTime : undefined);
    if (!stays) this.currentTime = placeSecs;
    this.requestUpdate();
  }

  /** Shows the whole figure from another side, for pages that look behind the scenes. */
  look(view: View): void {
    this.#view(view);
    if (this.paused) this.#frames.advance();
  }

  #view(view: View): void {
    this.#context.view = view;
    this.#frames.keep();
    this.#context.show?.picture.look(view);
  }

  /** What a page needs to draw over the picture shown last; `readPose` of `pose.ts` decodes it. Undefined without a story. */
  pose(): PoseNumbers | undefined {
    return this.#context.show?.picture.pose();
  }

  /** What a page needs to draw how the face speaks from one time to another; `course.ts` decodes it. Undefined without a story. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#context.show?.picture.course(from, to, count);
  }

  /** Gives the keyboard's focus to the player, whose keys then work. */
  override focus(options?: FocusOptions): void {
    // What takes it is drawn a moment after the element was put into the page.
    if (this.isConnected && !this.hasUpdated) this.performUpdate();
    // The browser leaves the focus where it is in the player, as on a button that goes.
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
    // Moving an element disconnects it for a moment; one that stays away rests, as a video does.
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
    // While it plays the next frame comes by itself.
    if (this.paused) this.#frames.advance();
  }

  /** Has shots keep hands and feet above captions. */
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
