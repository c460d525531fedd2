/** Answers as a learner reads them, and what would have been right. */

import type { Question, QuestionOption } from '../element/types.js';

const LIST = ', ';
const ORDER = ' → ';
const PAIR = ' – ';
const PAIRS = '; ';
const OR = ' / ';

const texts = (options: readonly QuestionOption[], between: string): string => options.map(({ text }) => text).join(between);

/** What was given, by the texts of options; empty where nothing was. */
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
      return options.flatMap(({ text }, i) => (named(given[i]) === undefined ? [] : [`${text}${PAIR}${named(given[i])?.partner ?? ''}`])).join(PAIRS);
    default:
      return given.filter((text) => text !== '').join(LIST);
  }
}

/** What is right, the first way of each part; empty where any answer is. */
export function rightText({ kind, options }: Question): string {
  const right = options.filter(({ isRight }) => isRight);
  switch (kind) {
    case 'choice':
    case 'point':
      return texts(right, OR);
    case 'several':
      return texts(right, LIST);
    case 'order':
      return texts(options, ORDER);
    case 'match':
      return options.map(({ text, partner = '' }) => `${text}${PAIR}${partner}`).join(PAIRS);
    case 'gap':
      return options.map(({ accepts = [] }) => accepts[0] ?? '').join(LIST);
    case 'number':
      return right
        .map(({ least, most }) => (least === most ? String(least) : [least, most].map((end) => (end === undefined || !Number.isFinite(end) ? '' : end)).join('…')))
        .join(OR);
    case 'text':
      return right.flatMap(({ accepts = [] }) => accepts).join(OR);
  }
}
