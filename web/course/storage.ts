/** A course on a plain site: the browser itself keeps what the learner did. */

import { NOTHING, readMemory, writeMemory } from './memory.js';
import type { Known, Record, Report } from './report.js';
import { FOLLOW_MS, Slot, type Shelf } from './shelf.js';
import { Troubles } from './trouble.js';

export class BrowserRecord implements Record {
  readonly troubles = new Troubles();
  readonly #slot: Slot;
  #last: Report | undefined;
  #wasComplete = false;
  /** What was kept before is known: it must not be written over. */
  #isOpen = false;
  #keptMs = -Infinity;

  /** `course` names the course among those of a site. Without a `shelf`, as in a frame that may keep nothing, each visit is the first. */
  constructor(course: string, shelf: Shelf | undefined) {
    this.#slot = new Slot(shelf, `raconteur-course:${course}`);
  }

  open(): Promise<Known> {
    this.#isOpen = true;
    try {
      const kept = JSON.parse(this.#slot.get() ?? 'null') as { memory?: unknown; isComplete?: unknown } | null;
      this.#wasComplete = kept?.isComplete === true;
      return Promise.resolve({ memory: readMemory(typeof kept?.memory === 'string' ? kept.memory : ''), isComplete: this.#wasComplete });
    } catch {
      return Promise.resolve({ memory: NOTHING, isComplete: false });
    }
  }

  tell(report: Report): void {
    this.#last = report;
    // A page may go without a word.
    if (performance.now() - this.#keptMs >= FOLLOW_MS) this.keep();
  }

  keep(): void {
    if (this.#last === undefined || !this.#isOpen) return;
    this.#keptMs = performance.now();
    const { memory, placeSecs, progress, score, isPassed, isComplete } = this.#last;
    // What the page that lists several lessons reads is beside the memory.
    const kept = { memory: writeMemory(memory), placeSecs, progress, score, isPassed, isComplete: isComplete || this.#wasComplete };
    this.troubles.set('the browser', this.#slot.set(JSON.stringify(kept)) ? undefined : 'unkept');
  }

  close(): void {
    this.keep();
  }
}
