/** Feedback after the final answer to a question: the author's text, otherwise the result and the correct answer. */

import { gapsOf } from './judge.js';
import { LIVE, type TakenBranch } from './lesson.js';
import { readOf } from './question-fields.js';
import type { QuestionWords } from './question-words.js';
import type { Question, QuestionOption } from '../base/questions.js';

/** Returns the text after an answer; empty if there is none because the story itself, or the live sender of the question, responds. */
export function feedbackOf({ question, answered, isSilent }: TakenBranch, words: QuestionWords): string {
  const { isFinal, isRight } = answered;
  if (!isFinal) return '';
  const { any = '', right = any, wrong = any } = question.feedback ?? {};
  const written = isRight === undefined ? any : isRight ? right : wrong;
  if (written !== '') return written;
  return isSilent && question.order < LIVE ? usual({ question, answered }, words) : '';
}

function usual({ question, answered: { given, isRight, points } }: Pick<TakenBranch, 'question' | 'answered'>, words: QuestionWords): string {
  if (isRight === undefined) return given.length === 0 ? words.over : words.thanks;
  if (isRight) return words.right;
  const outcome = given.length === 0 ? words.over : points > 0 ? words.partly(points, question.points) : words.wrong;
  const is = rightAnswer(question, words);
  return is === '' ? outcome : `${outcome} ${words.rightIs(is)}`;
}

/** Returns the correct answer as readable text; empty if it cannot be expressed in words. */
export function rightAnswer(question: Question, words: QuestionWords): string {
  const { kind, options } = question;
  const right = options.filter(({ isRight }) => isRight);
  switch (kind) {
    case 'choice':
    case 'several':
    case 'point':
      return right.map(readOf).join('; ');
    case 'order':
      return options.map((option, i) => `${i + 1}. ${readOf(option)}`).join(' ');
    case 'match':
      return options.map((option) => `${readOf(option)} – ${option.partner ?? ''}`).join('; ');
    case 'gap':
      return gapsOf(question)
        .map((part) => (typeof part === 'string' ? part : (part.accepts?.[0] ?? '…')))
        .join('');
    case 'number':
      return right.map((option) => rangeOf(option, words)).join('; ');
    case 'text':
      return right.flatMap(({ accepts = [] }) => accepts.slice(0, 1)).join('; ');
  }
}

function rangeOf({ least, most }: QuestionOption, { atLeast, atMost, between }: QuestionWords): string {
  if (least === most) return String(least ?? '');
  if (least === undefined) return atMost(most ?? Infinity);
  return most === undefined ? atLeast(least) : between(least, most);
}
