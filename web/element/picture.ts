/** The picture: an engine on a canvas, its size, and what happens when the graphics card goes away. */

import { createEngine, joinPart, type Part } from './backend.js';
import { showImages, unusable, type FigureFile } from './figure.js';
import type { StoryFiles } from './loader.js';
import { PlayerError, TickStatus, type Backend, type Cue, type Diagnostic, type Engine, type FaceCourse, type Performance, type PictureStatistics, type Piece, type Quality, type Story, type View } from './types.js';

/** More device pixels than this for a CSS pixel cost time and are not seen. */
const MOST_DPR = 2;
/** Idle life for people who ask for less motion; gestures and lips stay, they carry the story. */
const REDUCED_MOTION = 0.25;
/** A lost picture is brought back by itself this often; then the user is asked. */
const MOST_RECOVERIES = 2;
/** A graphics card that was reset is not back at once. */
const RECOVERY_DELAY_MS = 600;

/** What a picture tells its element. */
export interface PictureEvents {
  /** A canvas to show in place of the last one. */
  canvas(canvas: HTMLCanvasElement): void;
  /** The picture went away; sound and captions go on. `recovering`: it is being brought back. */
  lost(recovering: boolean): void;
  /** The picture is back. */
  back(): void;
  /** Animations have come: the story has other times, and problems that are told alone. `live`: they are of live clauses, the story stays. `anew`: the story was read again, and tells all of its problems. */
  retold(story: Story, live: boolean, anew: boolean): void;
}

/** Owns the engine of one player. A trap in it costs the picture, not the story. */
export class Picture {
  #backend: Backend;
  #files: StoryFiles;
  readonly #events: PictureEvents;
  #engine: Engine | undefined;
  #canvas: HTMLCanvasElement | undefined;
  #size = { width: 0, height: 0 };
  /** When the last picture of a running sequence was asked for. */
  #lastAsked = 0;
  #resting = true;
  #recoveries = 0;
  #lost = false;
  #closed = false;
  /** The moment shown last: a new engine goes on from there, so that no cue comes twice. */
  #lastShown = 0;
  /** A figure's pictures are still being decoded: the canvas keeps what it shows. */
  #holding = false;
  #quality: Quality = 'auto';
  #view: View | undefined;
  #openEnded = false;
  /** Whatever comes will find its code. */
  #equipped = false;
  /** When the first picture was drawn, on the page's clock. */
  firstShownMs: number | undefined;

  private constructor(backend: Backend, files: StoryFiles, events: PictureEvents) {
    this.#backend = backend;
    this.#files = files;
    this.#events = events;
  }

  /**
   * Opens a picture with the first back end that gives one, and reads the story; the story is
   * read even where none does.
   */
  static async open(
    backends: readonly [Backend, ...Backend[]],
    files: StoryFiles,
    events: PictureEvents,
  ): Promise<{ picture: Picture; story: Story; missing: Diagnostic[] }> {
    const picture = new Picture(backends[0], files, events);
    for (const backend of backends) {
      picture.#backend = backend;
      try {
        return { picture, ...(await picture.#create()) };
      } catch (error) {
        // A figure that cannot be read is no better on another back end.
        if (error instanceof PlayerError && !trapped(error)) throw error;
        console.warn(`raconteur: no picture from ${backend}`, error);
      }
    }
    const engine = await picture.#engineOn(undefined);
    const story = picture.#read(engine);
    picture.#engine = engine;
    picture.#lost = true;
    events.lost(false);
    return { picture, story, missing: [] };
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
    if (quality === this.#quality) return;
    this.#quality = quality;
    this.#guard((engine) => engine.setQuality(quality));
  }

  /** Shows the whole figure from another side. */
  look(view: View): void {
    this.#view = view;
    this.#guard((engine) => applyView(engine, view));
  }

  /** What the face does from one time to another, at so many times, and what its mouth goes through. */
  course(from: number, to: number, count: number): FaceCourse | undefined {
    return this.#guard((engine) => ({ curves: engine.faceCurves(from, to, count), segments: engine.segments(), names: engine.segmentNames() }));
  }

  /** The music under what is performed. */
  music(): readonly Piece[] {
    return this.#guard((engine) => engine.music()) ?? [];
  }

  /** The clock may pass the end of the story. */
  setOpenEnded(openEnded: boolean): void {
    if (openEnded === this.#openEnded) return;
    this.#openEnded = openEnded;
    this.#guard((engine) => engine.setOpenEnded(openEnded));
  }

  /** Fetches the code that a text asks for, or without one, that any may; call it before. */
  async equip(eml?: string): Promise<void> {
    this.#equipped ||= eml === undefined;
    const engine = this.#engine;
    if (engine !== undefined) await this.#equip(engine, eml);
  }

  async #equip(engine: Engine, eml: string | undefined): Promise<void> {
    if (this.#equipped || (eml !== undefined && engine.lacksMore(eml))) await this.#join(engine, 'more');
  }

  async #join(engine: Engine, part: Part): Promise<void> {
    try {
      await joinPart(engine, part);
    } catch (error) {
      // The engine tells what it leaves out.
      console.warn(`raconteur: no ${part}`, error);
    }
  }

  /** A fresh engine that has the code for the story. */
  async #engineOn(canvas: HTMLCanvasElement | undefined): Promise<Engine> {
    const engine = await createEngine(this.#backend, canvas);
    await Promise.all([this.#join(engine, 'face'), this.#equip(engine, this.#files.eml)]);
    return engine;
  }

  /** Another text for the figure on stage; undefined while there is nobody to read it, who comes back with it. */
  rehearse(eml: string): Story | undefined {
    this.#files = { ...this.#files, eml, edited: true };
    const story = this.#guard((engine) => this.#reread(engine, this.#files));
    this.seek(this.#lastShown);
    return story;
  }

  /** What a page needs to draw over the picture, as numbers, and their names. */
  pose(): { names: readonly string[]; numbers: Float32Array } | undefined {
    return this.#guard((engine) => ({ names: engine.poseNames(), numbers: engine.pose() }));
  }

  /** Performs a fragment of EML; undefined while there is nobody to do it. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined {
    const performed = this.#guard((engine) => engine.perform(mind, fragment, nowSecs));
    this.#guard((engine) => this.#animate(engine, undefined));
    return performed;
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
    const files = { ...this.#files, figure };
    let story: Story;
    try {
      story = this.#read(engine, files);
    } catch (error) {
      // A trap may have left anything behind; an error has left everything as it was.
      if (trapped(error)) {
        this.#engine = undefined;
        void this.recover();
      }
      throw error;
    }
    this.#files = files;
    engine.seek(this.#lastShown);
    return { story, missing: await this.#decode(engine) };
  }

  /** The canvas keeps its last picture until those of the figure are decoded: a face without its skin is not shown. */
  async #decode(engine: Engine): Promise<Diagnostic[]> {
    const figure = this.#files.figure;
    const current = () => figure === this.#files.figure && !this.#closed;
    this.#holding = true;
    const missing = await showImages(engine, current);
    // The pictures of a later figure may still be decoded; it lifts the hold itself.
    if (current()) this.#holding = false;
    return missing;
  }

  /** Size of the canvas in CSS pixels. */
  resize(width: number, height: number): void {
    this.#size = { width, height };
    this.#guard((engine) => this.#fit(engine));
  }

  #fit(engine: Engine): void {
    const { width, height } = this.#size;
    if (width > 0) engine.resize(width, height, Math.min(MOST_DPR, window.devicePixelRatio || 1));
  }

  /** Tells the engine how fast pictures come while the story plays on screen; it draws more simply where they are slow. */
  #keepPace(engine: Engine, running: boolean): void {
    const now = performance.now();
    if (running && this.#lastAsked > 0) engine.reportFrame(now - this.#lastAsked);
    this.#lastAsked = running ? now : 0;
  }

  /** Moves without passing the cues between. */
  seek(secs: number): void {
    this.#lastShown = secs;
    this.#guard((engine) => engine.seek(secs));
  }

  /**
   * Shows a moment and gives the cues passed on the way to it; while the story rests they are
   * kept for later. `running`: pictures follow each other on screen.
   */
  show(secs: number, resting: boolean, running: boolean): Cue[] {
    this.#lastShown = secs;
    return (
      this.#guard((engine) => {
        if (this.#holding) return [];
        if (resting !== this.#resting) engine.setResting((this.#resting = resting));
        this.#keepPace(engine, running);
        this.#shown(engine.tick(secs));
        return resting ? [] : engine.drainEvents();
      }) ?? []
    );
  }

  /** Shows how the figure waits for the story to be played, since so many seconds. */
  welcome(waitedSecs: number): void {
    this.#guard((engine) => {
      if (this.#holding) return;
      // Few pictures, so each has the time for every pixel.
      if (!this.#resting) engine.setResting((this.#resting = true));
      this.#keepPace(engine, false);
      this.#shown(engine.welcome(waitedSecs));
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
    const again = this.#recoveries < MOST_RECOVERIES;
    this.#recoveries += 1;
    this.#events.lost(again);
    if (!again) return await this.#withoutPicture();
    await new Promise((done) => setTimeout(done, RECOVERY_DELAY_MS));
    if (this.#closed) return;
    try {
      const old = this.#engine;
      await this.#create();
      if (old !== undefined) release(old);
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
      const engine = await this.#engineOn(undefined);
      this.#read(engine);
      engine.seek(this.#lastShown);
      if (this.#closed) release(engine);
      else this.#engine = engine;
    } catch (error) {
      console.warn('raconteur: no cues', error);
    }
  }

  close(): void {
    this.#closed = true;
    if (this.#engine !== undefined) release(this.#engine);
    this.#engine = undefined;
    this.#canvas?.remove();
    this.#canvas = undefined;
  }

  /** A lost canvas keeps its dead context, so each try has a canvas of its own. */
  async #create(): Promise<{ story: Story; missing: Diagnostic[] }> {
    const canvas = document.createElement('canvas');
    canvas.setAttribute('aria-hidden', 'true');
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      if (canvas === this.#canvas) void this.recover();
    });
    this.#events.canvas(canvas);
    const engine = await this.#engineOn(canvas);
    let story = this.#read(engine);
    // Nobody is seen waiting for an animation.
    await this.#files.animations.fetch(engine);
    story = this.#animate(engine, story) ?? story;
    engine.setQuality(this.#quality);
    engine.setResting(this.#resting);
    const missing = await this.#decode(engine);
    this.#engine = engine;
    this.#canvas = canvas;
    this.#fit(engine);
    return { story, missing };
  }

  #read(engine: Engine, files = this.#files): Story {
    const { eml, bundle, figure, edited } = files;
    applyView(engine, this.#view);
    try {
      const story = engine.load(eml, bundle, figure.name, figure.glb, motionAmount());
      engine.setOpenEnded(this.#openEnded);
      // An edited text is shown with room for what it may become.
      return edited ? this.#reread(engine, files) : (this.#animate(engine, story) ?? story);
    } catch (error) {
      throw unusable(figure.where, error);
    }
  }

  #reread(engine: Engine, { eml, bundle }: StoryFiles): Story {
    const story = engine.rehearse(eml, bundle, motionAmount());
    if (story === undefined) throw new PlayerError('Nobody is on stage.');
    engine.setOpenEnded(this.#openEnded);
    return this.#animate(engine, story) ?? story;
  }

  /** Hands the engine the animations that have come, and when the others come, those; without a `story` they are of live clauses. The story with its new times, and with what is wrong with them. */
  #animate(engine: Engine, story: Story | undefined): Story | undefined {
    const { animations, eml } = this.#files;
    const told = animations.provide(engine, eml);
    void animations.fetch(engine)?.then(() => {
      if (engine !== this.#engine || eml !== this.#files.eml) return;
      const live = story === undefined;
      // What comes to a text that is edited is there from its beginning; else it eases in.
      const anew = this.#files.edited === true && !live;
      const later = this.#guard(() => (anew ? this.#reread(engine, this.#files) : animations.provide(engine, eml)));
      if (anew) this.seek(this.#lastShown);
      if (later !== undefined) this.#events.retold(later, live, anew);
    });
    if (told === undefined || story === undefined) return story;
    return { ...told, diagnostics: [...story.diagnostics, ...told.diagnostics] };
  }

  /** Uses the engine; a trap leaves its memory suspect, so it is never used again. */
  #guard<T>(use: (engine: Engine) => T): T | undefined {
    const engine = this.#engine;
    if (engine === undefined) return undefined;
    try {
      return use(engine);
    } catch (error) {
      console.error('raconteur: the engine failed', error);
      this.#engine = undefined;
      void this.recover();
      return undefined;
    }
  }
}

function applyView(engine: Engine, view: View | undefined): void {
  if (view !== undefined) engine.setView(view.turn, view.tilt, view.zoom, view.right, view.up);
}

/** How much idle life. */
const motionAmount = (): number => (matchMedia('(prefers-reduced-motion: reduce)').matches ? REDUCED_MOTION : 1);

/** Whether an engine died of what it was asked. */
function trapped(error: unknown): boolean {
  return error instanceof Error && error.cause instanceof WebAssembly.RuntimeError;
}

/** Gives an engine's memory back; one that trapped may refuse. */
function release(engine: Engine): void {
  try {
    engine.free();
  } catch {
    // Its instance is garbage either way.
  }
}
