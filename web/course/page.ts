/** Page around the story of a course: chapters, exit, saved state, and result. */

import { html, nothing, render } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import type { Answered } from '../element/base/answers.js';
import type { Course } from './course.js';
import { RecordError, type Known, type Record } from './report.js';
import { showResult } from './result.js';
import type { Trouble, Troubles } from './storage-problems.js';
import { wordsOf } from './words.js';

/** Elements that the page of `raconteur export` has. */
interface Places {
  readonly bar: HTMLElement;
  readonly status: HTMLOutputElement;
  readonly result: HTMLElement;
}

/** Time for which the recovery from a failed save is shown, milliseconds. */
const SAVED_MS = 4000;

export class CoursePage {
  readonly #player: RaconteurPlayer;
  readonly #course: Course;
  readonly #places: Places;
  readonly #words = wordsOf(document.documentElement.lang);
  /** True if there is an exit; false on a plain site, where the browser leaves the page. */
  readonly #hasExit: boolean;
  readonly #troubles: Troubles;
  #returnAddress: string | undefined;
  /** State of leaving: staying, leaving, warned about unsaved data, or left. */
  #exit: 'here' | 'leaving' | 'warned' | 'left' = 'here';
  #savedTimer: ReturnType<typeof setTimeout> | undefined;
  /** Permanent message if there is no record. */
  #failure = '';

  constructor(player: RaconteurPlayer, course: Course, record: Record, places: Places, hasExit: boolean) {
    this.#player = player;
    this.#course = course;
    this.#places = places;
    this.#hasExit = hasExit;
    this.#troubles = record.troubles;
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
      this.#failure = this.#words.absences[error.why];
      this.#tell(undefined);
    }
  }

  #tell(trouble: Trouble | undefined): void {
    const { status } = this.#places;
    clearTimeout(this.#savedTimer);
    const wasTold = status.value !== '' && status.value !== this.#failure;
    status.classList.toggle('trouble', trouble !== undefined || this.#failure !== '');
    status.value = trouble === undefined ? this.#failure : this.#sentence(trouble);
    if (trouble !== undefined || this.#failure !== '' || !wasTold) return;
    status.value = this.#words.saved;
    this.#savedTimer = setTimeout(() => (status.value = ''), SAVED_MS);
  }

  /** Returns the meaning of a problem, with a remedy. */
  #sentence(trouble: Trouble): string {
    const { troubles, unsaved } = this.#words;
    const told = this.#troubles.isKept ? troubles[trouble] : troubles.unkept;
    return this.#exit === 'warned' ? `${told} ${unsaved}` : told;
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
    const isGone = this.#exit === 'leaving' || this.#exit === 'left';
    const exit = html`<button type="button" class="exit" ?disabled=${isGone} @click=${() => void this.#leave()}>${words.exit}</button>`;
    const result = html`<button type="button" @click=${() => this.#showResult(true)}>${words.result}</button>`;
    const hasResult = this.#course.isSettled && this.#places.result.hidden;
    render(html`${chapters.length > 1 ? list : nothing}${hasResult ? result : nothing}${this.#hasExit ? exit : nothing}`, this.#places.bar);
  }

  #goTo(secs: number): void {
    this.#places.bar.querySelector('details')?.removeAttribute('open');
    this.#player.currentTime = secs;
    this.#player.focus();
    // The story stays paused at an open question and shows it.
    void this.#player.play().catch(() => undefined);
  }

  /** Ends the session, and goes to the system's return address; warns first about unsaved data. */
  async #leave(): Promise<void> {
    const { status } = this.#places;
    const isWarned = this.#exit === 'warned';
    this.#player.pause();
    // Later actions would not be recorded.
    this.#player.inert = true;
    if (!isWarned) {
      this.#exit = 'leaving';
      this.#drawBar();
      status.value = this.#words.leaving;
      await this.#course.leave();
      if (this.#troubles.now !== undefined) {
        this.#exit = 'warned';
        this.#tell(this.#troubles.now);
        this.#drawBar();
        return;
      }
    }
    this.#exit = 'left';
    this.#drawBar();
    if (this.#returnAddress !== undefined) {
      location.href = this.#returnAddress;
      return;
    }
    // Only windows that a script opened can be closed.
    window.close();
    if (this.#troubles.now === undefined) status.value = this.#words.left;
  }

  #showResult(isAsked = false): void {
    const { questions } = this.#player;
    if (questions.length === 0) return;
    const { result } = this.#places;
    const outcome = this.#course.outcome;
    const answered = this.#player.state().answered as readonly Answered[];
    showResult(result, { questions, answered, ...outcome }, this.#words, document.documentElement.lang, {
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
    this.#drawBar();
    // If the player had the focus, the result receives it for reading.
    if (isAsked || document.activeElement === this.#player || document.activeElement === document.body) result.querySelector('h2')?.focus();
  }
}
