/** Answers as a learner reads them. */

import { readOf } from '../element/lesson/question-fields.js';
import type { Question, QuestionOption } from '../element/base/questions.js';

const LIST = ', ';
const ORDER = ' → ';
const PAIR = ' – ';
const PAIRS = '; ';

const texts = (options: readonly QuestionOption[], between: string): string => options.map(readOf).join(between);

/** Returns an answer as the texts of its options; empty if there is none. */
export function givenText({ kind, options }: Question, given: readonly string[]): string {
  const named = (name: string | undefined) => options.find((option) => option.name === name);
  switch (kind) {
    case 'choice':
    case 'several':
    case 'point':
      return texts(
        given.flatMap((name) => named(name) ?? []),
        LIST,
      );
    case 'order':
      return texts(
        given.flatMap((name) => named(name) ?? []),
        ORDER,
      );
    case 'match':
      return options.flatMap((option, i) => (named(given[i]) === undefined ? [] : [`${readOf(option)}${PAIR}${named(given[i])?.partner ?? ''}`])).join(PAIRS);
    default:
      return given.filter((text) => text !== '').join(LIST);
  }
}
