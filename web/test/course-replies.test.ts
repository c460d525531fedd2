/** Answers to questions of all kinds, as accepted by third-party SCORM systems. */

import { Scorm12API, Scorm2004API } from 'scorm-again';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { interaction12, interaction2004, type Elements } from '../course/interactions.js';
import { NOTHING } from '../course/memory.js';
import type { Reply, Report } from '../course/report.js';
import { Scorm, SCORM_12, SCORM_2004 } from '../course/scorm.js';
import { decimal, plain } from '../course/texts.js';
import { numberOf } from '../element/lesson/judge.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';
import { KINDS, random, randomQuestion, randomReply, randomText, squashed } from './course-questions.js';
import { sized } from './tier.js';

type Api = { [method: string]: (...given: string[]) => string } & { renderCMIToJSONObject(): object };
type SentStatement = { readonly [part: string]: string } & { readonly correct_responses: { readonly [n: string]: { readonly pattern: string } } };

const SYSTEMS = [
  { name: 'SCORM 1.2', version: SCORM_12, object: 'API', prefix: 'LMS', open: () => new Scorm12API({ autocommit: false, logLevel: 5 }), response: 'student_response' },
  {
    name: 'SCORM 2004',
    version: SCORM_2004,
    object: 'API_1484_11',
    prefix: '',
    open: () => new Scorm2004API({ autocommit: false, logLevel: 5 }),
    response: 'learner_response',
  },
] as const;
type System = (typeof SYSTEMS)[number];

/** Runs a session with a system; `faults` are its rejections. */
async function session({ version, object, prefix, open }: System): Promise<{ record: Scorm; api: Api; faults: string[] }> {
  const api = open() as unknown as Api;
  const faults: string[] = [];
  const strict = {
    ...Object.fromEntries(
      ['Initialize', 'GetValue', 'Commit', 'Finish', 'Terminate', 'GetLastError'].map((it) => [`${prefix}${it}`, (...given: string[]) => api[`${prefix}${it}`]!(...given)]),
    ),
    [`${prefix}SetValue`]: (element: string, value: string) => {
      const taken = api[`${prefix}SetValue`]!(element, value);
      const error = api[`${prefix}GetLastError`]!();
      if (taken !== 'true' || error !== '0') faults.push(`${element}: ${error}: ${JSON.stringify(value.slice(0, 100))}`);
      return taken;
    },
  };
  const top: { [name: string]: unknown } = { [object]: strict };
  top['parent'] = top;
  const record = new Scorm(version, 'x', undefined, top as unknown as Window);
  await record.open();
  return { record, api, faults };
}

const reportOf = (replies: readonly Reply[], questions: readonly Question[]): Report => {
  const most = questions.reduce((sum, { points }) => sum + points, 0);
  const points = replies.reduce((sum, { answered }) => sum + answered.points, 0);
  const score = { points: Math.min(points, most), most };
  return {
    placeSecs: 1.5,
    durationSecs: 60,
    progress: 0.5,
    seen: [],
    isComplete: true,
    isSettled: true,
    memory: NOTHING,
    score: most > 0 ? score : undefined,
    isPassed: points >= most / 2,
  };
};

const SIGNS = 'abcdefghijklmnopqrstuvwxyz0123456789';
const TARGETS = '1234567890abcdefghijklmnopqrstuvwxyz';

/** Returns the index of an option by its identifier. */
function placeOf({ options }: Question, told: string, signs: string | undefined): number {
  if (signs !== undefined) return signs.indexOf(told);
  const place = /^option-(\d+)$/.exec(told)?.[1];
  return place === undefined ? options.findIndex(({ name }) => name === told) : Number(place) - 1;
}

/** Checks that the stored response means the given answer. */
function expectHeld({ question, answered: { given } }: Reply, told: string, system: System): void {
  const { kind, options } = question;
  const is12 = system.version === SCORM_12;
  if (kind === 'number') {
    const number = numberOf(given[0] ?? '') ?? NaN;
    if (Math.abs(number) < 1e10) expect(Number(told)).toBeCloseTo(number, 6);
    else expect(told).toBe('');
  } else if (kind === 'gap' || kind === 'text') {
    const parts = told.split('[,]');
    expect(told.length).toBeLessThanOrEqual(is12 ? 255 : kind === 'text' ? 4000 : 10 * 253);
    expect(told).not.toMatch(/\p{Surrogate}/u);
    if (!is12 || told.length < 240) parts.forEach((part, i) => expect(squashed(given[i] ?? '').startsWith(squashed(part))).toBe(true));
    if (told !== '' && told.length < 240) expect(parts.map(squashed)).toEqual(given.slice(0, is12 ? given.length : 10).map(squashed));
  } else if (is12 && options.length > SIGNS.length) {
    expect(told.length).toBeLessThanOrEqual(255);
  } else {
    const parts = told === '' ? [] : told.split(is12 ? ',' : '[,]');
    const places = parts.map((part) => part.split(is12 ? '.' : '[.]'));
    if (kind === 'match') {
      const pairs = parts
        .map((part) => part.split(is12 ? /(?<=^.)\./ : '[.]'))
        .map(([a, b]) => [placeOf(question, a!, is12 ? SIGNS : undefined), placeOf(question, b!, is12 ? TARGETS : undefined)]);
      const meant = given.map((name, i) => [i, options.find((it) => it.name === name)?.partner]).filter(([, partner]) => partner !== undefined);
      expect(pairs.map(([source, target]) => [source, options[target!]?.partner])).toEqual(meant.slice(0, 36));
    } else {
      expect(places.length).toBe(Math.min(36, given.length));
      expect(parts.map((part) => options[placeOf(question, part, is12 ? SIGNS : undefined)]?.name)).toEqual(given.slice(0, 36));
    }
  }
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

for (const system of SYSTEMS) {
  it(`${system.name} takes all that ${sized(200, 1000)} random learners answer, and holds that`, async () => {
    for (let learner = 0; learner < sized(200, 1000); learner++) {
      const next = random(learner + 1);
      const { record, api, faults } = await session(system);
      const questions = Array.from({ length: 4 }, (_, i) => randomQuestion(next, next() < 0.5 ? `question ${i}` : `${randomText(next)}${i}`));
      const replies = Array.from({ length: 6 }, (_, i) => randomReply(next, questions[i % 4]!));
      for (const reply of replies) {
        record.reply(reply);
        record.save(reportOf([reply], questions));
        record.keep();
      }
      record.close();
      expect(faults, `learner ${learner}`).toEqual([]);
      const { cmi } = JSON.parse(JSON.stringify(api.renderCMIToJSONObject())) as { cmi: { interactions: { [n: string]: SentStatement } } };
      replies.forEach((reply, n) => expectHeld(reply, cmi.interactions[n]?.[system.response] ?? '', system));
      expect(Object.keys(cmi.interactions)).toHaveLength(replies.length);
    }
  }, 120_000);
}

const option = (name: string, more: Partial<QuestionOption> = {}): QuestionOption => ({ name, text: name, isRight: true, ...more });
/** Continuation of an answer, irrelevant here. */
const NONE = { fits: [] };
const replyTo = (kind: QuestionKind, options: readonly QuestionOption[], given: readonly string[]): Reply => ({
  question: { order: 0, name: 'q', kind, atSecs: 0, endSecs: 1, prompt: 'What?', points: 1, tries: 1, options, answers: [] },
  answered: { ...NONE, name: 'q', given, isRight: false, points: 0, tries: 1, isFinal: true },
  atMs: 0,
  latencyMs: 0,
});
/** Returns type, response, and the correct response. */
function told(elements: Elements): [string | undefined, string | undefined, string[]] {
  const value = (end: RegExp) => elements.filter(([element]) => end.test(element)).map(([, text]) => text);
  return [value(/\.type$/)[0], value(/_response$/)[0], value(/pattern$/)];
}

describe('An answer', () => {
  const wrong = option('c', { isRight: false });
  const cases: readonly [Reply, ReturnType<typeof told>, ReturnType<typeof told>][] = [
    [replyTo('choice', [option('x'), wrong], ['c']), ['choice', 'b', ['a']], ['choice', 'c', ['x']]],
    [replyTo('several', [option('x'), wrong, option('y')], ['y', 'x']), ['choice', 'a,c', ['a,c']], ['choice', 'x[,]y', ['x[,]y']]],
    [replyTo('point', [wrong, option('é')], ['é']), ['choice', 'b', ['b']], ['choice', 'option-2', ['option-2']]],
    [replyTo('order', [option('x'), option('y'), option('z')], ['z', 'x', 'y']), ['sequencing', 'c,a,b', ['a,b,c']], ['sequencing', 'z[,]x[,]y', ['x[,]y[,]z']]],
    [
      replyTo('match', [option('x', { partner: 'Pond' }), option('y', { partner: 'Tree' })], ['y', 'x']),
      ['matching', 'a.2,b.1', ['a.1,b.2']],
      ['matching', 'x[.]y[,]y[.]x', ['x[.]x[,]y[.]y']],
    ],
    [
      // An option that should stay unmatched.
      replyTo('match', [option('x'), option('y', { partner: 'Tree' })], ['y', '']),
      ['matching', 'a.2', ['b.2']],
      ['matching', 'x[.]y', ['y[.]y']],
    ],
    [
      // Partners that read the same are one.
      replyTo('match', [option('x', { partner: 'Pond' }), option('y', { partner: 'Pond' })], ['y']),
      ['matching', 'a.1', ['a.1,b.1']],
      ['matching', 'x[.]x', ['x[.]x[,]y[.]x']],
    ],
    [
      replyTo('gap', [option('who', { accepts: ['frog', 'toad'] }), option('where', { accepts: ['leaf'] })], ['toad', 'a[,]b']),
      ['fill-in', 'toad[,]a[ , ]b', ['frog[,]leaf', 'toad[,]leaf']],
      ['fill-in', 'toad[,]a[ , ]b', ['frog[,]leaf', 'toad[,]leaf']],
    ],
    [replyTo('number', [option('two', { least: 2, most: 2 })], ['2,50']), ['numeric', '2.5', ['2']], ['numeric', '2.5', ['2[:]2']]],
    [replyTo('number', [option('more', { least: 3 })], ['1e-7']), ['numeric', '0.0000001', []], ['numeric', '0.0000001', ['3[:]']]],
    [replyTo('number', [option('all')], ['many']), ['numeric', undefined, []], ['numeric', undefined, []]],
    // The first matching rule decides, so the correct range has a gap.
    [replyTo('number', [{ ...wrong, least: 2, most: 2 }, option('some', { least: 0, most: 5 })], ['2']), ['numeric', '2', []], ['numeric', '2', []]],
    [
      replyTo('text', [option('well', { accepts: ['cold', 'winter'] })], ['It was\ncold.']),
      ['fill-in', 'It was cold.', ['cold', 'winter']],
      ['long-fill-in', 'It was cold.', ['cold', 'winter']],
    ],
    [replyTo('choice', [option('x')], []), ['choice', undefined, ['a']], ['choice', undefined, ['x']]],
  ];

  it('of each kind has the form that each version has for it', () => {
    for (const [reply, in12, in2004] of cases) expect([told(interaction12(0, reply)), told(interaction2004(0, reply))]).toEqual([in12, in2004]);
  });

  it('of one gap with commas is not taken for several that are wrong', () => {
    const of = (text: string) => told(interaction2004(0, replyTo('gap', [option('x')], [text])))[1];
    expect([of('a, b'), of(`${'a,'.repeat(9)}b`), of(`${'a,'.repeat(10)}b`), of('a,{b')]).toEqual(['a, b', 'a,a,a,a,a,a,a,a,a,b', 'a;a;a;a;a;a;a;a;a;a;b', 'a;{b']);
  });

  it('to more options than 1.2 has characters is told by names, none of which is another', () => {
    const options = Array.from({ length: 40 }, (_, i) => option(`n${i}`, { isRight: i === 36 }));
    expect(told(interaction12(0, replyTo('choice', options, ['n36'])))).toEqual(['fill-in', 'n36', ['n36']]);
    expect(told(interaction12(0, replyTo('choice', options.slice(0, 36), ['n35'])))).toEqual(['choice', '9', []]);
  });

  it('is cut at a whole character', () => {
    expect([plain('ab🐸', 3), plain('ab🐸', 4), plain('\uDC38a\uD83D', 9), plain(' {a}\u0000[:] ', 20)]).toEqual(['ab', 'ab🐸', '\uFFFDa\uFFFD', ' {a} [ : ]']);
    expect([decimal(1e10), decimal(NaN), decimal(-1e-30), decimal(0.1 + 0.2), decimal(-1.5e-7)]).toEqual([undefined, undefined, '0', '0.30000000000000004', '-0.00000015']);
  });
});

it('to what is not graded is neutral, and nothing is told to be right', () => {
  for (const kind of KINDS) {
    const reply = replyTo(kind, [option('a', { partner: 'A', accepts: ['x'], least: 1 }), option('b', { partner: 'B', accepts: ['y'], least: 2 })], ['a']);
    const { isRight: _, ...answered } = reply.answered;
    const survey: Reply = { ...reply, question: { ...reply.question, isUngraded: true, points: 0 }, answered };
    for (const interaction of [interaction12, interaction2004]) {
      const elements = interaction(0, survey);
      expect([elements.find(([element]) => element.endsWith('result'))?.[1], told(elements)[2]], kind).toEqual(['neutral', []]);
    }
  }
});

it('that is right in part has its points for a result', () => {
  const reply = replyTo('several', [option('a'), option('b')], ['a']);
  for (const [points, results] of [
    [0, ['wrong', 'incorrect']],
    [1.33, ['1.33', '1.33']],
  ] as const) {
    const made = [interaction12, interaction2004].map((interaction) => interaction(0, { ...reply, answered: { ...reply.answered, points } }));
    expect(made.map((elements) => elements.find(([element]) => element.endsWith('result'))?.[1])).toEqual(results);
  }
});

it('has patterns within the limits of 2004, and no two that are the same', () => {
  const accepts = ['a', 'b', 'c', 'a'];
  const [, , patterns] = told(interaction2004(0, replyTo('gap', [option('x', { accepts }), option('y', { accepts: ['d', 'e'] })], [])));
  expect(patterns).toEqual(['a[,]d', 'a[,]e', 'b[,]d', 'b[,]e', 'c[,]d']);
});
