/** A course on a plain site: the browser itself keeps what the learner did. */

import type { Known, Record, Report } from './report.js';

/** What is kept. */
interface Kept extends Known {
  readonly placeSecs: number;
  readonly progress: number;
}

export class BrowserRecord implements Record {
  readonly #key: string;
  readonly #storage: Pick<Storage, 'getItem' | 'setItem'> | undefined;
  #last: Report | undefined;
  #wasComplete = false;

  /** `course` names the course among those of a site. Without a `storage`, as in a frame that may keep nothing, each visit is the first. */
  constructor(course: string, storage: Pick<Storage, 'getItem' | 'setItem'> | undefined) {
    this.#key = `raconteur-course:${course}`;
    this.#storage = storage;
  }

  open(): Promise<Known> {
    try {
      const kept = JSON.parse(this.#storage?.getItem(this.#key) ?? 'null') as Partial<Kept> | null;
      this.#wasComplete = kept?.isComplete === true;
      return Promise.resolve({ memory: typeof kept?.memory === 'string' ? kept.memory : '', isComplete: this.#wasComplete });
    } catch {
      return Promise.resolve({ memory: '', isComplete: false });
    }
  }

  tell(report: Report): void {
    this.#last = report;
  }

  keep(): void {
    if (this.#last === undefined) return;
    const { memory, placeSecs, progress, isComplete } = this.#last;
    const kept: Kept = { memory, placeSecs, progress, isComplete: isComplete || this.#wasComplete };
    try {
      this.#storage?.setItem(this.#key, JSON.stringify(kept));
    } catch {
      // Full, or forbidden: the story is told all the same.
    }
  }

  close(): void {
    this.keep();
  }
}
