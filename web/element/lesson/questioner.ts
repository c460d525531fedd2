/** Has the story rest at its questions and go on by the ways that follow from answers. */

import { fire, type PlayerContext } from '../story/context.js';
import { Lesson, type FlowTurn } from './lesson.js';
import type { Answered } from '../base/answers.js';
import { Limit } from './limit.js';
import { QuestionForm } from './question.js';
import type { Show } from '../story/show.js';
import type { Story } from '../base/types.js';

/** The story stands at a place when it is nearer than this. */
const NEAR_SECS = 1e-3;

export class Questioner {
  readonly lesson = new Lesson();
  /** The form of what is asked. */
  readonly form: QuestionForm;
  readonly #contextOf: () => PlayerContext;
  readonly #limit: Limit;
  /** The story is being moved by what is answered here, not by the learner. */
  #isTurning = false;
  /** What was asked when that was told last. */
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

  /** Whether the story is being moved by what was answered. */
  get isTurning(): boolean {
    return this.#isTurning;
  }

  /** The text on stage is another, or has other times. */
  take({ questions, ways }: Story, secs: number): void {
    this.lesson.retime(questions, ways, secs);
  }

  /** What was answered before; at a time where the learner stays it is added to what was answered here. */
  restore(state: unknown, secs?: number): void {
    const { asked } = this.lesson;
    if (secs === undefined) this.lesson.restore(state);
    else this.lesson.join(state, secs);
    // The form of what is still asked, and what is written there, stays; what was answered before is passed.
    const isOver = asked !== undefined && secs !== undefined && this.lesson.pass(secs).kind !== 'rest';
    if (isOver) this.lesson.seek(secs);
    this.#ask();
    if (isOver)
      this.#contextOf()
        .player.play()
        .catch(() => undefined);
  }

  /** The story goes, and what was answered to it. */
  clear(): void {
    this.lesson.clear();
    this.form.forget();
    this.#ask();
  }

  /** Fragments were interrupted: what they ask is not asked any more. */
  interrupted(): void {
    this.lesson.interrupt();
    this.#ask();
  }

  /** The story was brought to another time. */
  sought(secs: number): void {
    if (!this.#isTurning) this.lesson.seek(secs);
  }

  /** The story has come to a time; whether it may be shown, or was brought elsewhere. `drain` passes what lies up to a time. */
  pass(show: Show, secs: number, drain: (secs: number) => void): boolean {
    if (this.#isTurning) return true;
    const turn = this.lesson.pass(secs);
    this.#ask();
    return this.#turn(show, turn, secs, drain);
  }

  /** Takes an answer to what is asked; undefined where that is none. */
  answer(given: readonly string[]): Answered | undefined {
    return this.#took(this.lesson.answer(given));
  }

  #took(taken: ReturnType<Lesson['answer']>): Answered | undefined {
    const { player, show, tell, say } = this.#contextOf();
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
    // What lies on the way there is not lost.
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

  /** Tells that something is asked. */
  #ask(): void {
    const { asked } = this.lesson;
    if (asked?.name === this.#told) return;
    this.#told = asked?.name;
    const { player, show, say, tell, keepTime } = this.#contextOf();
    this.form.open(asked, show?.story, this.lesson.seed);
    this.#limit.start(asked?.limitSecs, this.form.words);
    if (asked !== undefined) {
      fire(player, 'question', asked);
      const { kind, ...told } = asked;
      tell({ kind: 'question', ...told, type: kind });
      // One that follows at once would be said instead of what there is to read of the answer.
      say([this.form.feedback, this.form.words.asks(this.form.prompt)].filter(Boolean).join(' '));
    }
    keepTime();
    player.requestUpdate();
  }
}
