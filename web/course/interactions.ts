/** Answers as SCORM has them: `cmi.interactions` of 1.2 (Run-Time Environment, 3.4.7) and of 2004 (4.2.9). */

import type { Answered } from '../element/base/answers.js';
import type { Question } from '../element/base/questions.js';
import type { Reply } from './report.js';
import { gapsText, identifierOf, numberText, pairsOf, patternsOf, placesOf, responseOf, rightNames, TYPES, type Limits } from './responses.js';
import { BETWEEN, decimal, plain } from './texts.js';

/** Elements and their values, in the order in which they have to be set. */
export type Elements = readonly (readonly [element: string, value: string])[];

/** Single characters for options and their matches, as SCORM 1.2 requires. */
const SOURCES = 'abcdefghijklmnopqrstuvwxyz0123456789';
const TARGETS = '1234567890abcdefghijklmnopqrstuvwxyz';
/** Maximum length of a text and of a weight that every SCORM 1.2 system accepts. */
const MAX_FEEDBACK = 255;
const MAX_WEIGHT = 100;
const LIMITS_12: Limits = { items: SOURCES.length, gaps: Infinity, gapLength: MAX_FEEDBACK, textLength: MAX_FEEDBACK, patterns: 10 };
const LIMITS_2004: Limits = { items: 36, gaps: 10, gapLength: 250, textLength: 4000, patterns: 5 };

const two = (n: number): string => String(n).padStart(2, '0');

/** Returns a question's name as an identifier: invalid characters are written by their code. */
function idOf({ name }: Question): string {
  const id = name.replaceAll(/[^\w.-]/gu, (character) => (character === ' ' ? '-' : `-${character.codePointAt(0)?.toString(16) ?? ''}`));
  return id.slice(0, 250) || 'question';
}

/** Elements that have a value. */
const known = (elements: readonly (readonly [string, string | undefined])[]): Elements =>
  elements.filter((element): element is readonly [string, string] => element[1] !== undefined);

/** Returns true if names are written out: SCORM 1.2 has no characters for so many options. */
const isSpelled = ({ kind, options }: Question): boolean => kind === 'gap' || kind === 'text' || (kind !== 'number' && options.length > SOURCES.length);

function type12(question: Question): string {
  return isSpelled(question) ? 'fill-in' : TYPES[question.kind];
}

/** Returns the given names as characters. */
function characters(question: Question, given: readonly string[]): string {
  const parts =
    question.kind === 'match'
      ? pairsOf(question, given).map(([source, target]) => `${SOURCES[source] ?? ''}.${TARGETS[target] ?? ''}`)
      : placesOf(question, given).map((place) => SOURCES[place] ?? '');
  return parts.join(',');
}

/** Returns the given answers by name, for questions for which single characters are insufficient. */
function names(question: Question, given: readonly string[]): string {
  const identifier = (place: number) => identifierOf(question.options[place]?.name ?? '', place);
  const parts =
    question.kind === 'match' ? pairsOf(question, given).map(([source, target]) => `${identifier(source)}.${identifier(target)}`) : placesOf(question, given).map(identifier);
  return parts.join(',').slice(0, MAX_FEEDBACK);
}

function response12({ question, answered: { given } }: Reply): string | undefined {
  if (question.kind === 'gap' || question.kind === 'text') return plain12(given) || undefined;
  if (question.kind === 'number') return numberText(given);
  return (isSpelled(question) ? names : characters)(question, given) || undefined;
}

/** Texts that were written, as one. */
function plain12(given: readonly string[]): string {
  return gapsText(given, LIMITS_12)
    .slice(0, MAX_FEEDBACK)
    .replace(/[\uD800-\uDBFF]$/, '');
}

function patterns12(question: Question): string[] {
  switch (question.kind) {
    case 'gap':
    case 'text':
      return patternsOf(question, LIMITS_12).filter((pattern) => pattern.length <= MAX_FEEDBACK);
    case 'number': {
      // A number is right or wrong in 1.2; it has no ranges.
      const right = question.options.filter(({ isRight }) => isRight);
      const exact = right.flatMap(({ least, most }) => (least !== undefined && least === most ? (decimal(least) ?? []) : []));
      return exact.length === right.length ? exact : [];
    }
    default: {
      const pattern = (isSpelled(question) ? names : characters)(question, rightNames(question));
      return pattern === '' || pattern.length >= MAX_FEEDBACK ? [] : [pattern];
    }
  }
}

/**
 * Returns the result of an answer in both versions; `wrong` is their word for a wrong one. Ungraded answers are neutral, partly right ones have their points.
 */
function resultOf({ isRight, points }: Answered, wrong: 'wrong' | 'incorrect'): string {
  if (isRight === undefined) return 'neutral';
  if (isRight) return 'correct';
  return points > 0 ? (decimal(points) ?? wrong) : wrong;
}

/** Returns the `n`th interaction of SCORM 1.2. */
export function interaction12(n: number, reply: Reply): Elements {
  const at = `cmi.interactions.${n}`;
  const { question, answered } = reply;
  const time = new Date(reply.atMs);
  const secs = Math.floor(reply.latencyMs / 1000);
  return known([
    [`${at}.id`, idOf(question)],
    [`${at}.type`, type12(question)],
    [`${at}.time`, `${two(time.getHours())}:${two(time.getMinutes())}:${two(time.getSeconds())}`],
    [`${at}.weighting`, question.points <= MAX_WEIGHT ? decimal(question.points) : undefined],
    ...patterns12(question).map((pattern, i) => [`${at}.correct_responses.${i}.pattern`, pattern] as const),
    [`${at}.student_response`, response12(reply)],
    [`${at}.result`, resultOf(answered, 'wrong')],
    [`${at}.latency`, `${String(Math.min(9999, Math.floor(secs / 3600))).padStart(4, '0')}:${two(Math.floor(secs / 60) % 60)}:${two(secs % 60)}`],
  ]);
}

/** Pattern of texts that systems split at commas even without delimiters: ten parts are too many, and a `{` begins a part as well as a text. */
const BROKEN_BY_COMMAS = /(,[^,]*){10}|,\{/;
const response2004 = (reply: Reply): string | undefined => {
  const text = responseOf(reply, LIMITS_2004);
  if (text === undefined || TYPES[reply.question.kind] !== 'fill-in' || text.includes(BETWEEN)) return text;
  return BROKEN_BY_COMMAS.test(text) ? text.replaceAll(',', ';') : text;
};

/** Returns true if systems accept a pattern: some reject equal parts, surrounding spaces, and commas in a single text. */
function isTaken(pattern: string): boolean {
  const parts = pattern.split(BETWEEN);
  return new Set(parts).size === parts.length && parts.every((part) => part.trim() === part) && (parts.length > 1 || !pattern.includes(','));
}

function patterns2004(question: Question): string[] {
  const patterns = patternsOf(question, LIMITS_2004).filter(isTaken);
  // It has one range of numbers.
  return question.kind === 'number' && patterns.length > 1 ? [] : patterns;
}

/** Returns the `n`th interaction of SCORM 2004. */
export function interaction2004(n: number, reply: Reply): Elements {
  const at = `cmi.interactions.${n}`;
  const { question, answered } = reply;
  return known([
    [`${at}.id`, idOf(question)],
    [`${at}.type`, TYPES[question.kind]],
    // A timestamp with a time zone requires fractions, of two digits.
    [`${at}.timestamp`, new Date(reply.atMs).toISOString().replace(/\dZ$/, 'Z')],
    [`${at}.weighting`, decimal(question.points)],
    ...patterns2004(question).map((pattern, i) => [`${at}.correct_responses.${i}.pattern`, pattern] as const),
    [`${at}.learner_response`, response2004(reply)],
    [`${at}.result`, resultOf(answered, 'incorrect')],
    [`${at}.latency`, `PT${Math.round(reply.latencyMs / 10) / 100}S`],
    [`${at}.description`, plain(question.prompt, 250)],
  ]);
}
