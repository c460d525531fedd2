/** The problems of the story, its voice and its figure. */

import type { Diagnostic } from './types.js';

/** A mind that sends garbage does not fill the page with complaints. */
const MAX_DIAGNOSTICS = 200;
/** What stays true when another figure performs. */
const OF_SOUND: readonly string[] = ['voice-missing', 'voice-not-installed', 'sound-missing'];

export class Diagnostics {
  #list: readonly Diagnostic[] = [];
  readonly #reported: (diagnostic: Diagnostic) => void;

  /** `reported` is called with each diagnostic that is reported by itself, when it is in the list. */
  constructor(reported: (diagnostic: Diagnostic) => void) {
    this.#reported = reported;
  }

  get list(): readonly Diagnostic[] {
    return this.#list;
  }

  report(diagnostic: Diagnostic): void {
    this.#list = [...this.#list, diagnostic].slice(-MAX_DIAGNOSTICS);
    this.#reported(diagnostic);
  }

  /** Adds those of a story that was read again; `anew`: they replace all that were about its text. */
  addStory(diagnostics: readonly Diagnostic[], anew: boolean): void {
    this.#list = [...this.#list.filter((d) => !anew || d.start === undefined), ...diagnostics].slice(0, MAX_DIAGNOSTICS);
  }

  /** Another figure performs: only those about sound stay, the rest belonged to the figure before. */
  keepSound(): void {
    this.#list = this.#list.filter((d) => OF_SOUND.includes(d.code));
  }

  clear(): void {
    this.#list = [];
  }
}
