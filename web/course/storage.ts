/** A course on a plain site: the browser itself stores the learner's actions. */

import type { Score } from '../element/base/answers.js';
import { bestOf, joined, NOTHING, readMemory, writeMemory, type Memory } from './memory.js';
import type { KnownLearner, Record, Report } from './report.js';
import { FOLLOW_MS, Slot, type Shelf } from './shelf.js';
import { StorageProblems } from './storage-problems.js';

export class BrowserRecord implements Record {
  readonly troubles = new StorageProblems();
  readonly #slot: Slot;
  readonly #name: string;
  /** Last text written here; a different stored text comes from another page of the course. */
  #written: string | undefined;
  #last: Report | undefined;
  #wasComplete = false;
  /** True if the earlier data have been read: until then they must not be overwritten. */
  #isOpen = false;
  #keptMs = -Infinity;

  /** Creates the record; `course` identifies the course on its site. Without a `shelf`, for example in a frame without storage, each visit is the first. */
  constructor(course: string, shelf: Shelf | undefined) {
    this.#name = `raconteur-course:${course}`;
    this.#slot = new Slot(shelf, this.#name);
    this.#written = this.#slot.get();
    this.troubles.isKept = false;
  }

  open(): Promise<KnownLearner> {
    this.#isOpen = true;
    const { memory, isComplete } = keptIn(this.#slot.get());
    this.#wasComplete = isComplete;
    return Promise.resolve({ memory, isComplete });
  }

  others(key: string | null, text: string | null): Memory | undefined {
    return key === this.#name && text !== null ? keptIn(text).memory : undefined;
  }

  save(report: Report): void {
    this.#last = report;
    // A page may go without a word.
    if (performance.now() - this.#keptMs >= FOLLOW_MS) this.keep();
  }

  keep(): void {
    if (this.#last === undefined || !this.#isOpen) return;
    this.#keptMs = performance.now();
    const { placeSecs, progress, score, isPassed, isComplete } = this.#last;
    const stored = this.#slot.get();
    const other = stored === this.#written ? undefined : keptIn(stored);
    this.#wasComplete ||= other?.isComplete === true;
    const memory = writeMemory(other === undefined ? this.#last.memory : joined(this.#last.memory, other.memory));
    // Data for the page that lists several lessons is stored next to the memory.
    const kept = { memory, placeSecs, progress, score: bestOf(score, other?.score), isPassed, isComplete: isComplete || this.#wasComplete };
    this.#written = JSON.stringify(kept);
    this.troubles.set('the browser', this.#slot.set(this.#written) ? undefined : 'unkept');
  }

  close(): void {
    this.keep();
  }
}

function keptIn(text: string | undefined): { readonly memory: Memory; readonly isComplete: boolean; readonly score?: Score | undefined } {
  try {
    const kept = JSON.parse(text ?? 'null') as { memory?: unknown; isComplete?: unknown; score?: Score } | null;
    return { memory: readMemory(typeof kept?.memory === 'string' ? kept.memory : ''), isComplete: kept?.isComplete === true, score: kept?.score };
  } catch {
    return { memory: NOTHING, isComplete: false };
  }
}
