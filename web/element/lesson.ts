/**
 * The questions of a story: where it rests until somebody has answered, what follows from an answer, and what was answered. A
 * question's answers lie one after another in the story; what does not fit is passed over.
 */

import type { Question } from './types.js';

/** What somebody has answered to a question. */
export interface Answered {
  /** The question's name. */
  readonly name: string;
  /** The names of the options that were chosen last. */
  readonly given: readonly string[];
  readonly isRight: boolean;
  readonly points: number;
  /** How often it was answered. */
  readonly tries: number;
  /** It is answered for good: right, or there are no tries left. */
  readonly isFinal: boolean;
}

/** Points so far, and the most that there are. */
export interface Score {
  readonly points: number;
  readonly most: number;
}

/** What is to become of the story's time. */
export type Turn = { readonly kind: 'go' } | { readonly kind: 'rest'; readonly atSecs: number } | { readonly kind: 'leap'; readonly toSecs: number };

const GO: Turn = { kind: 'go' };
/** Times of a story differ by less where they mean the same. */
const NEARLY_SECS = 1e-3;

export class Lesson {
  #questions: readonly Question[] = [];
  readonly #answered = new Map<string, Answered>();
  #asked: Question | undefined;
  /** What follows from the last answer, and the time at which that is over. */
  #follows: { readonly endSecs: number; readonly toSecs: number } | undefined;

  /** The questions of the text on stage; what was answered to those of the same names stays. */
  setQuestions(questions: readonly Question[]): void {
    this.#questions = questions;
    this.#asked = this.#follows = undefined;
  }

  /** What is asked now. */
  get asked(): Question | undefined {
    return this.#asked;
  }

  /** What was answered, by the questions' order. */
  get answered(): readonly Answered[] {
    return this.#questions.flatMap(({ name }) => this.#answered.get(name) ?? []);
  }

  get score(): Score {
    const points = this.answered.reduce((sum, { points }) => sum + points, 0);
    return { points, most: this.#questions.reduce((sum, { points }) => sum + points, 0) };
  }

  /** The story has come to a time by itself, or was brought there: whether it may go on. */
  pass(secs: number): Turn {
    const follows = this.#follows;
    if (follows !== undefined) {
      if (secs < follows.endSecs - NEARLY_SECS) return GO;
      this.#follows = undefined;
      if (secs < follows.toSecs - NEARLY_SECS) return { kind: 'leap', toSecs: follows.toSecs };
    }
    const first = this.#questions.find(({ name, atSecs }) => atSecs <= secs + NEARLY_SECS && this.#answered.get(name)?.isFinal !== true);
    this.#asked = first;
    if (first !== undefined) return { kind: 'rest', atSecs: first.atSecs };
    // Within what follows from answers that were given before.
    const within = this.#questions.find(({ atSecs, endSecs }) => atSecs <= secs && secs < endSecs - NEARLY_SECS);
    return within === undefined ? GO : { kind: 'leap', toSecs: within.endSecs };
  }

  /** The story was brought to another time: what follows from an answer is not told any more. */
  leave(): void {
    this.#follows = undefined;
  }

  /** Takes an answer to what is asked; undefined where nothing is, or where it chooses nothing that there is. */
  answer(given: readonly string[]): { readonly answered: Answered; readonly turn: Turn } | undefined {
    const asked = this.#asked;
    if (asked === undefined) return undefined;
    const chosen = asked.options.filter(({ name }) => given.includes(name));
    if (chosen.length === 0 || (asked.kind === 'choice' && chosen.length > 1)) return undefined;
    const isRight = asked.options.every((option) => option.isRight === chosen.includes(option));
    const tries = (this.#answered.get(asked.name)?.tries ?? 0) + 1;
    const isFinal = isRight || tries >= asked.tries;
    const answered: Answered = { name: asked.name, given: chosen.map(({ name }) => name), isRight, points: isRight ? asked.points : 0, tries, isFinal };
    this.#answered.set(asked.name, answered);
    return { answered, turn: isFinal ? this.#react(asked, answered) : GO };
  }

  #react(asked: Question, { given, isRight }: Answered): Turn {
    const fits = (to: string) => (to === 'right' ? isRight : to === 'wrong' ? !isRight : given.length === 1 && given[0] === to);
    const reaction = asked.answers.find(({ to }) => fits(to));
    this.#asked = undefined;
    if (reaction === undefined) return { kind: 'leap', toSecs: asked.endSecs };
    this.#follows = { endSecs: reaction.endSecs, toSecs: asked.endSecs };
    return { kind: 'leap', toSecs: reaction.startSecs };
  }

  /** What was answered, to be given back to `restore`: data that `JSON.stringify` writes. */
  state(): readonly Answered[] {
    return [...this.#answered.values()];
  }

  /** Takes what `state` gave, whatever has become of it in between: what is no answer to a question on stage is left out. */
  restore(state: unknown): void {
    this.#answered.clear();
    this.#asked = this.#follows = undefined;
    for (const told of Array.isArray(state) ? (state as unknown[]) : []) {
      const { name, given, tries } = (told ?? {}) as { name?: unknown; given?: unknown; tries?: unknown };
      const question = this.#questions.find((q) => q.name === name);
      if (question === undefined || !Array.isArray(given) || !(typeof tries === 'number' && tries >= 1)) continue;
      // Points are counted anew: what comes from outside may claim too many.
      const chosen = question.options.filter((option) => given.includes(option.name));
      const isRight = chosen.length > 0 && question.options.every((option) => option.isRight === chosen.includes(option));
      const count = Math.min(question.tries, Math.floor(tries));
      this.#answered.set(question.name, {
        name: question.name,
        given: chosen.map((o) => o.name),
        isRight,
        points: isRight ? question.points : 0,
        tries: count,
        isFinal: isRight || count >= question.tries,
      });
    }
  }
}
