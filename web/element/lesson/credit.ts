/** Points of an answer: all, none, or a share if its parts count separately. */

import { isFilled, isMatched, type AnswerGrade } from './judge.js';
import type { Question } from '../base/questions.js';

/** Precision of reported points: hundredths, readable by records and people. */
const STEPS = 100;
/** Sums of fractions are a little less than they mean. */
const NEARLY = 1e-6;

/** Returns the points of an answer: from 0 to those of the question, and all of them only if it is right. */
export function pointsOf(question: Question, { given, isRight }: AnswerGrade): number {
  const { points, isPartial } = question;
  if (isRight === true) return points;
  if (isRight === undefined || isPartial !== true) return 0;
  const part = Math.floor(points * shareOf(question, given) * STEPS + NEARLY) / STEPS;
  return part < points ? part : 0;
}

/** Returns the correct share of an answer, 0 to 1. */
function shareOf(question: Question, given: readonly string[]): number {
  const { kind, options } = question;
  const share = (isIt: (given: readonly string[], place: number) => boolean) => options.filter((_, place) => isIt(given, place)).length / options.length;
  switch (kind) {
    case 'several': {
      // Choosing all options shows no knowledge: wrong options subtract as much as right ones add.
      const right = options.filter(({ isRight }) => isRight).length;
      const chosen = options.filter(({ name }) => given.includes(name));
      const gained = chosen.reduce((sum, { isRight }) => sum + (isRight ? 1 : -1), 0);
      return right > 0 ? Math.max(0, gained) / right : 0;
    }
    case 'match':
      return share((all, place) => isMatched(question, all, place));
    case 'gap':
      return share((all, place) => isFilled(question, all, place));
    case 'order': {
      // One moved option does not make all options after it wrong.
      const pairs = options.slice(1).filter(({ name }, i) => given.indexOf(name) === given.indexOf(options[i]?.name ?? '') + 1 && given.includes(name));
      return options.length > 1 ? pairs.length / (options.length - 1) : 0;
    }
    default:
      return 0;
  }
}
