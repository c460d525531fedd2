/** The variables of a story, and the conditions on them. */

import { isOutcome } from './judge.js';
import type { Answered, Score } from '../base/answers.js';
import type { FlowEntry } from '../base/questions.js';

export type Value = number | string | boolean;

/** Maximum number of variables, more than in any story; limits external state. */
const MAX_VALUES = 10_000;
/** A longer text is cut. */
const MAX_TEXT_LENGTH = 1000;

/** Data available to a condition. */
export interface KnownValues {
  readonly score: Score;
  /** Returns the answer to a question. */
  answered(name: string): Answered | undefined;
}

/** Parses a value as written in a document. */
function written(text: string): Value {
  if (text === 'true' || text === 'false') return text === 'true';
  const number = Number(text);
  return text.trim() !== '' && Number.isFinite(number) ? number : text.slice(0, MAX_TEXT_LENGTH);
}

const isValue = (value: unknown): value is Value => typeof value === 'string' || typeof value === 'boolean' || (typeof value === 'number' && Number.isFinite(value));

export class Values {
  readonly #values = new Map<string, Value>();

  set({ name, value, by }: FlowEntry & { readonly kind: 'set' }): void {
    if (value !== undefined) this.#values.set(name, written(value));
    if (by !== undefined) this.#values.set(name, this.#number(name) + by);
  }

  #number(name: string): number {
    const value = this.#values.get(name);
    return typeof value === 'number' ? value : 0;
  }

  /** Returns true if all parts of a condition hold. */
  holds({ name, is, not, above = -Infinity, below = Infinity }: FlowEntry & { readonly kind: 'if' }, known: KnownValues): boolean {
    const answered = this.#values.has(name) ? undefined : known.answered(name);
    const number = name === 'score' ? known.score.points : this.#number(name);
    const compared = (text: string): boolean => {
      if (name === 'score') return number === Number(text);
      if (answered !== undefined) return holdsOf(answered, text);
      return (this.#values.get(name) ?? '') === written(text);
    };
    return (is === undefined || compared(is)) && (not === undefined || !compared(not)) && above < number && number < below;
  }

  clear(): void {
    this.#values.clear();
  }

  /** All values, as data. */
  get all(): { readonly [name: string]: Value } {
    return Object.fromEntries(this.#values);
  }

  /** Restores the output of `all`; invalid values are dropped. */
  restore(all: unknown): void {
    this.#values.clear();
    for (const [name, value] of Object.entries((all ?? {}) as object).slice(0, MAX_VALUES)) {
      if (isValue(value)) this.#values.set(name, typeof value === 'string' ? value.slice(0, MAX_TEXT_LENGTH) : value);
    }
  }
}

/** Returns true if a question is in the given state. */
function holdsOf({ isFinal, isRight, fits }: Answered, text: string): boolean {
  return isFinal && (isOutcome(text, isRight) || fits.includes(text));
}
