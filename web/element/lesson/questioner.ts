/** Pauses the story at its questions and continues it according to the answers. */

import { fire, type PlayerContext } from '../story/context.js';
import { Lesson, type FlowTurn } from './lesson.js';
import type { Answered } from '../base/answers.js';
import { Limit } from './limit.js';
import { QuestionForm } from './question.js';
import type { Show } from '../story/show.js';
import type { Story } from '../base/types.js';

/** Tolerance for the story's position, seconds. */
const NEAR_SECS = 1e-3;

export class Questioner {
  readonly lesson = new Lesson();
  /** Form of the current question. */
  readonly form: QuestionForm;
  readonly #contextOf: () => PlayerContext;
  readonly #limit: Limit;
  /** True while an answer, not the learner, moves the story. */
  #isTurning = false;
  /** Last announced question. */
  #told: string | undefined;

  constructor(contextOf: () => PlayerContext) {
    this.#contextOf = contextOf;
    this.#limit = new Limit({
      left: (text) => {
        if (text !== undefined) this.#contextOf().say(text);
        this.#contextOf().player.requestUpdate();
      },
      over: () => void this.#took(this.lesson.expire()),
    });
    this.form = new QuestionForm(
      this.#limit,
      (given) => this.answer(given) !== undefined,
      () => this.#contextOf(),
    );
  }

  /** True while an answer moves the story. */
  get isTurning(): boolean {
    return this.#isTurning;
  }

  /** Updates the questions when another text is on stage, or when its times change. */
  take({ questions, ways }: Story, secs: number): void {
    this.lesson.retime(questions, ways, secs);
  }

  /** Restores earlier answers; with a time at which the learner stays, merges them with the current ones. */
  restore(state: unknown, secs?: number): void {
    const { asked } = this.lesson;
    if (secs === undefined) this.lesson.restore(state);
    else this.lesson.join(state, secs);
    // The form of an open question stays with its input; answered questions are passed.
    const isOver = asked !== undefined && secs !== undefined && this.lesson.pass(secs).kind !== 'rest';
    if (isOver) this.lesson.seek(secs);
    this.#ask();
    if (isOver)
      this.#contextOf()
        .player.play()
        .catch(() => undefined);
  }

  /** Clears the answers of an unloaded story. */
  clear(): void {
    this.lesson.clear();
    this.form.forget();
    this.#ask();
  }

  /** Withdraws the questions of interrupted fragments. */
  interrupted(): void {
    this.lesson.interrupt();
    this.#ask();
  }

  /** Handles a seek to another time. */
  sought(secs: number): void {
    if (!this.#isTurning) this.lesson.seek(secs);
  }

  /** Advances to a time; returns true if it may be shown, false if the story was moved. `drain` processes the cues up to a time. */
  pass(show: Show, secs: number, drain: (secs: number) => void): boolean {
    if (this.#isTurning) return true;
    const turn = this.lesson.pass(secs);
    this.#ask();
    return this.#turn(show, turn, secs, drain);
  }

  /** Takes an answer to the current question; undefined if it is invalid. */
  answer(given: readonly string[]): Answered | undefined {
    return this.#took(this.lesson.answer(given));
  }

  #took(taken: ReturnType<Lesson['answer']>): Answered | undefined {
    const { player, show, notify: tell, say } = this.#contextOf();
    if (taken === undefined || show === undefined) return undefined;
    const { answered, turn } = taken;
    fire(player, 'answer', answered);
    tell({ kind: 'answered', ...answered });
    if (answered.isFinal) fire(player, 'score', this.lesson.score);
    this.form.answered(taken);
    if (this.form.feedback !== '') say(this.form.feedback);
    player.requestUpdate();
    if (turn.kind === 'go') return answered;
    this.#turn(show, turn, show.transport.position);
    this.#ask();
    player.play().catch(() => undefined);
    return answered;
  }

  #turn({ transport }: Show, turn: FlowTurn, secs: number, drain?: (secs: number) => void): boolean {
    if (turn.kind === 'go') return true;
    const [from, to] = turn.kind === 'rest' ? [turn.atSecs, turn.atSecs] : [turn.fromSecs, turn.toSecs];
    this.#isTurning = true;
    // Events on the way to that time are not lost.
    if (!transport.paused) drain?.(Math.min(from, secs));
    if (turn.kind === 'rest') transport.pause();
    const isThere = Math.abs(secs - to) < NEAR_SECS;
    if (!isThere) {
      fire(this.#contextOf().player, 'leap', { fromSecs: secs, toSecs: to });
      transport.seek(to);
    }
    this.#isTurning = false;
    return isThere;
  }

  /** Announces a question. */
  #ask(): void {
    const { asked } = this.lesson;
    if (asked?.name === this.#told) return;
    this.#told = asked?.name;
    const { player, show, say, notify: tell, keepTime } = this.#contextOf();
    this.form.open(asked, show?.story, this.lesson.seed);
    this.#limit.start(asked?.limitSecs, this.form.words);
    if (asked !== undefined) {
      fire(player, 'question', asked);
      const { kind, ...told } = asked;
      tell({ kind: 'question', ...told, type: kind });
      // A question that follows immediately would be announced instead of the feedback on the
      // answer.
      say([this.form.feedback, this.form.words.asks(this.form.prompt)].filter(Boolean).join(' '));
    }
    keepTime();
    player.requestUpdate();
  }
}
