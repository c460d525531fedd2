import { Scorm12API, Scorm2004API } from 'scorm-again';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Course } from '../course/course.js';
import { readMemory } from '../course/memory.js';
import { RecordError } from '../course/report.js';
import { Scorm, SCORM_12, SCORM_2004 } from '../course/scorm.js';
import { shareOf } from '../course/seen.js';
import { BrowserRecord } from '../course/storage.js';
import { united, without, type Span } from '../element/base/ranges.js';
import type { Question } from '../element/base/questions.js';
import { FakePlayer } from './course-learner.js';
import { random } from './course-questions.js';
import { sized } from './tier.js';

/** Page around the course: its event target, and the window in which the system is searched. */
let page: EventTarget & { hidden: boolean };

beforeEach(() => {
  vi.useFakeTimers();
  page = Object.assign(new EventTarget(), { hidden: false });
  vi.stubGlobal('document', page);
  vi.stubGlobal('addEventListener', page.addEventListener.bind(page));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** Maximum loss of watched time in the text that restores learners' progress: hundredths of a second at the ends of spans. */
const MISSED = 0.005;

/** Both versions, each with a third-party system. */
const SYSTEMS = [
  { name: 'SCORM 1.2', version: SCORM_12, object: 'API', open: () => new Scorm12API({ autocommit: false, logLevel: 5 }), status: 'cmi.core.lesson_status', get: 'LMSGetValue' },
  {
    name: 'SCORM 2004',
    version: SCORM_2004,
    object: 'API_1484_11',
    open: () => new Scorm2004API({ autocommit: false, logLevel: 5 }),
    status: 'cmi.completion_status',
    get: 'GetValue',
  },
] as const;

type System = (typeof SYSTEMS)[number];
type Api = { readonly [method: string]: (...given: string[]) => string } & { renderCMIToJSONObject(): object; loadFromJSON(data: object, at: string): void };

/** Returns a window that is a frame within a frame; the outermost window has the system's object. */
function windowWith(object: string, api: Api): Window {
  const top: { [name: string]: unknown } = { [object]: api };
  top['parent'] = top;
  const middle = { parent: top };
  return { parent: middle } as unknown as Window;
}

/** Runs a session in a new page; `before` is the data stored by the system. */
async function session(system: System, before: object | undefined, player = new FakePlayer()): Promise<{ api: Api; player: FakePlayer; course: Course }> {
  const api = system.open() as unknown as Api;
  if (before !== undefined) api.loadFromJSON(before, '');
  const course = new Course(player.real, new Scorm(system.version, 'x', undefined, windowWith(system.object, api)), { watched: 0.9 });
  await course.begin();
  return { api, player, course };
}

const statusOf = (system: System, api: Api): string =>
  system.version === SCORM_12
    ? (api as never as { cmi: { core: { lesson_status: string } } }).cmi.core.lesson_status
    : (api as never as { cmi: { completion_status: string } }).cmi.completion_status;
const memoryOf = (api: Api): string => (api as never as { cmi: { suspend_data: string } }).cmi.suspend_data;

for (const system of SYSTEMS) {
  describe(`A course with ${system.name}`, () => {
    it('is incomplete, and complete once enough was seen', async () => {
      const { api, player, course } = await session(system, undefined);
      expect(statusOf(system, api)).toBe('incomplete');
      player.pass(50);
      expect(statusOf(system, api)).toBe('incomplete');
      player.pass(5);
      expect(statusOf(system, api)).toBe('completed');
      course.close();
      course.close();
    });

    it('brings a learner back to the place, and adds what is seen in several sessions', async () => {
      const first = await session(system, undefined);
      first.player.pass(30);
      first.course.close();
      const second = await session(system, first.api.renderCMIToJSONObject());
      expect(second.player.currentTime).toBe(30);
      expect(statusOf(system, second.api)).toBe('incomplete');
      second.player.pass(26);
      expect(statusOf(system, second.api)).toBe('completed');
    });

    it('does not take completion back, and tells nothing while somebody looks at it', async () => {
      const first = await session(system, undefined);
      first.player.pass(60);
      first.course.close();
      const again = await session(system, first.api.renderCMIToJSONObject());
      expect(statusOf(system, again.api)).toBe('completed');
      again.player.pass(1);
      expect(statusOf(system, again.api)).toBe('completed');
    });

    it('has answers as interactions, points as a score, and success by the author’s rule', async () => {
      const asked = (name: string, atSecs: number): Question => ({
        order: 0,
        name,
        atSecs,
        endSecs: atSecs,
        kind: 'several',
        prompt: 'Which are green?',
        points: 2,
        tries: 2,
        options: [
          { name: 'frog', text: 'Frogs', isRight: true },
          { name: 'leaf', text: 'Leaves', isRight: true },
          { name: 'snow', text: 'Snow', isRight: false },
        ],
        answers: [],
      });
      const questions = [asked('green things', 10), asked('again', 20)];
      const first = new FakePlayer();
      first.ask(questions);
      const { api, course } = await session(system, undefined, first);
      first.answer(10, ['snow']);
      first.answer(10, ['leaf', 'frog']);
      course.close();
      const kept = api.renderCMIToJSONObject();
      const second = new FakePlayer();
      second.ask(questions);
      const again = await session(system, kept, second);
      expect(second.score).toEqual({ points: 2, most: 4 });
      second.answer(20, ['frog', 'leaf']);
      second.pass(60);
      const { cmi } = JSON.parse(JSON.stringify(again.api.renderCMIToJSONObject())) as {
        cmi: { interactions: { [n: string]: { [part: string]: string } }; [part: string]: unknown };
      };
      const told = Object.values(cmi.interactions).map((it) => [it['id'], it['student_response'] ?? it['learner_response'], it['result']]);
      const [wrong, joined] = system.version === SCORM_12 ? ['wrong', (letters: string, _: string) => letters] : ['incorrect', (_: string, names: string) => names];
      expect(told).toEqual([
        ['green-things', joined('c', 'snow'), wrong],
        ['green-things', joined('a,b', 'frog[,]leaf'), 'correct'],
        ['again', joined('a,b', 'frog[,]leaf'), 'correct'],
      ]);
      const core = (system.version === SCORM_12 ? cmi['core'] : cmi) as { score: { raw: string; max: string } };
      expect([core.score.raw, core.score.max].map(Number)).toEqual([4, 4]);
    });

    it('skipping is not seeing', async () => {
      const { api, player } = await session(system, undefined);
      player.seek(59);
      player.pass(1);
      expect(statusOf(system, api)).toBe('incomplete');
    });

    it(`keeps what ${sized(200, 1000)} random learners have seen, and claims no more`, async () => {
      for (let learner = 0; learner < sized(200, 1000); learner++) {
        const next = random(learner + 1);
        let kept: object | undefined;
        let seen: Span[] = [];
        for (let visit = 0; visit < 3; visit++) {
          const { api, player, course } = await session(system, kept);
          const known = readMemory(memoryOf(api)).seen;
          expect(shareOf(known, 60)).toBeLessThanOrEqual(shareOf(seen, 60) + 1e-9);
          expect(shareOf(known, 60)).toBeGreaterThan(shareOf(seen, 60) - MISSED);
          for (let act = 0; act < 6; act++) {
            if (next() < 0.4) player.seek(60 * next());
            const from = player.ended ? 0 : player.currentTime;
            player.pass(12 * next());
            seen = united([...seen, [from, player.currentTime]]);
            if (next() < 0.3) vi.advanceTimersByTime(20_000);
          }
          // A tab is closed, is hidden for ever, or its machine shuts down after a while.
          const end = next();
          if (end < 0.4) page.dispatchEvent(new Event('pagehide'));
          else if (end < 0.7) {
            page.hidden = true;
            page.dispatchEvent(new Event('visibilitychange'));
            page.hidden = false;
          } else vi.advanceTimersByTime(20_000);
          course.close();
          const told = statusOf(system, api);
          if (told === 'completed') expect(shareOf(seen, 60)).toBeGreaterThanOrEqual(0.9);
          else expect(shareOf(seen, 60)).toBeLessThan(0.9 + MISSED);
          kept = api.renderCMIToJSONObject();
        }
      }
    });

    it('says in a sentence that there is no system', async () => {
      const alone = { opener: null } as unknown as { parent: unknown };
      alone.parent = alone;
      const course = new Course(new FakePlayer().real, new Scorm(system.version, 'x', undefined, alone as unknown as Window), { watched: 0.9 });
      await expect(course.begin()).rejects.toThrow(RecordError);
    });
  });
}

describe('A system that misbehaves', () => {
  const broken = { LMSInitialize: () => 'true', LMSGetValue: () => '', LMSGetLastError: () => '0' };

  it('ends no story: what it refuses is told again', async () => {
    let fails = true;
    const values = new Map<string, string>();
    const api = {
      ...broken,
      LMSSetValue: (element: string, value: string) => {
        if (fails) throw new Error('the server is away');
        values.set(element, value);
        return 'true';
      },
      LMSCommit: () => (fails ? 'false' : 'true'),
      LMSFinish: () => 'true',
    };
    const player = new FakePlayer();
    const course = new Course(player.real, new Scorm(SCORM_12, 'x', undefined, windowWith('API', api as unknown as Api)), { watched: 0.9 });
    await course.begin();
    player.pass(57);
    expect(values.size).toBe(0);
    fails = false;
    player.pass(1);
    expect(values.get('cmi.core.lesson_status')).toBe('completed');
    course.close();
    expect(values.get('cmi.core.exit')).toBe('suspend');
  });

  it('commits at most once in ten seconds, and at once what is complete', async () => {
    const commits: number[] = [];
    const api = { ...broken, LMSSetValue: () => 'true', LMSCommit: () => String(commits.push(Date.now()) > 0), LMSFinish: () => 'true' };
    const player = new FakePlayer();
    await new Course(player.real, new Scorm(SCORM_12, 'x', undefined, windowWith('API', api as unknown as Api)), { watched: 0.9 }).begin();
    for (let i = 0; i < 120; i++) {
      player.pass(0.25);
      vi.advanceTimersByTime(250);
    }
    expect(commits.length).toBeGreaterThanOrEqual(3);
    expect(commits.length).toBeLessThanOrEqual(4);
    const before = commits.length;
    player.pass(30);
    expect(commits.length).toBe(before + 1);
  });
});

it('the share that was seen leaves out what nobody has to see', () => {
  expect([
    shareOf([[0, 10]], 40),
    shareOf([[0, 10]], 40, [[10, 30]]),
    shareOf(
      [
        [0, 10],
        [30, 40],
      ],
      40,
      [[10, 30]],
    ),
    shareOf([[10, 30]], 40, [[10, 30]]),
  ]).toEqual([0.25, 0.5, 1, 0]);
  expect([shareOf([], 40), shareOf([[0, 50]], 40), shareOf([[0, 5]], 0), shareOf([[0, 5]], Infinity), shareOf([[0, 5]], 5, [[0, 5]])]).toEqual([0, 1, 0, 0, 0]);
  // Spans that end beyond the story, and begin there.
  expect([
    shareOf([[0, 2]], 5, [
      [0, 6],
      [7, 8],
    ]),
    shareOf([[0, 183]], 757, [
      [100, 200],
      [700, 800],
      [900, 950],
    ]),
  ]).toEqual([0, 100 / 600]);
});

it('ranges are what random times are in', () => {
  const next = random(11);
  for (let i = 0; i < sized(2000, 20_000); i++) {
    const spans = (most: number): Span[] =>
      Array.from({ length: Math.floor(most * next()) }, () => Math.floor(40 * next())).map((from): Span => [from, from + Math.floor(12 * next())]);
    const [seen, optional, end] = [spans(6), spans(6), Math.floor(40 * next())];
    const within = (list: readonly Span[], at: number) => list.some(([from, to]) => from <= at && at < to);
    // Whole seconds: each is in or out.
    const secs = Array.from({ length: 60 }, (_, at) => at);
    const left = without(end, optional);
    expect(secs.filter((at) => within(left, at))).toEqual(secs.filter((at) => at < end && !within(optional, at)));
    expect(left.every(([from, to]) => from < to && to <= end)).toBe(true);
    const wanted = secs.filter((at) => at < end && !within(optional, at));
    expect(shareOf(seen, end, optional)).toBeCloseTo(wanted.length === 0 ? 0 : wanted.filter((at) => within(seen, at)).length / wanted.length, 12);
  }
});

describe('A course on a plain site', () => {
  it('is kept by the browser, and plays where that keeps nothing', async () => {
    const values = new Map<string, string>();
    const storage = {
      getItem: (key: string) => values.get(key) ?? null,
      setItem: (key: string, value: string) => void values.set(key, value),
      removeItem: (key: string) => void values.delete(key),
    };
    const first = new FakePlayer();
    const course = new Course(first.real, new BrowserRecord('x', storage), { watched: 0.5 });
    await course.begin();
    first.pass(31);
    course.close();
    const again = new FakePlayer();
    await new Course(again.real, new BrowserRecord('x', storage), { watched: 0.5 }).begin();
    expect(again.currentTime).toBe(31);
    expect(JSON.parse(values.get('raconteur-course:x') ?? '')).toMatchObject({ isComplete: true });
    const full = {
      removeItem: () => undefined,
      getItem: () => '{',
      setItem: () => {
        throw new Error('full');
      },
    };
    for (const storage of [full, undefined]) {
      const player = new FakePlayer();
      const course = new Course(player.real, new BrowserRecord('x', storage), { watched: 0.5 });
      await course.begin();
      player.pass(31);
      course.close();
    }
  });
});
