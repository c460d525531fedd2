/** Answers as SCORM has them: `cmi.interactions` of 1.2 (Run-Time Environment, 3.4.7) and of 2004 (4.2.9). */

import type { Reply } from './report.js';

/** Elements and their values, in the order in which they have to be set. */
export type Elements = readonly (readonly [element: string, value: string])[];

const LETTERS = 'abcdefghijklmnopqrstuvwxyz0123456789';
const two = (n: number): string => String(n).padStart(2, '0');

/** Options by single letters, all that 1.2 has for a choice. */
function letters({ question }: Reply, names: readonly string[]): string {
  return question.options.flatMap(({ name }, i) => (names.includes(name) ? [LETTERS[i % LETTERS.length] ?? 'a'] : [])).join(',');
}

/** Options by names that 2004 takes for short identifiers. */
function identifiers({ question }: Reply, names: readonly string[]): string {
  return question.options.flatMap(({ name }, i) => (names.includes(name) ? [/^[\w.-]{1,250}$/.test(name) ? name : `option-${i + 1}`] : [])).join('[,]');
}

const rightOf = ({ question }: Reply): string[] => question.options.filter(({ isRight }) => isRight).map(({ name }) => name);
/** A question's name as an identifier. */
const idOf = ({ question }: Reply): string => question.name.replaceAll(/[^\w.-]/g, '-').slice(0, 250);

/** The `n`th interaction of SCORM 1.2. */
export function interaction12(n: number, reply: Reply): Elements {
  const at = `cmi.interactions.${n}`;
  const time = new Date(reply.atMs);
  const secs = Math.floor(reply.latencyMs / 1000);
  return [
    [`${at}.id`, idOf(reply)],
    [`${at}.type`, 'choice'],
    [`${at}.time`, `${two(time.getHours())}:${two(time.getMinutes())}:${two(time.getSeconds())}`],
    [`${at}.weighting`, String(reply.question.points)],
    [`${at}.correct_responses.0.pattern`, letters(reply, rightOf(reply))],
    [`${at}.student_response`, letters(reply, reply.answered.given)],
    [`${at}.result`, reply.answered.isRight ? 'correct' : 'wrong'],
    [`${at}.latency`, `${String(Math.min(9999, Math.floor(secs / 3600))).padStart(4, '0')}:${two(Math.floor(secs / 60) % 60)}:${two(secs % 60)}`],
  ];
}

/** The `n`th interaction of SCORM 2004. */
export function interaction2004(n: number, reply: Reply): Elements {
  const at = `cmi.interactions.${n}`;
  return [
    [`${at}.id`, idOf(reply)],
    [`${at}.type`, 'choice'],
    [`${at}.timestamp`, new Date(reply.atMs).toISOString().replace(/\.\d+Z$/, 'Z')],
    [`${at}.weighting`, String(reply.question.points)],
    [`${at}.correct_responses.0.pattern`, identifiers(reply, rightOf(reply))],
    [`${at}.learner_response`, identifiers(reply, reply.answered.given)],
    [`${at}.result`, reply.answered.isRight ? 'correct' : 'incorrect'],
    [`${at}.latency`, `PT${Math.round(reply.latencyMs / 10) / 100}S`],
    [`${at}.description`, reply.question.prompt.slice(0, 250)],
  ];
}
