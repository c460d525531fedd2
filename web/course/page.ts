/** The page around the story of a course: its chapters, the way out, what is saved, and the result. */

import { html, nothing, render } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import type { Answered } from '../element/lesson.js';
import type { Course } from './course.js';
import { RecordError, type Known, type Record } from './report.js';
import { showResult } from './result.js';
import type { Trouble } from './trouble.js';
import { wordsOf } from './words.js';

/** Elements that the page of `raconteur export` has. */
interface Places {
  readonly bar: HTMLElement;
  readonly status: HTMLOutputElement;
  readonly result: HTMLElement;
}

/** So long it is said that what could not be saved is saved now. */
const SAVED_MS = 4000;

export class CoursePage {
  readonly #player: RaconteurPlayer;
  readonly #course: Course;
  readonly #places: Places;
  readonly #words = wordsOf(document.documentElement.lang);
  /** The way out; none on a plain site, where a page is left by the browser. */
  readonly #hasExit: boolean;
  #returnAddress: string | undefined;
  #hasLeft = false;
  #savedTimer: ReturnType<typeof setTimeout> | undefined;
  /** Nobody keeps anything: a sentence that stays. */
  #failure = '';

  constructor(player: RaconteurPlayer, course: Course, record: Record, places: Places, hasExit: boolean) {
    this.#player = player;
    this.#course = course;
    this.#places = places;
    this.#hasExit = hasExit;
    for (const type of ['loadedmetadata', 'emptied', 'durationchange', 'timeupdate'] as const) player.addEventListener(type, () => this.#drawBar());
    player.addEventListener('ended', () => this.#showResult());
    player.addEventListener('playing', () => (places.result.hidden = true));
    record.troubles.listen((trouble) => this.#tell(trouble));
    this.#drawBar();
  }

  /** Begins the session. */
  async begin(): Promise<void> {
    try {
      const known: Known = await this.#course.begin();
      this.#returnAddress = known.returnAddress;
      if (known.isMuted) this.#player.muted = true;
      this.#drawBar();
    } catch (error) {
      if (!(error instanceof RecordError)) throw error;
      this.#failure = error.message;
      this.#tell(undefined);
    }
  }

  #tell(trouble: Trouble | undefined): void {
    const { status } = this.#places;
    clearTimeout(this.#savedTimer);
    const wasTold = status.value !== '' && status.value !== this.#failure;
    status.classList.toggle('trouble', trouble !== undefined || this.#failure !== '');
    status.value = trouble === undefined ? this.#failure : this.#words.troubles[trouble];
    if (trouble !== undefined || this.#failure !== '' || !wasTold) return;
    status.value = this.#words.saved;
    this.#savedTimer = setTimeout(() => (status.value = ''), SAVED_MS);
  }

  #drawBar(): void {
    const { chapters, currentTime } = this.#player;
    const words = this.#words;
    const now = chapters.findLastIndex(({ startSecs }) => startSecs <= currentTime + 1e-3);
    const list = html`<details>
      <summary>${words.chapters}</summary>
      <ol>
        ${chapters.map(
          ({ title, startSecs }, i) =>
            html`<li><button type="button" dir="auto" aria-current=${i === now ? 'true' : nothing} @click=${() => this.#goTo(startSecs)}>${title}</button></li>`,
        )}
      </ol>
    </details>`;
    const exit = html`<button type="button" class="exit" ?disabled=${this.#hasLeft} @click=${() => this.#leave()}>${words.exit}</button>`;
    render(html`${chapters.length > 1 ? list : nothing}${this.#hasExit ? exit : nothing}`, this.#places.bar);
  }

  #goTo(secs: number): void {
    this.#places.bar.querySelector('details')?.removeAttribute('open');
    this.#player.currentTime = secs;
    this.#player.focus();
    // Before a question that is open the story does not go on: it is shown.
    void this.#player.play().catch(() => undefined);
  }

  /** Ends the session, and goes where the system wants the learner to be. */
  #leave(): void {
    this.#player.pause();
    this.#course.close();
    this.#hasLeft = true;
    this.#drawBar();
    if (this.#returnAddress !== undefined) {
      location.href = this.#returnAddress;
      return;
    }
    // A window that a script has opened goes; others stay.
    window.close();
    this.#places.status.value = this.#words.left;
  }

  #showResult(): void {
    const { questions } = this.#player;
    if (questions.length === 0) return;
    const { result } = this.#places;
    const { score, isPassed } = this.#course.outcome;
    const answered = this.#player.state().answered as readonly Answered[];
    showResult(result, { questions, answered, score, isPassed }, this.#words, document.documentElement.lang, {
      again: () => {
        result.hidden = true;
        this.#player.focus();
        this.#course.again();
      },
      review: () => {
        this.#player.focus();
        this.#player.currentTime = 0;
        void this.#player.play().catch(() => undefined);
      },
    });
    result.hidden = false;
    // Who was in the player is where something is to be read.
    if (document.activeElement === this.#player || document.activeElement === document.body) result.querySelector('h2')?.focus();
  }
}
