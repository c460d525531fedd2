/** Picture: an engine on a canvas, its size, and recovery from loss of the graphics device. */

import { applyView, PictureRequest } from './picture-request.js';
import { createEngine } from '../engine/backend.js';
import type { DonorHair } from '../face/face-look.js';
import { GivenFace } from '../face/given-face.js';
import { copyOf, newCanvas } from './canvas.js';
import type { FigureFile } from '../engine/figure.js';
import { FigureImages } from './figure-images.js';
import type { StoryFiles } from '../engine/loader.js';
import { giveBack } from './graphics.js';
import { FramePacer } from './frame-pacer.js';
import type { PictureEvents } from './picture-events.js';
import { StoryReader } from './story-reader.js';
import { isTrap, trapError } from '../engine/trap.js';
import { type Engine, TickStatus } from '../base/engine.js';
import type { FaceCourse, FaceSpot, FigureFace, NaturalHair } from '../base/face-types.js';
import type { Cue, InterruptionOutcome, Performance } from '../base/performance.js';
import {
  type Backend,
  type Diagnostic,
  type Light,
  type PictureStatistics,
  type Piece,
  PlayerError,
  type PoseNumbers,
  type Quality,
  type Story,
  type View,
  type EnvironmentExpression,
} from '../base/types.js';

/** Maximum device pixel ratio; higher ones cost time without a visible benefit. */
const MAX_DPR = 2;
/** Maximum number of automatic recoveries, the last one with the next back end; then a button offers it. */
const MAX_RECOVERIES = 2;
/** Delay before recovery: a reset graphics device is not available immediately. */
const RECOVERY_DELAY_MS = 600;

/** Owner of the engine of one player. A trap in it loses the picture, not the story. */
export class Picture {
  #backend: Backend;
  /** Alternative back ends, best first. */
  readonly #others: Backend[];
  #events: PictureEvents;
  #engine: Engine | undefined;
  #canvas: HTMLCanvasElement | undefined;
  #size = { width: 0, height: 0 };
  readonly #pace = new FramePacer();
  #recoveries = 0;
  #lost = false;
  #closed = false;
  /** Last shown time: a new engine continues from it, so that no cue is repeated. */
  #lastShown = 0;
  readonly #asked = new PictureRequest();
  readonly #given = new GivenFace();
  readonly #reader: StoryReader;
  readonly #images: FigureImages;
  /** Time of the first rendered frame, on the page's clock. */
  firstShownMs: number | undefined;

  private constructor([backend, ...others]: readonly [Backend, ...Backend[]], files: StoryFiles, events: PictureEvents) {
    this.#backend = backend;
    this.#others = others;
    this.#reader = new StoryReader(files, this.#asked, this.#given, (engine, live, followed) => this.#follow(engine, live, followed));
    this.#images = new FigureImages(this.#reader, this.#given, (engine) => engine === this.#engine);
    this.#events = events;
  }

  /** Opens a picture with the first available back end, and reads the story, even if no back end is available. */
  static async open(backends: readonly [Backend, ...Backend[]], files: StoryFiles, events: PictureEvents): Promise<{ picture: Picture; story: Story; missing: Diagnostic[] }> {
    const picture = new Picture(backends, files, events);
    do {
      try {
        return { picture, ...(await picture.#create()) };
      } catch (error) {
        // A figure that cannot be read is no better on another back end.
        if (error instanceof PlayerError && !isTrap(error)) throw error;
        console.warn(`raconteur: no picture from ${picture.#backend}`, error);
      }
    } while (picture.#stepDown());
    const engine = await createEngine(picture.#backend, undefined);
    const story = picture.#reader.read(engine);
    picture.#engine = engine;
    picture.#lost = true;
    events.lost(false);
    return { picture, story, missing: [] };
  }

  /**
   * Reads another story and reuses the device, the pipelines and, if it is the same one, the figure; undefined if the engine died. Throws, and may be called
   * again, if the figure cannot be read.
   */
  async replaceStory(files: StoryFiles, events: PictureEvents): Promise<{ story: Story; missing: Diagnostic[] } | undefined> {
    const engine = this.#engine;
    if (engine === undefined || this.#canvas === undefined) return undefined;
    const before = this.#reader.files.figure;
    const same = before.glb === files.figure.glb && before.name === files.figure.name;
    // Images may still be decoding: they belong to this figure.
    const told = same ? { ...files, figure: before } : files;
    this.#events = events;
    this.#asked.openEnded = false;
    let story: Story;
    try {
      story = this.#reader.read(engine, told, same);
      this.#reader.files = told;
      await told.animations.fetch(engine);
      story = this.#reader.animate(engine, story) ?? story;
    } catch (error) {
      if (!isTrap(error)) throw error;
      console.warn('raconteur: the engine failed', error);
      return undefined;
    }
    this.#restart(engine);
    events.canvas(this.#canvas);
    return { story, missing: await (same ? this.#images.missing : this.#images.decode(engine)) };
  }

  /** Switches to the next back end, if there is one. */
  #stepDown(): boolean {
    const next = this.#others.shift();
    if (next !== undefined) this.#backend = next;
    return next !== undefined;
  }

  /** Resets as if no frame had been shown. */
  #restart(engine: Engine): void {
    this.#lastShown = this.#recoveries = 0;
    this.firstShownMs = undefined;
    this.#pace.restart(engine);
    engine.seek(0);
  }

  /** Build in use. */
  get backend(): Backend {
    return this.#backend;
  }

  get lost(): boolean {
    return this.#lost;
  }

  /** Sets the rendering quality. */
  setQuality(quality: Quality): void {
    if (quality === this.#asked.quality) return;
    this.#asked.quality = quality;
    this.#guard((engine) => engine.setQuality(quality));
  }

  /** Shows the whole figure from another side. */
  look(view: View): void {
    this.#asked.view = view;
    this.#guard((engine) => applyView(engine, view));
  }

  /** Keeps hands and feet above captions that cover this share of the height at the lower edge; returns true if it changed. */
  setCaptions(share: number): boolean {
    if (share === this.#asked.captions) return false;
    this.#asked.captions = share;
    this.#guard((engine) => engine.setCaptions(share));
    return true;
  }

  /** Returns the course of the face between two times at a number of samples, and the phones of its mouth. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#guard((engine) => ({ curves: engine.faceCurves(from, to, count), segments: engine.segments(), names: engine.segmentNames() }));
  }

  /** Returns the music under the performance. */
  music(): readonly Piece[] {
    return this.#guard((engine) => engine.music()) ?? [];
  }

  /** Returns the expression of the emotion at a time by camera, light and music. */
  environmentExpression(secs: number): EnvironmentExpression | undefined {
    return this.#guard((engine) => engine.environmentExpression(secs));
  }

  /** Sets if the clock may pass the end of the story. */
  setOpenEnded(openEnded: boolean): void {
    if (openEnded === this.#asked.openEnded) return;
    this.#asked.openEnded = openEnded;
    this.#guard((engine) => engine.setOpenEnded(openEnded));
  }

  /** Gives the present figure another text; returns undefined while there is no engine: the next one reads the text. */
  rehearse(eml: string, motion: number | undefined, roomy: boolean): Story | undefined {
    this.#asked.motion = motion;
    this.#asked.roomy = roomy;
    this.#reader.files = { ...this.#reader.files, eml, edited: true };
    const story = this.#guard((engine) => this.#reader.reread(engine));
    this.seek(this.#lastShown);
    return story;
  }

  /** Gives the story another voice; returns undefined while there is no engine: the next one reads it. */
  voiced(bundle: Uint8Array): Story | undefined {
    this.#reader.files = { ...this.#reader.files, bundle };
    const story = this.#guard((engine) => (this.#reader.files.edited ? this.#reader.reread(engine) : this.#reader.read(engine, this.#reader.files, true)));
    this.seek(this.#lastShown);
    return story;
  }

  /** Returns the pose as numbers and names, for overlays of a page. */
  pose(): PoseNumbers | undefined {
    return this.#guard((engine) => ({ names: engine.poseNames(), numbers: engine.pose() }));
  }

  /** Adds the speech of later fragments. */
  updateBundle(bundle: Uint8Array): void {
    if (this.#guard((engine) => engine.updateBundle(bundle))) this.#reader.files = { ...this.#reader.files, bundle };
  }

  /** Performs a fragment of EML; undefined while there is no engine. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined {
    const performed = this.#guard((engine) => engine.perform(mind, fragment, nowSecs));
    this.#guard((engine) => this.#reader.animate(engine, undefined));
    return performed;
  }

  /** Interrupts the fragments; undefined if there are none. */
  interrupt(nowSecs: number): InterruptionOutcome | undefined {
    return this.#guard((engine) => engine.interrupt(nowSecs));
  }

  /** Statistics of the last frame; undefined without one. */
  get statistics(): PictureStatistics | undefined {
    return this.#lost ? undefined : this.#guard((engine) => engine.statistics());
  }

  /**
   * Replaces the figure. Throws, and keeps the previous one, if it cannot be read. Returns the story with this figure, and diagnostics about missing parts of
   * it.
   */
  async setFigure(figure: FigureFile): Promise<{ story: Story; missing: Diagnostic[] }> {
    const engine = this.#engine;
    if (engine === undefined) throw new PlayerError('The picture is lost, so the figure cannot be changed.');
    const files = { ...this.#reader.files, figure };
    let story: Story;
    // A new figure has its own face.
    const { face } = this.#given;
    this.#given.face = undefined;
    try {
      story = this.#reader.read(engine, files);
    } catch (error) {
      this.#given.face = face;
      // A trap may have left anything behind; an error has left everything as it was.
      if (isTrap(error)) {
        this.#engine = undefined;
        void this.recover();
      }
      throw error;
    }
    this.#reader.files = files;
    engine.seek(this.#lastShown);
    return { story, missing: await this.#images.decode(engine) };
  }

  /**
   * Gives the figure a face from a face model, or restores its own; `lent` are the files of figures that provide hair. Resolves when it can be rendered
   * completely.
   */
  async setFace(face: FigureFace | undefined, lent: DonorHair): Promise<void> {
    const before = this.#given.face;
    const engine = this.#engine;
    this.#given.face = face;
    this.#given.lent = lent;
    if (engine === undefined) return;
    try {
      if (face !== undefined) this.#given.apply(engine);
      else if (before !== undefined) this.#reader.read(engine);
    } catch (error) {
      this.#given.face = before;
      throw error;
    }
    this.seek(this.#lastShown);
    // The face of the figure is in its file, and its images are decoded again.
    if (face === undefined && before !== undefined) await this.#images.decode(engine);
    else await this.#images.paint(engine);
  }

  /** Returns a file of the figure with its face; undefined while it has its own. */
  async faceFile(name: string): Promise<Uint8Array | undefined> {
    return await this.#given.file(name, this.#reader.files.figure.glb);
  }

  /** Returns the skin point at a position of the image, −1 to 1 from the left and from below. */
  pickFace(x: number, y: number): FaceSpot | undefined {
    const numbers = this.#guard((engine) => engine.pickFace(x, y));
    if (numbers === undefined) return undefined;
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = numbers;
    return { corners: [a, b, c], shares: [d, e, f] };
  }

  /** Returns the natural colours of hair. */
  naturalHair(): readonly NaturalHair[] {
    return this.#guard((engine) => engine.naturalHair()) ?? [];
  }

  /** Lights the stage. */
  light(name: Light, turn: number): void {
    this.#asked.light = { name, turn };
    this.#guard((engine) => engine.setLight(name, turn));
  }

  /** Returns a copy of the canvas, if it was just rendered. */
  copy(): HTMLCanvasElement | undefined {
    return this.#canvas && copyOf(this.#canvas);
  }

  /** Sets the size of the canvas in CSS pixels. */
  resize(width: number, height: number): void {
    this.#size = { width, height };
    this.#guard((engine) => this.#fit(engine));
  }

  #fit(engine: Engine): void {
    const { width, height } = this.#size;
    if (width > 0) engine.resize(width, height, Math.min(MAX_DPR, window.devicePixelRatio || 1));
  }

  /** Moves without passing the cues between. */
  seek(secs: number): void {
    this.#lastShown = secs;
    this.#guard((engine) => engine.seek(secs));
  }

  /** Seeks like `seek`, with a fade from the waiting figure to the new position. */
  seekWithFade(secs: number): void {
    this.#lastShown = secs;
    this.#guard((engine) => engine.seekWithFade(secs));
  }

  /**
   * Shows a time and returns the cues passed on the way; while the story is paused they are retained for later. `running`: frames follow each other on screen.
   */
  show(secs: number, resting: boolean, running: boolean): Cue[] {
    return (
      this.#guard((engine) => {
        // Events passed while nothing is shown are reported with the next frame.
        if (this.#images.pending) return [];
        this.#lastShown = secs;
        // A face that changes is not a still frame.
        const isStill = resting && !this.#given.moves;
        this.#pace.rest(engine, isStill);
        this.#pace.keep(engine, running);
        this.#shown(engine.tick(secs));
        return resting ? [] : engine.drainEvents();
      }) ?? []
    );
  }

  /** Shows the figure waiting for playback, after a number of seconds. */
  showIdle(waitedSecs: number): void {
    this.#wait((engine) => engine.evaluateIdle(waitedSecs));
  }

  /** Shows the figure waiting for an answer while the story is paused, after a number of seconds, looking at a bone, or at the viewer. */
  showWaiting(secs: number, waitedSecs: number, lookedAt: string): void {
    this.#lastShown = secs;
    this.#wait((engine) => engine.evaluateWaiting(secs, waitedSecs, lookedAt));
  }

  #wait(draw: (engine: Engine) => number): void {
    this.#guard((engine) => {
      if (this.#images.pending) return;
      // Frames are few, so each has the time for full resolution.
      this.#pace.rest(engine, true);
      this.#pace.keep(engine, false);
      this.#shown(draw(engine));
    });
  }

  #shown(status: number): void {
    if (status === TickStatus.Lost && !this.#lost) void this.recover();
    if (status === TickStatus.Shown) this.firstShownMs ??= performance.now();
  }

  /** Tries to recover the picture; automatically only a limited number of times. */
  async recover(asked = false): Promise<void> {
    if (this.#closed || (this.#lost && !asked)) return;
    this.#lost = true;
    if (asked) this.#recoveries = 0;
    const again = this.#recoveries < MAX_RECOVERIES;
    this.#recoveries += 1;
    this.#events.lost(again);
    if (!again) return await this.#withoutPicture();
    await new Promise((done) => setTimeout(done, RECOVERY_DELAY_MS));
    if (this.#closed) return;
    try {
      const [old, canvas, backend] = [this.#engine, this.#canvas, this.#backend];
      if (this.#recoveries === MAX_RECOVERIES) this.#stepDown();
      await this.#create();
      if (old !== undefined) release(old);
      if (canvas !== undefined) giveBack(canvas, backend);
      if (this.#closed) return this.close();
      this.seek(this.#lastShown);
      this.#lost = false;
      this.#events.back();
    } catch (error) {
      console.warn('raconteur: the picture did not come back', error);
      this.#events.lost(false);
      await this.#withoutPicture();
    }
  }

  /** Opens an engine without a picture for the cues, after a trap of the last one. */
  async #withoutPicture(): Promise<void> {
    if (this.#engine !== undefined) return;
    try {
      const engine = await createEngine(this.#backend, undefined);
      this.#reader.read(engine);
      engine.seek(this.#lastShown);
      if (this.#closed) release(engine);
      else this.#engine = engine;
    } catch (error) {
      console.warn('raconteur: no cues', error);
    }
  }

  close(): void {
    this.#closed = true;
    this.#images.close();
    if (this.#engine !== undefined) release(this.#engine);
    this.#engine = undefined;
    const canvas = this.#canvas;
    // Its loss is no news now.
    this.#canvas = undefined;
    canvas?.remove();
    if (canvas !== undefined) giveBack(canvas, this.#backend);
  }

  async #create(): Promise<{ story: Story; missing: Diagnostic[] }> {
    const canvas = newCanvas(() => {
      if (canvas === this.#canvas) void this.recover();
    });
    this.#events.canvas(canvas);
    let engine: Engine | undefined;
    try {
      engine = await createEngine(this.#backend, canvas);
      let story = this.#reader.read(engine);
      // The first frame includes its animations if they load soon.
      await this.#reader.files.animations.fetch(engine);
      engine.setQuality(this.#asked.quality);
      this.#pace.pass(engine);
      const missing = await this.#images.decode(engine);
      story = this.#reader.animate(engine, story) ?? story;
      this.#engine = engine;
      this.#canvas = canvas;
      this.#fit(engine);
      return { story, missing };
    } catch (error) {
      if (engine !== undefined) release(engine);
      giveBack(canvas, this.#backend);
      throw error;
    }
  }

  /** Applies animations that arrive later. */
  #follow(engine: Engine, live: boolean, { animations, eml }: StoryFiles): void {
    void animations.next(engine)?.then(() => {
      if (engine !== this.#engine || eml !== this.#reader.files.eml || animations !== this.#reader.files.animations) return;
      // Additions to an edited text are present from its beginning; otherwise they ease in.
      const anew = this.#reader.files.edited === true && !live;
      const later = this.#guard(() => (anew ? this.#reader.reread(engine) : animations.provide(engine, eml)));
      if (anew) this.seek(this.#lastShown);
      else this.#follow(engine, live, this.#reader.files);
      if (later !== undefined) this.#events.retold(later, live, anew);
    });
  }

  /** Uses the engine; a trap leaves its memory suspect, so it is never used again. */
  #guard<T>(use: (engine: Engine) => T): T | undefined {
    const engine = this.#engine;
    if (engine === undefined) return undefined;
    try {
      return use(engine);
    } catch (error) {
      const failure = isTrap(error) ? trapError(engine, this.#reader.files, error) : error;
      console.error('raconteur: the engine failed', failure);
      this.#events.failed(failure instanceof Error ? failure.message : String(failure));
      this.#engine = undefined;
      void this.recover();
      return undefined;
    }
  }
}

/** Releases an engine's memory; one that trapped may fail. */
function release(engine: Engine): void {
  try {
    engine.free();
  } catch {
    // The instance is discarded in both cases.
  }
}
