/** The state of a page that writes a script: what its controls say, the text that follows from it, and the picture that follows from that. */

import type { Diagnostic, RaconteurPlayer } from '../element/index.js';

/** Steps that can be undone. */
const MOST_STEPS = 200;
/** By then everything that is set has come, seconds. */
export const SETTLED_SECS = 2;

/** Settings that can be undone, written as a script and rehearsed by the player. */
export abstract class Settings<State, Tab extends string> {
  state: State;
  abstract tab: Tab;
  diagnostics: readonly Diagnostic[] = [];
  eml = '';
  readonly #beginning: string;
  readonly #past: string[] = [];
  readonly #future: string[] = [];
  /** The state that undo brings back. */
  #settled: string;
  #reading = false;
  #behind = false;
  #drawn = 0;

  constructor(
    readonly player: RaconteurPlayer,
    private readonly render: () => void,
    beginning: State,
  ) {
    this.state = beginning;
    this.#beginning = this.#settled = JSON.stringify(beginning);
  }

  /** The text of the present state. */
  protected abstract write(): string;

  /** Whether a standing picture shows where the settings lead to, not where the player stands. */
  protected get isStill(): boolean {
    return true;
  }

  /** Changes a setting while a control moves. */
  change(edit: (state: State) => void): void {
    edit(this.state);
    this.follow();
  }

  /** The control rests: what it did is one step of undo. */
  done(): void {
    const now = JSON.stringify(this.state);
    if (now === this.#settled) return;
    this.#past.push(this.#settled);
    if (this.#past.length > MOST_STEPS) this.#past.shift();
    this.#future.length = 0;
    this.#settled = now;
    this.redraw();
  }

  /** Changes a setting at once. */
  set(edit: (state: State) => void): void {
    this.change(edit);
    this.done();
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  get isNew(): boolean {
    return this.#settled === this.#beginning;
  }

  /** Everything as in the beginning, as one step of undo. */
  reset(): void {
    this.set((state) => Object.assign(state as object, JSON.parse(this.#beginning)));
  }

  undo(): void {
    this.#step(this.#past, this.#future);
  }

  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #step(from: string[], to: string[]): void {
    const next = from.pop();
    if (next === undefined) return;
    to.push(this.#settled);
    this.#settled = next;
    this.state = JSON.parse(next) as State;
    this.follow();
  }

  /** Draws the page soon; many changes are drawn once. */
  redraw(): void {
    this.#drawn ||= requestAnimationFrame(() => {
      this.#drawn = 0;
      this.render();
    });
  }

  /** Whether the page will be drawn soon. */
  protected get willDraw(): boolean {
    return this.#drawn !== 0;
  }

  /** Writes the text anew and has it read. */
  protected follow(): void {
    this.eml = this.write();
    void this.rehearse();
    this.redraw();
  }

  /** Gives the text to the player; while it reads one, the next waits, and those between are never read. */
  async rehearse(): Promise<void> {
    this.#behind = true;
    if (this.#reading) return;
    this.#reading = true;
    try {
      while (this.#behind) {
        this.#behind = false;
        this.diagnostics = await this.player.rehearse(this.eml);
      }
      // Who changes a standing picture wants to see where it leads.
      if (this.isStill && this.player.paused && this.player.currentTime < SETTLED_SECS) this.player.currentTime = SETTLED_SECS;
    } catch {
      // The player shows what is wrong; and where another story took the place of the one that
      // was read, its text follows.
    }
    this.#reading = false;
    this.rehearsed();
    this.redraw();
  }

  /** The player has read what was written last. */
  protected rehearsed(): void {}
}
