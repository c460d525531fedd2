/** Answers, passing and failing, as received by a record store. */

import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { questionId } from '../course/answered.js';
import { NOTHING } from '../course/memory.js';
import type { Reply, Report } from '../course/report.js';
import { XapiRecord } from '../course/xapi.js';
import type { Question, QuestionKind, QuestionOption } from '../element/base/questions.js';
import { random, randomQuestion, randomReply, randomText, type Next } from './course-questions.js';
import { faultsOf, faultsOfOrder, verbOf, type SentStatement } from './course-statements.js';
import { COURSE, FakeStore, launchOf, memoryAt, prepare, report, settled, shelf } from './course-store.js';
import { sized } from './tier.js';

let store: FakeStore;
const told = (): SentStatement[] => store.statements as unknown as SentStatement[];
const begin = (mode = 'Normal', more: object = {}): void => {
  store = new FakeStore();
  prepare(store, mode, more);
  vi.stubGlobal('fetch', store.fetch);
};

beforeEach(() => {
  vi.useFakeTimers();
  begin();
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const judged = (points: number, isPassed: boolean | undefined, isComplete = true): Report => ({
  ...report(30, isComplete),
  score: { points, most: 4 },
  isSettled: isPassed !== undefined,
  isPassed,
});
const option = (name: string, more: Partial<QuestionOption> = {}): QuestionOption => ({ name, text: `Text ${name}`, isRight: true, ...more });
/** Continuation of an answer, irrelevant here. */
const NONE = { fits: [] };
const replyTo = (kind: QuestionKind, options: readonly QuestionOption[], given: readonly string[]): Reply => {
  const question: Question = { order: 0, name: 'who sang?', kind, atSecs: 0, endSecs: 1, prompt: 'Who?', points: 2, tries: 1, options, answers: [] };
  return { question, answered: { ...NONE, name: question.name, given, isRight: true, points: 2, tries: 1, isFinal: true }, atMs: Date.now(), latencyMs: 1500 };
};

/** Runs one visit of a learner; returns the replies in order. */
async function visit(next: Next, record: XapiRecord, questions: readonly Question[]): Promise<Reply[]> {
  const replies: Reply[] = [];
  let points = 0;
  let isComplete = next() < 0.2;
  for (let act = 0; act < 8; act++) {
    store.isAway = next() < 0.4;
    store.losesAnswers = next() < 0.2;
    if (next() < 0.7) {
      const reply = randomReply(next, questions[act % questions.length]!);
      replies.push(reply);
      record.reply(reply);
      points = Math.min(4, points + 1);
    }
    isComplete ||= next() < 0.2;
    // The rules must hold for any statements of a course.
    record.save(judged(points, !isComplete || next() < 0.3 ? undefined : next() < 0.5, isComplete));
    if (next() < 0.3) record.note({ kind: 'paused' });
    if (next() < 0.3) record.keep();
    await settled();
    // The store is away for a minute at most.
    await vi.advanceTimersByTimeAsync(60_000 * next());
  }
  record.close();
  await settled();
  return replies;
}

for (const isCmi5 of [false, true]) {
  describe(`Answers to a record store${isCmi5 ? ', launched by cmi5' : ''}`, () => {
    it(`of ${sized(200, 1000)} random learners are valid, all there, and there once`, async () => {
      for (let learner = 0; learner < sized(200, 1000); learner++) {
        const next = random(learner + 1);
        begin('Normal', next() < 0.5 ? { masteryScore: 0.6 } : {});
        const kept = shelf();
        const questions = Array.from({ length: 3 }, (_, i) => randomQuestion(next, next() < 0.5 ? `question ${i}` : `${randomText(next).slice(0, 200)}${i}`));
        const replies: Reply[] = [];
        for (let time = 0; time < 3; time++) {
          store.isAway = store.losesAnswers = false;
          store.tokens = 0;
          const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
          await record.open();
          await settled();
          replies.push(...(await visit(next, record, questions)));
        }
        store.isAway = store.losesAnswers = false;
        store.tokens = 0;
        await new XapiRecord(launchOf(isCmi5), COURSE, kept).open();
        for (let i = 0; i < 10; i++) await settled();
        expect(store.faults).toEqual([]);
        expect(
          told().flatMap((it) => faultsOf(it, isCmi5)),
          `learner ${learner}`,
        ).toEqual([]);
        expect(faultsOfOrder(told(), isCmi5), `learner ${learner}`).toEqual([]);
        const answered = told().filter((it) => verbOf(it) === 'answered');
        expect(answered.map(({ object }) => object.id)).toEqual(replies.map(({ question }) => questionId(COURSE.activityId, question.name)));
        expect(answered.map(({ result }) => result?.['success'])).toEqual(replies.map((reply) => reply.answered.isRight));
        if (!isCmi5) expect(told().filter((it) => verbOf(it) === 'terminated')).toHaveLength(3);
      }
    }, 120_000);

    it('have the definitions of the standard', async () => {
      const record = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      await record.open();
      record.reply(replyTo('match', [option('x', { partner: 'Pond' }), option('y', { partner: 'Pond' }), option('z', { partner: 'Tree' })], ['z', 'y', 'x']));
      record.reply(replyTo('gap', [option('a', { accepts: ['frog'] })], ['a frog']));
      await settled();
      const [, matched, filled] = told();
      const text = (id: string, en: string) => ({ id, description: { en } });
      expect(matched?.object).toEqual({
        objectType: 'Activity',
        id: 'https://a.example/course/questions/who%20sang%3F',
        definition: {
          type: 'http://adlnet.gov/expapi/activities/cmi.interaction',
          name: { en: 'Who?' },
          description: { en: 'Who?' },
          interactionType: 'matching',
          correctResponsesPattern: ['x[.]x[,]y[.]x[,]z[.]z'],
          source: [text('x', 'Text x'), text('y', 'Text y'), text('z', 'Text z')],
          target: [text('x', 'Pond'), text('z', 'Tree')],
        },
      });
      expect(matched?.result).toEqual({ success: true, response: 'x[.]z[,]y[.]x[,]z[.]x', score: { scaled: 1, raw: 2, min: 0, max: 2 }, duration: 'PT1.5S' });
      expect(filled?.object.definition).toMatchObject({ interactionType: 'fill-in', correctResponsesPattern: ['frog'] });
      expect(matched?.context.contextActivities['parent']).toMatchObject([{ id: COURSE.activityId }]);
      if (isCmi5) expect(matched?.context.contextActivities['grouping']).toEqual([{ id: 'https://a.example/publisher' }]);
    });

    it('pass once in a registration, and fail no more after it', async () => {
      const kept = shelf();
      const visits: readonly (readonly Report[])[] = [
        [judged(1, false), judged(1, false)],
        [judged(1, false)],
        [judged(3, true), judged(1, false)],
        [judged(1, false), judged(4, true)],
      ];
      for (const reports of visits) {
        store.tokens = 0;
        const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
        await record.open();
        for (const it of reports) record.save(it);
        record.close();
        await settled();
      }
      const ends = told().filter((it) => ['passed', 'failed', 'completed'].includes(verbOf(it)));
      expect(ends.map((it) => [verbOf(it), it.result?.['score']])).toEqual([
        ['completed', isCmi5 ? undefined : { scaled: 0.25, raw: 1, min: 0, max: 4 }],
        ['failed', { scaled: 0.25, raw: 1, min: 0, max: 4 }],
        ['passed', { scaled: 0.75, raw: 3, min: 0, max: 4 }],
      ]);
    });

    it('are not said to have passed again where the store was away as that was to be kept', async () => {
      const kept = shelf();
      for (let time = 0; time < 2; time++) {
        store.isAway = false;
        store.tokens = 0;
        const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
        expect(await record.open()).toMatchObject(time === 0 ? { memory: NOTHING, isComplete: false } : { memory: memoryAt(30), isComplete: true });
        await settled();
        store.isAway = true;
        record.save(judged(4, true));
        record.close();
        await settled();
      }
      store.isAway = false;
      store.tokens = 0;
      await new XapiRecord(launchOf(isCmi5), COURSE, kept).open();
      await settled();
      expect(told().map(verbOf)).toEqual(
        // A cmi5 session sends the statements that an earlier one could not send, except its
        // termination.
        isCmi5
          ? ['initialized', 'initialized', 'completed', 'passed', 'initialized']
          : ['initialized', 'completed', 'passed', 'terminated', 'initialized', 'terminated', 'initialized'],
      );
      // The store has the data now; another browser advances the learner, and this one follows.
      for (const shelves of [shelf(), kept]) {
        store.tokens = 0;
        const record = new XapiRecord(launchOf(isCmi5), COURSE, shelves);
        const { memory } = await record.open();
        if (shelves === kept) expect(memory).toEqual({ ...memoryAt(40), session: 2 });
        record.save({ ...judged(4, true), memory: { ...memoryAt(40), session: 2 } });
        record.close();
        await settled();
      }
    });
  });
}

it('the share that a cmi5 system wants is told to the course, and with what follows from it', async () => {
  begin('Normal', { masteryScore: 0.6 });
  const record = new XapiRecord(launchOf(true), COURSE, undefined);
  expect(await record.open()).toMatchObject({ pass: 0.6 });
  record.save(judged(3, true));
  await settled();
  const extension = 'https://w3id.org/xapi/cmi5/context/extensions/masteryscore';
  expect(told().map(({ context }) => context.extensions[extension])).toEqual([undefined, undefined, 0.6]);
  for (const masteryScore of [2, -1, '0.5', null]) {
    begin('Normal', { masteryScore });
    expect(await new XapiRecord(launchOf(true), COURSE, undefined).open()).toMatchObject({ pass: undefined });
  }
});

it('nothing is said of who only looks at it', async () => {
  for (const mode of ['Browse', 'Review']) {
    begin(mode);
    const record = new XapiRecord(launchOf(true), COURSE, shelf());
    await record.open();
    record.note({ kind: 'played' });
    record.reply(replyTo('choice', [option('x')], ['x']));
    record.save(judged(4, true));
    record.close();
    await settled();
    expect(told().map(verbOf)).toEqual(['initialized', 'terminated']);
    expect(store.states.size).toBe(1);
  }
});

it('a question has an address below its course', () => {
  expect(
    ['https://a.example/c', 'https://a.example/c/', 'https://a.example/c?x=1#story', 'urn:uuid:2f1b8a3c', 'https://a.example/#a?b'].map((id) => questionId(id, 'wö/?\uD83D')),
  ).toEqual([
    'https://a.example/c/questions/w%C3%B6%2F%3F%EF%BF%BD',
    'https://a.example/c/questions/w%C3%B6%2F%3F%EF%BF%BD',
    'https://a.example/c/questions/w%C3%B6%2F%3F%EF%BF%BD?x=1#story',
    'urn:uuid:2f1b8a3c/questions/w%C3%B6%2F%3F%EF%BF%BD',
    'https://a.example/questions/w%C3%B6%2F%3F%EF%BF%BD#a?b',
  ]);
});
