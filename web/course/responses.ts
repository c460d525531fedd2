/** Answers as texts in the form that SCORM 2004 (Run-Time Environment, 4.2.9) and xAPI (Data, 2.4.4.1) have in common. */

import { numberOf } from '../element/lesson/judge.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';
import type { Reply } from './report.js';
import { BETWEEN, decimal, plain } from './texts.js';

export type InteractionType = 'choice' | 'sequencing' | 'matching' | 'fill-in' | 'long-fill-in' | 'numeric';

export const TYPES: { readonly [kind in QuestionKind]: InteractionType } = {
  choice: 'choice',
  several: 'choice',
  point: 'choice',
  order: 'sequencing',
  match: 'matching',
  gap: 'fill-in',
  number: 'numeric',
  text: 'long-fill-in',
};

/** Limits of a standard for answers. */
export interface Limits {
  /** Options, pairs or steps. */
  readonly items: number;
  /** Gaps, and the characters of each. */
  readonly gaps: number;
  readonly gapLength: number;
  readonly textLength: number;
  /** Number of patterns of a right answer. */
  readonly patterns: number;
}

/** Between a source and its target, and between the ends of a range. */
const PAIR = '[.]';
const RANGE = '[:]';

/** Returns the identifier of an option: its name, or its index if the name is not an identifier, or looks like such an index. */
export function identifierOf(name: string, index: number): string {
  return /^[\w.-]{1,250}$/.test(name) && /\w/.test(name) && !/^option-\d+$/.test(name) ? name : `option-${index + 1}`;
}

/** Returns the indices of the chosen options, each once: in the given order for `order`, else ascending. */
export function placesOf({ kind, options }: Question, given: readonly string[]): number[] {
  const places = [...new Set(given.map((name) => options.findIndex((option) => option.name === name)))].filter((place) => place >= 0);
  return kind === 'order' ? places : places.sort((a, b) => a - b);
}

/** Returns the index of the first option with the same partner: equal partner texts are one target. */
export const targetOf = (options: readonly QuestionOption[], place: number): number => options.findIndex(({ partner }) => partner === options[place]?.partner);

/** Returns the pairs of option and given partner, by their indices; options may have none. */
export function pairsOf({ options }: Question, given: readonly string[]): (readonly [source: number, target: number])[] {
  return options.flatMap((_, source) => {
    const place = options.findIndex(({ name }) => name === given[source]);
    return options[place]?.partner === undefined ? [] : [[source, targetOf(options, place)] as const];
  });
}

/** Returns the names that a right answer chooses, in the form of `given`; empty if nothing is right. */
export function rightNames({ kind, options, isUngraded }: Question): string[] {
  if (isUngraded === true) return [];
  const right = kind === 'order' || kind === 'match' ? options : options.filter(({ isRight }) => isRight);
  return right.map(({ name }) => name);
}

/** Returns the given names in the form of `choice`, `sequencing` or `matching`. */
function chosen(question: Question, given: readonly string[], { items }: Limits): string {
  const identifier = (place: number) => identifierOf(question.options[place]?.name ?? '', place);
  const parts =
    question.kind === 'match' ? pairsOf(question, given).map(([source, target]) => `${identifier(source)}${PAIR}${identifier(target)}`) : placesOf(question, given).map(identifier);
  return parts.slice(0, items).join(BETWEEN);
}

/** Returns an entered number; undefined if invalid, or not representable in the formats. */
export const numberText = (given: readonly string[]): string | undefined => decimal(numberOf(given[0] ?? '') ?? NaN);

/** Returns the texts entered into gaps; empty if there are none. */
export function gapsText(given: readonly string[], { gaps, gapLength }: Limits): string {
  const parts = given.slice(0, gaps).map((text) => plain(text, gapLength));
  return parts.some((part) => part !== '') ? parts.join(BETWEEN) : '';
}

/** Returns a learner's response; undefined if there is none, or none representable in the format. */
export function responseOf({ question, answered: { given } }: Pick<Reply, 'question' | 'answered'>, limits: Limits): string | undefined {
  switch (TYPES[question.kind]) {
    case 'fill-in':
      return gapsText(given, limits) || undefined;
    case 'long-fill-in':
      return plain(given[0] ?? '', limits.textLength) || undefined;
    case 'numeric':
      return numberText(given);
    default:
      return chosen(question, given, limits) || undefined;
  }
}

/** Returns all combinations of one item per list, up to a maximum number. */
function combinations(lists: readonly (readonly string[])[], most: number): string[][] {
  return lists.reduce<string[][]>((made, list) => made.flatMap((head) => list.map((last) => [...head, last])).slice(0, most), [[]]);
}

/** Returns a range of numbers; undefined if it is unbounded, its bounds are not representable, or a preceding wrong answer lies in it. */
function rangeOf({ least = -Infinity, most = Infinity }: QuestionOption, before: readonly QuestionOption[]): string | undefined {
  const ends = [least, most].map((end) => (Number.isFinite(end) ? decimal(end) : ''));
  const isCut = before.some((other) => !other.isRight && (other.least ?? -Infinity) <= most && (other.most ?? Infinity) >= least);
  return isCut || least > most || ends.includes(undefined) || ends.every((end) => end === '') ? undefined : ends.join(RANGE);
}

/** Returns the patterns of a right answer, each once; empty if nothing is right, or the format cannot express it. */
export function patternsOf(question: Question, limits: Limits): string[] {
  if (question.isUngraded === true) return [];
  const right = question.options.filter(({ isRight }) => isRight);
  const patterns = (() => {
    switch (TYPES[question.kind]) {
      case 'fill-in':
        if (question.options.length > limits.gaps) return [];
        return combinations(
          question.options.map(({ accepts = [] }) => accepts),
          limits.patterns,
        ).map((words) => gapsText(words, limits));
      case 'long-fill-in':
        // A question that accepts any text has no words.
        return right.flatMap(({ accepts = [] }) => (accepts.length === 0 ? [undefined] : accepts.map((word) => plain(word, limits.textLength))));
      case 'numeric':
        return right.map((option) => rangeOf(option, question.options.slice(0, question.options.indexOf(option))));
      default:
        return rightNames(question).length > limits.items ? [] : [chosen(question, rightNames(question), limits)];
    }
  })();
  // A correct answer that the format cannot express would make a list of the others wrong.
  return patterns.includes(undefined) ? [] : ([...new Set(patterns.filter((pattern) => pattern !== undefined && pattern !== ''))].slice(0, limits.patterns) as string[]);
}
