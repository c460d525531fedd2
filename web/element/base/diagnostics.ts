/** The problems of the story, its voice and its figure. */

import type { Diagnostic } from './types.js';

/** Maximum number of diagnostics: a mind that sends invalid data does not fill the page with messages. */
const MAX_DIAGNOSTICS = 200;
/** Diagnostics that remain valid for another figure. */
const OF_SOUND: readonly string[] = ['voice-missing', 'voice-not-installed', 'sound-missing'];

export class Diagnostics {
  #list: readonly Diagnostic[] = [];
  readonly #reported: (diagnostic: Diagnostic) => void;

  /** Creates the list; `reported` is called with each individually reported diagnostic, after it is in the list. */
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

  /** Adds the diagnostics of a story that was read again; with `anew` they replace all about its text. */
  addStory(diagnostics: readonly Diagnostic[], anew: boolean): void {
    this.#list = [...this.#list.filter((d) => !anew || d.start === undefined), ...diagnostics].slice(0, MAX_DIAGNOSTICS);
  }

  /** Keeps only the diagnostics about audio, when another figure performs; the others belonged to the previous figure. */
  keepSound(): void {
    this.#list = this.#list.filter((d) => OF_SOUND.includes(d.code));
  }

  clear(): void {
    this.#list = [];
  }
}
