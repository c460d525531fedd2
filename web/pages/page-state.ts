/** State of a page with settings written as EML: controls, the resulting text, and the resulting picture. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Diagnostic } from '../element/base/types.js';
import { UndoStack } from './undo.js';

/** Time by which all settings have taken effect: limbs and faces have reached their targets. */
export const SETTLED_SECS = 2;

export abstract class PageState<S extends object> {
  state: S;
  /** The text that the settings make. */
  eml: string;
  diagnostics: readonly Diagnostic[] = [];
  readonly #undo: UndoStack<S>;
  #reading = false;
  #behind = false;
  #drawn = 0;

  constructor(
    readonly player: RaconteurPlayer,
    readonly beginning: () => S,
    write: (state: S) => string,
  ) {
    this.state = beginning();
    this.eml = write(this.state);
    this.#undo = new UndoStack(this.state);
  }

  /** Updates the state from the current settings; returns the text. */
  protected abstract follow(): string;

  /** Draws the page. */
  protected abstract draw(): void;

  /** Called after the text was read, or could not be read. */
  protected read(): void {}

  /** True if a still picture shows the final result of the settings. */
  protected get showsEnd(): boolean {
    return true;
  }

  /** Changes a setting while a control moves. */
  change(edit: (state: S) => void): void {
    edit(this.state);
    this.update();
  }

  /** Completes a control's movement as one step of undo. */
  done(): void {
    if (this.#undo.settle(this.state)) this.redraw();
  }

  /** Changes a setting immediately. */
  set(edit: (state: S) => void): void {
    this.change(edit);
    this.done();
  }

  get canUndo(): boolean {
    return this.#undo.canUndo;
  }

  get canRedo(): boolean {
    return this.#undo.canRedo;
  }

  get isNew(): boolean {
    return this.#undo.isInitial;
  }

  undo(): void {
    this.#return(this.#undo.undo());
  }

  redo(): void {
    this.#return(this.#undo.redo());
  }

  #return(state: S | undefined): void {
    if (state === undefined) return;
    this.state = state;
    this.update();
  }

  /** Rewrites the text of the settings and loads it on stage. */
  protected update(): void {
    this.eml = this.follow();
    void this.rehearse();
    this.redraw();
  }

  /** True if a redraw of the page is pending. */
  protected get drawing(): boolean {
    return this.#drawn !== 0;
  }

  /** Schedules a redraw of the page; several changes share one. */
  redraw(): void {
    if (this.#drawn !== 0) return;
    this.#drawn = requestAnimationFrame(() => {
      this.#drawn = 0;
      this.draw();
    });
  }

  /** Loads the text in the player; while it reads one, only the latest is queued. */
  async rehearse(): Promise<void> {
    if (this.#reading) {
      this.#behind = true;
      return;
    }
    this.#reading = true;
    try {
      do {
        this.#behind = false;
        this.diagnostics = await this.player.rehearse(this.eml);
      } while (this.#behind);
      // A user who edits a paused figure wants to see the final state.
      if (this.showsEnd && this.player.paused && this.player.currentTime < SETTLED_SECS) this.player.currentTime = SETTLED_SECS;
    } catch {
      // The player shows the problems. If another story replaced the loaded one, its text follows.
    }
    this.#reading = false;
    this.read();
    this.redraw();
  }
}
