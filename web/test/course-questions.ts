/** Random questions of all kinds and random answers to them, for tests. */

import type { Reply } from '../course/report.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';

/** Returns a generator of random numbers from 0 to 1, the same for the same seed. */
export function random(seed: number): () => number {
  let state = seed * 2654435761 + 1;
  return () => {
    state = Math.imul(state ^ (state >>> 15), 0x2c1b3c6d) + 0x9e3779b9;
    return ((state ^ (state >>> 13)) >>> 0) / 2 ** 32;
  };
}

export type Next = () => number;

export const KINDS: readonly QuestionKind[] = ['choice', 'several', 'order', 'match', 'gap', 'number', 'point', 'text'];
const PIECES = ['frog', 'a, b', ' ', '[,]', '[.]', '[:]', '[[,],]', '{lang=en}', '{case_matters=true}', ',', '.', ':', '🐸', '👩‍👩‍👧', '\uD83D', '\uDC38', '<b>&amp;</b>'];
const MORE = ['"', "'", '\\', '\n', '\r\n', '\t', '\u0000', '\u2028', '日本', 'ä', '{', '}', '0', 'true', ']]>', '%20', '\u202E'];
const LARGE = '🐸[,]x'.repeat(170_000);

export const oneOf = <T>(next: Next, list: readonly T[]): T => list[Math.floor(next() * list.length)] as T;

/** Returns a text of pieces that formats often mishandle; one in fifty is 1 MB long. */
export function randomText(next: Next): string {
  if (next() < 0.02) return LARGE;
  const count = next() < 0.1 ? 300 : Math.floor(6 * next());
  return Array.from({ length: count }, () => oneOf(next, next() < 0.5 ? PIECES : MORE)).join('');
}

/** Returns random names, not all of them identifiers, some similar to placeholders. */
function randomName(next: Next, index: number): string {
  const kind = next();
  if (kind < 0.7) return `name${index}`;
  if (kind < 0.8) return `option-${Math.floor(5 * next())}.${index}`;
  return kind < 0.9 ? `${randomText(next).slice(0, 300)}${index}` : `option-${index + 2}`;
}

const NUMBERS = [0, 1, -1, 2.5, 1e-7, 0.1 + 0.2, 123_456.789, -40, 1e9, 1e300, -1e-300];

function randomOption(next: Next, kind: QuestionKind, name: string, texts: readonly string[]): QuestionOption {
  const [a, b] = [oneOf(next, NUMBERS), oneOf(next, NUMBERS)].sort((x, y) => x - y) as [number, number];
  const isAll = kind === 'order' || kind === 'match' || kind === 'gap';
  return {
    name,
    text: randomText(next),
    isRight: isAll || next() < 0.4,
    ...(kind === 'match' && next() < 0.9 ? { partner: oneOf(next, texts) } : {}),
    ...(kind === 'gap' || kind === 'text' ? { accepts: Array.from({ length: Math.floor(4 * next()) }, () => oneOf(next, ['is', 'are', 'a, b', randomText(next)])) } : {}),
    ...(kind === 'number' && next() < 0.8 ? { least: a } : {}),
    ...(kind === 'number' && next() < 0.8 ? { most: next() < 0.3 ? a : b } : {}),
    ...(kind === 'point' ? { at: 'l_wrist' } : {}),
  };
}

export function randomQuestion(next: Next, name: string, kind: QuestionKind = oneOf(next, KINDS)): Question {
  const count = next() < 0.05 ? 45 : 1 + Math.floor(8 * next());
  const names = new Set(Array.from({ length: count }, (_, i) => randomName(next, i)));
  const texts = Array.from({ length: 1 + count }, () => randomText(next));
  const points = oneOf(next, [0, 1, 2, 0.5, 0.1, 3, 10, 150, 1000]);
  const options = [...names].map((it) => randomOption(next, kind, it, texts));
  const asked = { order: 0, name, kind, atSecs: 1, endSecs: 2, prompt: randomText(next), points, tries: 3, options, answers: [] };
  return next() < 0.2 ? { ...asked, isUngraded: true, points: 0, tries: 1 } : asked;
}

/** Returns a list in another order. */
const shuffled = <T>(next: Next, list: readonly T[]): T[] =>
  list
    .map((it) => [next(), it] as const)
    .sort(([a], [b]) => a - b)
    .map(([, it]) => it);

export function randomGiven(next: Next, { kind, options }: Question): string[] {
  if (next() < 0.08) return [];
  const names = options.map(({ name }) => name);
  switch (kind) {
    case 'order':
      return shuffled(next, names);
    case 'match':
      return names.map(() => oneOf(next, names));
    case 'several': {
      const chosen = names.filter(() => next() < 0.5);
      return chosen.length > 0 ? chosen : names.slice(0, 1);
    }
    case 'gap':
      return names.map(() => randomText(next));
    case 'number':
      return [next() < 0.2 ? randomText(next) : String(oneOf(next, NUMBERS)).replace('.', next() < 0.3 ? ',' : '.')];
    case 'text':
      return [randomText(next)];
    default:
      return [oneOf(next, names)];
  }
}

export function randomReply(next: Next, question: Question): Reply {
  const given = { fits: [], name: question.name, given: randomGiven(next, question), tries: 1 };
  const isRight = next() < 0.5;
  const answered = question.isUngraded
    ? { ...given, points: 0, isFinal: true }
    : { ...given, isRight, points: isRight ? question.points : next() < 0.3 ? Math.floor(33 * question.points) / 100 : 0, isFinal: isRight };
  return { question, answered, atMs: Date.now(), latencyMs: 1e6 * next() };
}

/** Returns a text without parts that formats may change: spaces, control characters, surrogate halves, and commas that became semicolons. */
export const squashed = (text: string): string =>
  text
    .slice(0, 20_000)
    .replaceAll(/[\s\p{Cc}\p{Surrogate}\uFFFD]/gu, '')
    .replaceAll(',', ';');
