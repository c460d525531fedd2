/** The page's state: the transcription with its undo list, the selection, the script made of it, and its problems. */

import { UndoStack } from '../undo.js';
import type { Annotations } from './annotate.js';
import { grip, type Grip, type Side } from './edges.js';
import { forget, remember, remembered, type Remembered } from './memory.js';
import type { Playback } from './playback.js';
import { annotationAt, endOf, spanOf, timeOf, tracksOf, type Span, type Track } from './tracks.js';
import { isSame, type Anchoring, type Item, type Lists, type Opened, type Problem, type Statistics, type Transcription } from './types.js';

/** Pause after a change before the figure performs it, ms. */
const PAUSE_MS = 150;
/** Time shown after the last annotation, seconds. */
const AFTER_SECS = 0.5;
/** Text on stage without an annotation. */
const EMPTY = '<eml><body><null time="600"/></body></eml>';

export class App {
  name = '';
  transcription: Transcription | undefined;
  tracks: readonly Track[] = [];
  selected: Item | undefined;
  /** Problems of the present transcription, and notes on what was filled in. */
  problems: readonly Problem[] = [];
  /** Problems of the file that the transcription no longer shows: what was lost. */
  lost: readonly Problem[] = [];
  statistics: Statistics | undefined;
  /** Words of the closed lists, once an annotation is open. */
  lists: Lists = { levels: [], classes: [], phases: [], dimensions: [], hands: [], viewpoints: [] };
  anchoring: Anchoring = 'words';
  /** The annotation that was closed last. */
  closed: Remembered | undefined;
  /** False once the browser could not store the annotation. */
  isStored = true;
  #undo = new UndoStack<Transcription | undefined>(undefined);
  #pause: ReturnType<typeof setTimeout> | undefined;
  #isPerforming = false;
  #isBehind = false;
  #drawing = 0;

  constructor(
    readonly annotations: Annotations,
    readonly playback: Playback,
    readonly draw: () => void,
    /** Called at each frame while something plays. */
    readonly keepUp: () => void,
  ) {}

  // --- files ---

  /** Opens a file. A file without annotations is not taken; its problems are returned. */
  async open(name: string, bytes: Uint8Array, mapping: string): Promise<readonly Problem[]> {
    const opened = await this.annotations.open(bytes, mapping);
    if (endOf(tracksOf(opened.transcription)) === 0) return opened.diagnostics;
    await this.#begin(name.replace(/\.\w+$/, ''), opened);
    return [];
  }

  /** Opens the annotation that was closed. */
  async reopen(): Promise<void> {
    const { closed } = this;
    if (closed !== undefined) await this.#begin(closed.name, { transcription: closed.transcription, text: '', diagnostics: [] });
  }

  /** Restores the annotation of the last visit, if there is one. */
  async restore(): Promise<void> {
    const last = remembered();
    this.#empty();
    try {
      if (last !== undefined) await this.#begin(last.name, { transcription: last.transcription, text: '', diagnostics: [] });
    } catch {
      // The reader was not fetched, or the data is of another version. It stays in the storage, in case that changes.
    }
  }

  async #begin(name: string, { transcription, diagnostics }: Opened): Promise<void> {
    const { diagnostics: now } = await this.annotations.toEml(transcription, 'seconds');
    this.lists = await this.annotations.lists();
    const isKnown = (problem: Problem): boolean => now.some((other) => other.code === problem.code && other.message === problem.message);
    this.name = name;
    this.lost = diagnostics.filter((problem) => !isKnown(problem));
    this.transcription = transcription;
    this.#undo = new UndoStack<Transcription | undefined>(transcription);
    this.selected = undefined;
    this.statistics = undefined;
    this.isStored = true;
    this.playback.secs = 0;
    this.#changed();
  }

  /** Puts the annotation away, and empties the stage. Until the page is left, `reopen` brings it back. */
  close(): void {
    forget();
    if (this.transcription !== undefined) this.closed = { name: this.name, transcription: this.transcription };
    this.#empty();
  }

  #empty(): void {
    clearTimeout(this.#pause);
    this.playback.pause();
    this.playback.player.rehearse(EMPTY).catch(() => undefined);
    this.transcription = undefined;
    this.tracks = [];
    this.problems = [];
    this.lost = [];
    this.selected = undefined;
    this.redraw();
  }

  // --- selection and time ---

  get span(): Span | undefined {
    return spanOf(this.tracks, this.selected);
  }

  /** Selects an annotation and shows its start. */
  select(item: Item | undefined): void {
    this.selected = item;
    const { span } = this;
    if (span !== undefined) this.playback.secs = span.start;
    this.redraw();
  }

  /** Length of the time axis, seconds. */
  get lengthSecs(): number {
    return Math.max(endOf(this.tracks) + AFTER_SECS, this.playback.recording === undefined ? 0 : this.playback.lengthSecs);
  }

  seek(secs: number): void {
    this.playback.secs = Math.min(this.lengthSecs, secs);
    this.redraw();
  }

  // --- changes ---

  get canUndo(): boolean {
    return this.#undo.canUndo;
  }

  get canRedo(): boolean {
    return this.#undo.canRedo;
  }

  undo(): void {
    this.#return(this.#undo.undo());
  }

  redo(): void {
    this.#return(this.#undo.redo());
  }

  #return(transcription: Transcription | undefined): void {
    if (transcription === undefined) return;
    this.transcription = transcription;
    this.#changed();
  }

  /** Takes hold of an edge; the returned grip moves it. */
  hold(item: Item, side: Side): Grip | undefined {
    const held = this.transcription && grip(this.transcription, item, side);
    return held && { move: (secs) => held.move(secs) && this.#changed() };
  }

  /** Moves an edge in one step of undo; returns its time. */
  moveEdge(item: Item, side: Side, secs: number): number | undefined {
    this.hold(item, side)?.move(secs);
    this.done();
    return this.transcription && timeOf(this.transcription, item, side);
  }

  /** Sets an attribute of an annotation, while a control changes it; undefined removes it. */
  set(item: Item, field: string, value: string | number | boolean | undefined): void {
    const annotation = this.transcription && annotationAt(this.transcription, item);
    if (annotation === undefined) return;
    Object.assign(annotation, { [field]: value });
    // What the file said about the annotation is no longer true of it.
    this.lost = this.lost.filter((problem) => problem.item === undefined || !isSame(problem.item, item));
    this.#changed();
  }

  /** Ends a change as one step of undo. */
  done(): void {
    if (this.transcription !== undefined && this.#undo.settle(this.transcription)) this.redraw();
  }

  #changed(): true {
    this.tracks = this.transcription === undefined ? [] : tracksOf(this.transcription);
    clearTimeout(this.#pause);
    this.#pause = setTimeout(() => void this.#perform(), PAUSE_MS);
    this.redraw();
    return true;
  }

  /** Lets the figure perform the transcription; while it reads one, only the latest waits. */
  async #perform(): Promise<void> {
    if (this.#isPerforming) {
      this.#isBehind = true;
      return;
    }
    this.#isPerforming = true;
    try {
      do {
        this.#isBehind = false;
        const { transcription } = this;
        if (transcription === undefined) break;
        // Seconds, since the recording has them; in which form the times are saved is another question.
        const { eml, diagnostics, firstGestureSecs } = await this.annotations.toEml(transcription, 'seconds');
        this.problems = diagnostics;
        this.statistics = await this.annotations.statistics(transcription);
        this.store();
        this.redraw();
        await this.playback.player.rehearse(eml);
        this.playback.setFirstGesture(firstGestureSecs);
      } while (this.#isBehind);
    } catch {
      // The player itself shows that it has no stage.
    } finally {
      this.#isPerforming = false;
      this.redraw();
    }
  }

  /** Stores the annotation for the next visit. */
  store(): void {
    const { name, transcription } = this;
    if (transcription !== undefined) this.isStored = remember({ name, transcription });
  }

  /** Redraws the page once before the next frame. */
  redraw(): void {
    if (this.#drawing !== 0) return;
    this.#drawing = requestAnimationFrame(() => {
      this.#drawing = 0;
      this.draw();
    });
  }

  /** Calls `keepUp` before each frame while something plays. */
  run(): void {
    this.playback.follow();
    if (!this.playback.paused) this.keepUp();
    requestAnimationFrame(() => this.run());
  }
}
