/** No learner data is lost, whatever systems and browsers do: kills, reloads, no network, refusals. */

import { Scorm12API, Scorm2004API } from 'scorm-again';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Course } from '../course/course.js';
import type { Record } from '../course/report.js';
import { Scorm, SCORM_12, SCORM_2004 } from '../course/scorm.js';
import type { Shelf } from '../course/shelf.js';
import { BrowserRecord } from '../course/storage.js';
import { XapiRecord } from '../course/xapi.js';
import type { Question } from '../element/base/questions.js';
import { FakePlayer } from './course-learner.js';
import { oneOf, random, type Next } from './course-questions.js';
import { verbOf, type SentStatement } from './course-statements.js';
import { COURSE, FakeStore, launchOf, prepare, settled, shelf } from './course-store.js';
import { sized } from './tier.js';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const QUESTIONS: readonly Question[] = Array.from({ length: 6 }, (_, i) => ({
  order: i,
  name: `q${i}`,
  kind: 'choice',
  atSecs: 5 + 9 * i,
  endSecs: 5 + 9 * i,
  prompt: 'Which?',
  points: 1 + (i % 3),
  tries: 2,
  options: [
    { name: 'yes', text: 'Yes', isRight: true },
    { name: 'no', text: 'No', isRight: false },
  ],
  answers: [],
}));
const MAX_POINTS = QUESTIONS.reduce((sum, { points }) => sum + points, 0);

/** Learning system: its record in each page, its faults, and its data about the learner. */
interface World {
  open(kept: Shelf): Record;
  /** Injects a random fault, or none. */
  trouble(next: Next | undefined): void;
  /** Terminates the page without notice: pending data may be lost. */
  kill(): void;
  /** Returns its points, and the number of answers. */
  score(): number;
  replies(): number;
}

type Api = { [method: string]: (...given: string[]) => string } & { renderCMIToJSONObject(): object; loadFromJSON(data: object, at: string): void };

function scorm(is12: boolean): World {
  let committed: object | undefined;
  let fault: (method: string) => 'false' | 'throws' | undefined = () => undefined;
  const prefix = is12 ? 'LMS' : '';
  const values = (): { core?: { score: { raw: string } }; score: { raw: string }; interactions: object } =>
    (JSON.parse(JSON.stringify(committed ?? {})) as { cmi: never }).cmi ?? { score: { raw: '0' }, interactions: {} };
  return {
    open(kept) {
      const api = (is12 ? new Scorm12API({ autocommit: false, logLevel: 5 }) : new Scorm2004API({ autocommit: false, logLevel: 5 })) as unknown as Api;
      if (committed !== undefined) api.loadFromJSON(committed, '');
      const learner = is12 ? 'cmi.core.student_id' : 'cmi.learner_id';
      const call =
        (method: string) =>
        (...given: string[]): string => {
          if (method === 'GetValue' && given[0] === learner) return '7';
          const wrong = method === 'SetValue' || method === 'Commit' ? fault(method) : undefined;
          if (wrong === 'throws') throw new Error('the system is away');
          if (wrong === 'false') return 'false';
          const name = !is12 && method === 'Finish' ? 'Terminate' : method;
          const answer = api[`${prefix}${name}`]!(...given);
          if (method === 'Commit' || method === 'Finish') committed = api.renderCMIToJSONObject();
          return answer;
        };
      const methods = ['Initialize', 'GetValue', 'SetValue', 'Commit', 'GetLastError'];
      const entries = [...methods.map((method) => [`${prefix}${method}`, call(method)] as const), [is12 ? 'LMSFinish' : 'Terminate', call('Finish')] as const];
      const top: { [name: string]: unknown } = { [is12 ? 'API' : 'API_1484_11']: Object.fromEntries(entries) };
      top['parent'] = top;
      return new Scorm(is12 ? SCORM_12 : SCORM_2004, 'x', kept, top as unknown as Window);
    },
    trouble(next) {
      const kind = next === undefined ? 'none' : oneOf(next, ['none', 'none', 'commits', 'values', 'all', 'throws', 'some'] as const);
      fault = (method) => {
        if (kind === 'throws') return 'throws';
        if (kind === 'all' || (kind === 'commits' && method === 'Commit') || (kind === 'values' && method === 'SetValue')) return 'false';
        return kind === 'some' && next!() < 0.3 ? 'false' : undefined;
      };
    },
    kill: () => undefined,
    score: () => Number((values().core ?? values()).score.raw),
    replies: () => Object.keys(values().interactions).filter((key) => /^\d+$/.test(key)).length,
  };
}

function store(isCmi5: boolean): World {
  const lrs = new FakeStore();
  prepare(lrs, 'Normal');
  let isGone = { now: true };
  const told = () => [...lrs.statements] as unknown as SentStatement[];
  return {
    open(kept) {
      lrs.tokens = 0;
      const gone = (isGone = { now: false });
      const never = new Promise<Response>(() => undefined);
      vi.stubGlobal('fetch', async (address: string, init: RequestInit) => {
        if (gone.now) return never;
        const answer = await lrs.fetch(address, init).catch((error: unknown) => ({ error }));
        if (gone.now) return never;
        if ('error' in answer) throw answer.error;
        return answer;
      });
      return new XapiRecord(launchOf(isCmi5), { ...COURSE, watched: 0.1 }, kept);
    },
    trouble(next) {
      const kind = next === undefined ? 'none' : oneOf(next, ['none', 'none', 'away', 'lost', 401, 403, 500, 429, 400] as const);
      lrs.isAway = kind === 'away';
      lrs.losesAnswers = kind === 'lost';
      lrs.status = (_, resource) => (typeof kind === 'number' && resource !== '/token' ? kind : undefined);
    },
    kill: () => void (isGone.now = true),
    score: () => {
      // A rejected statement arrives later than its timestamp.
      const inTime = told().sort((a, b) => a.timestamp.localeCompare(b.timestamp));
      const scores = inTime.flatMap((it) => (verbOf(it) === 'answered' ? [] : ((it.result?.['score'] as { raw?: number } | undefined)?.raw ?? [])));
      return scores.at(-1) ?? 0;
    },
    replies: () => told().filter((it) => verbOf(it) === 'answered').length,
  };
}

function browser(): World {
  let kept: Shelf | undefined;
  const state = () => JSON.parse(kept?.getItem('raconteur-course:x') ?? '{}') as { score?: { points: number } };
  return {
    open(given) {
      kept = given;
      return new BrowserRecord('x', given);
    },
    trouble: () => undefined,
    kill: () => undefined,
    score: () => state().score?.points ?? 0,
    replies: () => NaN,
  };
}

const WORLDS: { readonly [name: string]: () => World } = {
  'SCORM 1.2': () => scorm(true),
  'SCORM 2004': () => scorm(false),
  xAPI: () => store(false),
  cmi5: () => store(true),
  'a plain site': browser,
};

/** Simulates one page visit of a learner: the answers, and the ending. Returns the number of answers. */
async function visit(next: Next, world: World, kept: Shelf, truth: Map<string, number>, isLast: boolean): Promise<number> {
  const listeners = new EventTarget();
  vi.stubGlobal('document', Object.assign(new EventTarget(), { hidden: false }));
  vi.stubGlobal('addEventListener', listeners.addEventListener.bind(listeners));
  world.trouble(isLast ? undefined : next);
  const player = new FakePlayer();
  player.ask(QUESTIONS);
  const course = new Course(player.real, world.open(kept), { watched: 0.1, pass: 0.5 });
  void course.begin().catch(() => undefined);
  await settled();
  let count = 0;
  for (let act = 0; act < (isLast ? 1 : 5); act++) {
    if (!isLast) world.trouble(next);
    player.pass(3 * next());
    const question = QUESTIONS.find(({ name }) => player.lesson.answered.every((it) => it.name !== name || !it.isFinal));
    if (question !== undefined && next() < 0.7 && !isLast) {
      const answered = player.answer(question.atSecs, [oneOf(next, ['yes', 'no'])]);
      if (answered !== undefined) {
        count += 1;
        truth.set(answered.name, Math.max(truth.get(answered.name) ?? 0, answered.points));
      }
    }
    await vi.advanceTimersByTimeAsync(oneOf(next, [0, 100, 3000, 40_000, 200_000]));
  }
  if (isLast) {
    await vi.advanceTimersByTimeAsync(200_000);
    await settled();
  }
  // The earlier answers are restored: no question is asked twice, and no point is lost.
  if (isLast) expect(player.score.points).toBe([...truth.values()].reduce((sum, points) => sum + points, 0));
  if (isLast || next() < 0.5) {
    listeners.dispatchEvent(new Event('pagehide'));
    await settled();
  }
  // A page that was killed does nothing more.
  world.kill();
  const now = Date.now();
  vi.clearAllTimers();
  // It sets the clock back as well.
  vi.setSystemTime(now + 1000);
  return count;
}

for (const [name, make] of Object.entries(WORLDS)) {
  describe(`With ${name}`, () => {
    it(`nothing of ${sized(60, 1000)} random learners is lost, and no score falls by itself`, async () => {
      for (let learner = 0; learner < sized(60, 1000); learner++) {
        const next = random(learner + 1);
        const world = make();
        const kept = shelf();
        const truth = new Map<string, number>();
        let [given, reached] = [0, 0];
        for (let time = 0; time < 4; time++) {
          given += await visit(next, world, kept, truth, time === 3);
          const score = world.score();
          expect(score, `learner ${learner}, visit ${time}`).toBeGreaterThanOrEqual(reached);
          reached = score;
        }
        expect(reached, `learner ${learner}`).toBe([...truth.values()].reduce((sum, points) => sum + points, 0));
        expect(reached).toBeLessThanOrEqual(MAX_POINTS);
        if (!Number.isNaN(world.replies())) expect(world.replies(), `learner ${learner}`).toBe(given);
      }
    }, 120_000);
  });
}
