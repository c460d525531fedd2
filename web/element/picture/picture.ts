/** The picture: an engine on a canvas, its size, and what happens when the graphics card goes away. */

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

/** More device pixels than this for a CSS pixel cost time and are not seen. */
const MAX_DPR = 2;
/** A lost picture is restored by itself this often, the last time by the next back end that may be used; then a button offers it. */
const MAX_RECOVERIES = 2;
/** A graphics card that was reset is not back at once. */
const RECOVERY_DELAY_MS = 600;

/** Owns the engine of one player. A trap in it costs the picture, not the story. */
export class Picture {
  #backend: Backend;
  /** Those that may be used instead, the best first. */
  readonly #others: Backend[];
  #events: PictureEvents;
  #engine: Engine | undefined;
  #canvas: HTMLCanvasElement | undefined;
  #size = { width: 0, height: 0 };
  readonly #pace = new FramePacer();
  #recoveries = 0;
  #lost = false;
  #closed = false;
  /** The moment shown last: a new engine goes on from there, so that no cue comes twice. */
  #lastShown = 0;
  readonly #asked = new PictureRequest();
  readonly #given = new GivenFace();
  readonly #reader: StoryReader;
  readonly #images: FigureImages;
  /** When the first picture was drawn, on the page's clock. */
  firstShownMs: number | undefined;

  private constructor([backend, ...others]: readonly [Backend, ...Backend[]], files: StoryFiles, events: PictureEvents) {
    this.#backend = backend;
    this.#others = others;
    this.#reader = new StoryReader(files, this.#asked, this.#given, (engine, live, followed) => this.#follow(engine, live, followed));
    this.#images = new FigureImages(this.#reader, this.#given, (engine) => engine === this.#engine);
    this.#events = events;
  }

  /**
   * Opens a picture with the first back end that gives one, and reads the story; the story is
   * read even where none does.
   */
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
   * Tells another story with the device, the pipelines and, if it is the same one, the figure that are
   * here; undefined when the engine died of it. Throws, and may be called again, when the figure cannot
   * be read.
   */
  async replaceStory(files: StoryFiles, events: PictureEvents): Promise<{ story: Story; missing: Diagnostic[] } | undefined> {
    const engine = this.#engine;
    if (engine === undefined || this.#canvas === undefined) return undefined;
    const before = this.#reader.files.figure;
    const same = before.glb === files.figure.glb && before.name === files.figure.name;
    // Its pictures may still be decoded: they are those of this very figure.
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

  /** Goes on with the next back end, if there is one. */
  #stepDown(): boolean {
    const next = this.#others.shift();
    if (next !== undefined) this.#backend = next;
    return next !== undefined;
  }

  /** As if nothing had been shown yet. */
  #restart(engine: Engine): void {
    this.#lastShown = this.#recoveries = 0;
    this.firstShownMs = undefined;
    this.#pace.restart(engine);
    engine.seek(0);
  }

  /** The build in use. */
  get backend(): Backend {
    return this.#backend;
  }

  get lost(): boolean {
    return this.#lost;
  }

  /** How much work goes into a picture. */
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

  /** Keeps hands and feet above captions that take this share of the height at the lower edge; whether that is new. */
  setCaptions(share: number): boolean {
    if (share === this.#asked.captions) return false;
    this.#asked.captions = share;
    this.#guard((engine) => engine.setCaptions(share));
    return true;
  }

  /** What the face does from one time to another, at so many times, and what its mouth goes through. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#guard((engine) => ({ curves: engine.faceCurves(from, to, count), segments: engine.segments(), names: engine.segmentNames() }));
  }

  /** The music under the performance. */
  music(): readonly Piece[] {
    return this.#guard((engine) => engine.music()) ?? [];
  }

  /** How camera, light and music express what is felt at a time. */
  environmentExpression(secs: number): EnvironmentExpression | undefined {
    return this.#guard((engine) => engine.environmentExpression(secs));
  }

  /** The clock may pass the end of the story. */
  setOpenEnded(openEnded: boolean): void {
    if (openEnded === this.#asked.openEnded) return;
    this.#asked.openEnded = openEnded;
    this.#guard((engine) => engine.setOpenEnded(openEnded));
  }

  /** Another text for the present figure; undefined while there is no engine: the next one reads it. */
  rehearse(eml: string, motion: number | undefined, roomy: boolean): Story | undefined {
    this.#asked.motion = motion;
    this.#asked.roomy = roomy;
    this.#reader.files = { ...this.#reader.files, eml, edited: true };
    const story = this.#guard((engine) => this.#reader.reread(engine));
    this.seek(this.#lastShown);
    return story;
  }

  /** The story with another voice; undefined while there is no engine: the next one reads it. */
  voiced(bundle: Uint8Array): Story | undefined {
    this.#reader.files = { ...this.#reader.files, bundle };
    const story = this.#guard((engine) => (this.#reader.files.edited ? this.#reader.reread(engine) : this.#reader.read(engine, this.#reader.files, true)));
    this.seek(this.#lastShown);
    return story;
  }

  /** What a page needs to draw over the picture, as numbers, and their names. */
  pose(): PoseNumbers | undefined {
    return this.#guard((engine) => ({ names: engine.poseNames(), numbers: engine.pose() }));
  }

  /** Takes the speech of fragments that will come. */
  updateBundle(bundle: Uint8Array): void {
    if (this.#guard((engine) => engine.updateBundle(bundle))) this.#reader.files = { ...this.#reader.files, bundle };
  }

  /** Performs a fragment of EML; undefined while there is no engine. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined {
    const performed = this.#guard((engine) => engine.perform(mind, fragment, nowSecs));
    this.#guard((engine) => this.#reader.animate(engine, undefined));
    return performed;
  }

  /** Ends what fragments say and do; undefined where there is nothing to end. */
  interrupt(nowSecs: number): InterruptionOutcome | undefined {
    return this.#guard((engine) => engine.interrupt(nowSecs));
  }

  /** What the last picture took; undefined without one. */
  get statistics(): PictureStatistics | undefined {
    return this.#lost ? undefined : this.#guard((engine) => engine.statistics());
  }

  /**
   * Puts another figure in the place of the one that is shown. Throws, and keeps the one before,
   * when it cannot be read. Gives the story as this figure tells it, and what of the figure is missing.
   */
  async setFigure(figure: FigureFile): Promise<{ story: Story; missing: Diagnostic[] }> {
    const engine = this.#engine;
    if (engine === undefined) throw new PlayerError('The picture is lost, so the figure cannot be changed.');
    const files = { ...this.#reader.files, figure };
    let story: Story;
    // Who comes has a face of its own.
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

  /** Gives the figure a face of a face model, or its own again; `lent` are the files of figures that lend it hair. Resolves when that can be drawn as it is. */
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
    // Its own face is in its file, and comes with pictures anew.
    if (face === undefined && before !== undefined) await this.#images.decode(engine);
    else await this.#images.paint(engine);
  }

  /** A file of the figure with its face; undefined while it has its own. */
  async faceFile(name: string): Promise<Uint8Array | undefined> {
    return await this.#given.file(name, this.#reader.files.figure.glb);
  }

  /** The place of the skin that is seen at a place of the picture, −1 to 1 from the left and from below. */
  pickFace(x: number, y: number): FaceSpot | undefined {
    const numbers = this.#guard((engine) => engine.pickFace(x, y));
    if (numbers === undefined) return undefined;
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = numbers;
    return { corners: [a, b, c], shares: [d, e, f] };
  }

  /** The natural colours of hair. */
  naturalHair(): readonly NaturalHair[] {
    return this.#guard((engine) => engine.naturalHair()) ?? [];
  }

  /** Lights the stage. */
  light(name: Light, turn: number): void {
    this.#asked.light = { name, turn };
    this.#guard((engine) => engine.setLight(name, turn));
  }

  /** What the canvas shows, if it was drawn just now. */
  copy(): HTMLCanvasElement | undefined {
    return this.#canvas && copyOf(this.#canvas);
  }

  /** Size of the canvas in CSS pixels. */
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

  /** As `seek`, but what the figure does as it waits fades into what follows. */
  seekWithFade(secs: number): void {
    this.#lastShown = secs;
    this.#guard((engine) => engine.seekWithFade(secs));
  }

  /**
   * Shows a moment and gives the cues passed on the way to it; while the story rests they are
   * kept for later. `running`: pictures follow each other on screen.
   */
  show(secs: number, resting: boolean, running: boolean): Cue[] {
    return (
      this.#guard((engine) => {
        // What is passed while nothing is shown is told of with the next picture.
        if (this.#images.pending) return [];
        this.#lastShown = secs;
        // A face that changes is no picture that stands still.
        const isStill = resting && !this.#given.moves;
        this.#pace.rest(engine, isStill);
        this.#pace.keep(engine, running);
        this.#shown(engine.tick(secs));
        return resting ? [] : engine.drainEvents();
      }) ?? []
    );
  }

  /** Shows how the figure waits for the story to be played, since so many seconds. */
  showIdle(waitedSecs: number): void {
    this.#wait((engine) => engine.evaluateIdle(waitedSecs));
  }

  /** Shows how the figure waits for an answer where the story rests, since so many seconds, and looks at a bone, or at the viewer. */
  showWaiting(secs: number, waitedSecs: number, lookedAt: string): void {
    this.#lastShown = secs;
    this.#wait((engine) => engine.evaluateWaiting(secs, waitedSecs, lookedAt));
  }

  #wait(draw: (engine: Engine) => number): void {
    this.#guard((engine) => {
      if (this.#images.pending) return;
      // Few pictures, so each has the time for every pixel.
      this.#pace.rest(engine, true);
      this.#pace.keep(engine, false);
      this.#shown(draw(engine));
    });
  }

  #shown(status: number): void {
    if (status === TickStatus.Lost && !this.#lost) void this.recover();
    if (status === TickStatus.Shown) this.firstShownMs ??= performance.now();
  }

  /** Tries to bring the picture back; by itself only so often. */
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

  /** Where the last engine died of its trap, one without a picture still tells the cues. */
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
      // The first picture has its animations, if they come soon.
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

  /** Takes animations that come later. */
  #follow(engine: Engine, live: boolean, { animations, eml }: StoryFiles): void {
    void animations.next(engine)?.then(() => {
      if (engine !== this.#engine || eml !== this.#reader.files.eml || animations !== this.#reader.files.animations) return;
      // What comes to a text that is edited is there from its beginning; else it eases in.
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

/** Gives an engine's memory back; one that trapped may refuse. */
function release(engine: Engine): void {
  try {
    engine.free();
  } catch {
    // Its instance is garbage either way.
  }
}
