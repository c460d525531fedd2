/** Has the story rest at its questions and go on with what follows from an answer. */

import { fire, type PlayerContext } from './context.js';
import { Lesson, type Answered, type Turn } from './lesson.js';
import type { Show } from './show.js';
import type { Question } from './types.js';

/** The story stands at a question when it is nearer than this. */
const NEAR_SECS = 1e-3;

export class Questioner {
  readonly lesson = new Lesson();
  readonly #contextOf: () => PlayerContext;
  /** The story is being moved by what is answered here, not by the learner. */
  #isTurning = false;
  /** What was asked when that was told last. */
  #told: Question | undefined;

  constructor(contextOf: () => PlayerContext) {
    this.#contextOf = contextOf;
  }

  /** The text on stage is another, or has other times. */
  take(questions: readonly Question[]): void {
    this.lesson.setQuestions(questions);
    this.#told = undefined;
  }

  /** The story was brought to another time. */
  sought(): void {
    if (!this.#isTurning) this.lesson.leave();
  }

  /** The story has come to a time; whether it may be shown, or was brought elsewhere. */
  pass(show: Show, secs: number): boolean {
    if (this.#isTurning) return true;
    const turn = this.lesson.pass(secs);
    this.#ask();
    return this.#turn(show, turn, secs);
  }

  /** Takes an answer to what is asked; undefined where that is none. */
  answer(given: readonly string[]): Answered | undefined {
    const { player, show } = this.#contextOf();
    const taken = this.lesson.answer(given);
    if (taken === undefined || show === undefined) return undefined;
    fire(player, 'answer', taken.answered);
    if (taken.answered.isFinal) fire(player, 'score', this.lesson.score);
    if (this.#turn(show, taken.turn, show.transport.position)) player.requestUpdate();
    else {
      this.#ask();
      player.play().catch(() => undefined);
    }
    return taken.answered;
  }

  #turn({ transport }: Show, turn: Turn, secs: number): boolean {
    if (turn.kind === 'go') return true;
    const to = turn.kind === 'rest' ? turn.atSecs : turn.toSecs;
    this.#isTurning = true;
    if (turn.kind === 'rest') transport.pause();
    const isThere = Math.abs(secs - to) < NEAR_SECS;
    if (!isThere) transport.seek(to);
    this.#isTurning = false;
    return isThere;
  }

  /** Tells that something is asked. */
  #ask(): void {
    const { asked } = this.lesson;
    if (asked === this.#told) return;
    this.#told = asked;
    const { player, say } = this.#contextOf();
    if (asked !== undefined) {
      fire(player, 'question', asked);
      say(`Question: ${asked.prompt}`);
    }
    player.requestUpdate();
  }
}
