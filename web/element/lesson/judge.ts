/** Validates answers to a question, judges them, and finds the options that they match. */

import type { Question, QuestionOption } from '../base/questions.js';

/** Judgement of an answer. */
export interface AnswerGrade {
  /** Given answers, without invalid ones. */
  readonly given: readonly string[];
  /** True if the answer is right; absent if the question is not graded. */
  readonly isRight?: boolean;
  /** Names of the matching options, which may determine the continuation. */
  readonly fits: readonly string[];
}

/** Returns true if the continuation `to` applies to the outcome of a question with a final answer. */
export function isOutcome(to: string, isRight: boolean | undefined): boolean {
  return to === 'answered' || (to === 'right' && isRight === true) || (to === 'wrong' && isRight === false);
}

/** Maximum length of an answer text. */
export const MAX_CHARACTERS = 10_000;

/** Returns an answer in a form for comparison, independent of accents, capitals, commas and spaces. */
export function plain(text: string): string {
  const bare = text
    .slice(0, MAX_CHARACTERS)
    .normalize('NFKD')
    .replaceAll(/[\u0300-\u036f]/g, '');
  return bare
    .toLowerCase()
    .replaceAll(/[^\p{L}\p{M}\p{N}]+/gu, ' ')
    .trim();
}

/** Parses a number in common notation; undefined if it is invalid. */
export function numberOf(text: string): number | undefined {
  const written = text.trim().replaceAll(/[\s\u00a0\u202f']/g, '');
  const number = Number(/^[^.,]*,[^.,]*$/.test(written) ? written.replace(',', '.') : written);
  return written !== '' && Number.isFinite(number) ? number : undefined;
}

/** Returns the parts of a gap question's prompt: text, and between two texts the option of a gap. */
export function gapsOf({ prompt, options }: Question): readonly (string | QuestionOption)[] {
  const parts = prompt.split(/\[([^[\]]*)\]/);
  return parts.map((part, i) => {
    if (i % 2 === 0) return part;
    return options.find(({ name }) => name === part) ?? `[${part}]`;
  });
}

const RULES: { readonly [kind in Question['kind']]: (question: Question, given: readonly string[]) => Required<AnswerGrade> | undefined } = {
  choice: one,
  point: one,
  several,
  order,
  match,
  gap,
  number: (question, given) => {
    const number = numberOf(given[0] ?? '');
    if (number === undefined) return undefined;
    return ruled(question, [given[0]?.trim() ?? ''], ({ least = -Infinity, most = Infinity }) => least <= number && number <= most);
  },
  text: (question, given) => {
    const text = (given[0] ?? '').trim().slice(0, MAX_CHARACTERS);
    const words = plain(text);
    if (words === '') return undefined;
    const has = (phrase: string) => plain(phrase) !== '' && ` ${words} `.includes(` ${plain(phrase)} `);
    return ruled(question, [text], ({ accepts = [], rejects = [] }) => (accepts.length === 0 || accepts.some(has)) && !rejects.some(has));
  },
};

/** Judges an answer; undefined if it is invalid. */
export function judge(question: Question, given: readonly string[]): AnswerGrade | undefined {
  const judged = RULES[question.kind](question, given);
  if (judged === undefined || question.isUngraded !== true) return judged;
  return { given: judged.given, fits: judged.fits };
}

function chosen({ options }: Question, given: readonly string[]): QuestionOption[] {
  return options.filter(({ name }) => given.includes(name));
}

function one(question: Question, given: readonly string[]): Required<AnswerGrade> | undefined {
  const [option, more] = chosen(question, given);
  if (option === undefined || more !== undefined) return undefined;
  return { given: [option.name], isRight: option.isRight, fits: [option.name] };
}

function several(question: Question, given: readonly string[]): Required<AnswerGrade> | undefined {
  const all = chosen(question, given);
  const names = all.map(({ name }) => name);
  if (all.length === 0) return undefined;
  return { given: names, isRight: question.options.every((option) => option.isRight === all.includes(option)), fits: names.length === 1 ? names : [] };
}

function order({ options }: Question, given: readonly string[]): Required<AnswerGrade> | undefined {
  if (given.length !== options.length || options.some(({ name }) => !given.includes(name))) return undefined;
  return { given: [...given], isRight: options.every(({ name }, i) => given[i] === name), fits: [] };
}

/** Returns the partner of an option by name; undefined if it has none. */
const partnerOf = (options: readonly QuestionOption[], name: string | undefined): string | undefined => options.find((option) => option.name === name)?.partner;

/** Returns true if the option at an index was given its partner, or another with the same text. */
export function isMatched({ options }: Question, given: readonly string[], place: number): boolean {
  return partnerOf(options, given[place]) === options[place]?.partner;
}

function match(question: Question, given: readonly string[]): Required<AnswerGrade> | undefined {
  const { options } = question;
  const known = options.map((_, i) => (partnerOf(options, given[i]) === undefined ? '' : (given[i] ?? '')));
  if (known.every((name) => name === '')) return undefined;
  return { given: known, isRight: options.every((_, i) => isMatched(question, known, i)), fits: [] };
}

/** Returns true if the gap of the option at an index is filled correctly. */
export function isFilled({ options }: Question, given: readonly string[], place: number): boolean {
  const written = plain(given[place] ?? '');
  return (options[place]?.accepts ?? []).some((accepted) => plain(accepted) === written);
}

function gap(question: Question, given: readonly string[]): Required<AnswerGrade> | undefined {
  const written = question.options.map((_, i) => (given[i] ?? '').trim().slice(0, MAX_CHARACTERS));
  if (written.every((text) => plain(text) === '')) return undefined;
  return { given: written, isRight: question.options.every((_, i) => isFilled(question, written, i)), fits: [] };
}

/** Judges by the first matching option. */
function ruled({ options }: Question, given: readonly string[], takes: (option: QuestionOption) => boolean): Required<AnswerGrade> {
  const option = options.find(takes);
  return { given, isRight: option?.isRight === true, fits: option === undefined ? [] : [option.name] };
}
