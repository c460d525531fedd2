/** The state of a page whose settings are written as EML: what the controls say, the text that follows from it, and the picture that follows from that. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Diagnostic } from '../element/base/types.js';
import { UndoStack } from './undo.js';

/** By then everything that is set has come: limbs and faces are where they were sent. */
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

  /** Takes in what the settings say by now; the text of that. */
  protected abstract follow(): string;

  /** Draws the page. */
  protected abstract draw(): void;

  /** The text was read, or could not be. */
  protected read(): void {}

  /** A picture that stands shows where the settings lead. */
  protected get showsEnd(): boolean {
    return true;
  }

  /** Changes a setting while a control moves. */
  change(edit: (state: S) => void): void {
    edit(this.state);
    this.update();
  }

  /** The control rests: what it did is one step of undo. */
  done(): void {
    if (this.#undo.settle(this.state)) this.redraw();
  }

  /** Changes a setting at once. */
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

  /** Writes the text of the settings anew and puts it on stage. */
  protected update(): void {
    this.eml = this.follow();
    void this.rehearse();
    this.redraw();
  }

  /** The page is going to be drawn. */
  protected get drawing(): boolean {
    return this.#drawn !== 0;
  }

  /** Draws the page soon; many changes are drawn once. */
  redraw(): void {
    if (this.#drawn !== 0) return;
    this.#drawn = requestAnimationFrame(() => {
      this.#drawn = 0;
      this.draw();
    });
  }

  /** Gives the text to the player; while it reads one, the next waits, and those between are never read. */
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
      // Who changes a standing picture wants to see where it leads.
      if (this.showsEnd && this.player.paused && this.player.currentTime < SETTLED_SECS) this.player.currentTime = SETTLED_SECS;
    } catch {
      // The player shows what is wrong; where another story took the place of the one that was read, its text follows.
    }
    this.#reading = false;
    this.read();
    this.redraw();
  }
}
