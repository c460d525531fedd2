/** Session of a learner: actions before the system answers, new attempts, the last score, and copies for systems that lose data. */

import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Course } from '../course/course.js';
import { NOTHING, readMemory, writeMemory } from '../course/memory.js';
import { MAX_MEMORY, Scorm, SCORM_12 } from '../course/scorm.js';
import { BrowserRecord } from '../course/storage.js';
import { XapiRecord } from '../course/xapi.js';
import type { Question } from '../element/base/questions.js';
import { FakePlayer } from './course-learner.js';
import { verbOf, type SentStatement } from './course-statements.js';
import { COURSE, FakeStore, launchOf, memoryAt, prepare, settled, shelf, verbs } from './course-store.js';

let store: FakeStore;
let page: EventTarget;

beforeEach(() => {
  vi.useFakeTimers();
  store = new FakeStore();
  prepare(store, 'Normal');
  page = new EventTarget();
  vi.stubGlobal('fetch', store.fetch);
  vi.stubGlobal('document', Object.assign(new EventTarget(), { hidden: false }));
  vi.stubGlobal('addEventListener', page.addEventListener.bind(page));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const asked = (name: string, atSecs: number, points = 1): Question => ({
  order: atSecs,
  name,
  kind: 'choice',
  atSecs,
  endSecs: atSecs,
  prompt: 'Which?',
  points,
  tries: 1,
  options: [
    { name: 'yes', text: 'Yes', isRight: true },
    { name: 'no', text: 'No', isRight: false },
  ],
  answers: [],
});
const QUESTIONS = Array.from({ length: 10 }, (_, i) => asked(`q${i}`, 3 + 5 * i));

function playerWith(questions: readonly Question[] = QUESTIONS): FakePlayer {
  const player = new FakePlayer();
  player.ask(questions);
  return player;
}

/** Returns a SCORM 1.2 system that stores accepted values. */
function system(values = new Map<string, string>(), learner = '7') {
  const api = {
    LMSInitialize: () => 'true',
    LMSGetValue: (element: string) => (element === 'cmi.core.student_id' ? learner : (values.get(element) ?? '')),
    LMSSetValue: (element: string, value: string) => String(values.set(element, value).size > 0),
    LMSCommit: () => 'true',
    LMSFinish: () => 'true',
    LMSGetLastError: () => '0',
  };
  const top = { API: api, API_1484_11: undefined, parent: undefined as unknown };
  top.parent = top;
  return { api, values, window: top as unknown as Window };
}

const scores = (): unknown[] =>
  (store.statements as unknown as SentStatement[]).flatMap((it) =>
    verbOf(it) === 'answered' || it.result?.['score'] === undefined ? [] : [[verbOf(it), (it.result['score'] as { raw: number }).raw]],
  );

for (const isCmi5 of [false, true]) {
  const name = isCmi5 ? 'cmi5' : 'xAPI';

  it(`the last statement of ${name} has the last score, whenever somebody had points enough`, async () => {
    const player = playerWith();
    const course = new Course(player.real, new XapiRecord(launchOf(isCmi5), COURSE, shelf()), { watched: 0.5, pass: 0.6 });
    await course.begin();
    player.pass(40);
    for (const [i, { name: question, atSecs }] of QUESTIONS.entries()) player.answer(atSecs, [i === 3 || question === 'q5' ? 'no' : 'yes']);
    player.pass(60);
    course.close();
    await settled();
    expect(scores()).toEqual(
      isCmi5
        ? [['passed', 8]]
        : [
            ['passed', 8],
            ['terminated', 8],
          ],
    );
    expect((store.statements as unknown as SentStatement[]).filter((it) => verbOf(it) === 'completed').map(({ result }) => result?.['score'])).toEqual([undefined]);
  });

  it(`who has passed with ${name} and answers more in a later session has the score of that`, async () => {
    const kept = shelf();
    for (const [from, to] of [
      [0, 7],
      [7, 10],
    ] as const) {
      store.tokens = 0;
      const player = playerWith();
      const course = new Course(player.real, new XapiRecord(launchOf(isCmi5), COURSE, kept), { watched: 0.5, pass: 0.6 });
      await course.begin();
      player.pass(40);
      for (const { atSecs } of QUESTIONS.slice(from, to)) player.answer(atSecs, ['yes']);
      course.close();
      await settled();
    }
    expect(scores()).toEqual(
      isCmi5
        ? [
            ['passed', 7],
            ['scored', 10],
          ]
        : [
            ['passed', 7],
            ['terminated', 7],
            ['scored', 10],
            ['terminated', 10],
          ],
    );
    expect(verbs(store).at(-1)).toBe('terminated');
  });

  it(`who is at work when the store of ${name} answers is not brought elsewhere, and has all that was answered before`, async () => {
    const first = playerWith();
    const before = new Course(first.real, new XapiRecord(launchOf(isCmi5), COURSE, undefined), { watched: 0.9 });
    await before.begin();
    for (const { atSecs } of QUESTIONS.slice(0, 4)) first.answer(atSecs, ['yes']);
    first.pass(5);
    before.close();
    await settled();
    store.tokens = 0;
    store.isAway = true;
    const player = playerWith();
    const course = new Course(player.real, new XapiRecord(launchOf(isCmi5), COURSE, shelf()), { watched: 0.9 });
    const begun = course.begin();
    await settled();
    player.pass(2);
    player.answer(3, ['no']);
    player.answer(8, ['yes']);
    await vi.advanceTimersByTimeAsync(100_000);
    store.isAway = false;
    await vi.advanceTimersByTimeAsync(100_000);
    await begun;
    expect(player.currentTime).toBe(8);
    // A correct answer remains correct.
    expect(player.score.points).toBe(4);
    course.close();
    await settled();
    expect(verbs(store).filter((verb) => verb === 'answered')).toHaveLength(6);
  });
}

it('a story that goes on elsewhere by itself is not sought', async () => {
  const player = playerWith();
  const course = new Course(player.real, new XapiRecord(launchOf(false), COURSE, shelf()), { watched: 0.9 });
  await course.begin();
  player.dispatchEvent(Object.assign(new Event('leap'), { detail: { fromSecs: 3, toSecs: 20 } }));
  player.seek(20);
  player.seek(40);
  course.close();
  await settled();
  expect(verbs(store)).toEqual(['initialized', 'seeked', 'terminated']);
});

it('an attempt that failed is not for good: a new one begins at nothing, and the better one counts', async () => {
  const { window, values } = system();
  const player = playerWith();
  const course = new Course(player.real, new Scorm(SCORM_12, 'x', shelf(), window), { watched: 0, pass: 0.6 });
  const told = () => ['lesson_status', 'score.raw'].map((name) => values.get(`cmi.core.${name}`));
  await course.begin();
  for (const [i, { atSecs }] of QUESTIONS.entries()) player.answer(atSecs, [i < 3 ? 'yes' : 'no']);
  expect(told()).toEqual(['failed', '3']);
  course.again();
  expect([player.currentTime, player.score.points, player.state().answered]).toEqual([0, 0, []]);
  player.answer(3, ['yes']);
  expect(told()).toEqual(['failed', '3']);
  for (const { atSecs } of QUESTIONS.slice(1)) player.answer(atSecs, ['yes']);
  expect(told()).toEqual(['passed', '10']);
  course.again();
  for (const { atSecs } of QUESTIONS) player.answer(atSecs, ['no']);
  expect(told()).toEqual(['passed', '10']);
  course.close();
  // In a later session, too.
  const later = playerWith();
  await new Course(later.real, new Scorm(SCORM_12, 'x', shelf(), window), { watched: 0, pass: 0.6 }).begin();
  expect([told(), later.score.points]).toEqual([['passed', '10'], 0]);
});

it('a session of SCORM goes on from its first moment, and its memory has room in every system', async () => {
  const { window, values } = system();
  const player = playerWith([{ ...asked('why', 3), kind: 'text', tries: 3, options: [{ name: 'all', text: '', isRight: true, accepts: ['frog'] }] }]);
  const record = new Scorm(SCORM_12, 'x', shelf(), window);
  await record.open();
  expect(values.get('cmi.core.exit')).toBe('suspend');
  await new Course(player.real, record, { watched: 0.9 }).begin();
  player.answer(3, [`frog ${Array.from({ length: 9000 }, (_, i) => String.fromCharCode(0x4e00 + ((i * 7919) % 20_000))).join('')}`]);
  const text = values.get('cmi.suspend_data') ?? '';
  expect(text.length).toBeLessThanOrEqual(MAX_MEMORY);
  const again = playerWith(player.questions);
  await new Course(again.real, new Scorm(SCORM_12, 'x', undefined, window), { watched: 0.9 }).begin();
  expect([again.score.points, again.lesson.answered[0]?.isFinal]).toEqual([1, true]);
});

it('what a system loses is there in the browser: of the same learner, and not in a new attempt', async () => {
  const kept = shelf();
  const first = playerWith();
  const { window } = system();
  const course = new Course(first.real, new Scorm(SCORM_12, 'x', kept, window), { watched: 0.9 });
  await course.begin();
  first.answer(3, ['yes']);
  first.pass(2);
  course.close();
  const placeIn = async (values: Map<string, string>, learner = '7') => {
    const player = playerWith();
    const copy = shelf();
    for (const [key, value] of kept.values) copy.setItem(key, value);
    await new Course(player.real, new Scorm(SCORM_12, 'x', copy, system(values, learner).window), { watched: 0.9 }).begin();
    return [player.currentTime, player.score.points];
  };
  expect(await placeIn(new Map([['cmi.core.entry', 'resume']]))).toEqual([5, 1]);
  expect(
    await placeIn(
      new Map([
        ['cmi.core.entry', 'resume'],
        ['cmi.suspend_data', '{"broken'],
      ]),
    ),
  ).toEqual([5, 1]);
  // One that has lost an attempt begins a new one; after a course that was completed it is meant.
  expect(await placeIn(new Map([['cmi.core.entry', 'ab-initio']]))).toEqual([5, 1]);
  expect(await placeIn(new Map([['cmi.core.entry', 'resume']]), '8')).toEqual([0, 0]);
  // The learner advanced in another browser.
  const further = writeMemory({ ...memoryAt(40), session: 9 });
  expect(
    await placeIn(
      new Map([
        ['cmi.core.entry', 'resume'],
        ['cmi.suspend_data', further],
      ]),
    ),
  ).toEqual([40, 1]);
});

it('what a system of SCORM refuses is said, until it takes it', async () => {
  for (const fault of ['LMSSetValue', 'LMSCommit'] as const) {
    for (const wrong of ['false', 'throws']) {
      const { api, window, values } = system();
      const right = api[fault] as (...given: string[]) => string;
      let isWrong = true;
      (api as unknown as { [method: string]: unknown })[fault] = (...given: string[]) => {
        if (!isWrong) return right(...given);
        if (wrong === 'throws') throw new Error('away');
        return 'false';
      };
      const player = playerWith();
      const record = new Scorm(SCORM_12, 'x', shelf(), window);
      const troubles: unknown[] = [];
      record.troubles.listen((trouble) => troubles.push(trouble));
      await new Course(player.real, record, { watched: 0.9 }).begin();
      player.answer(3, ['yes']);
      await vi.advanceTimersByTimeAsync(30_000);
      expect(troubles.at(-1)).toBe(fault === 'LMSSetValue' ? 'refused' : 'away');
      isWrong = false;
      player.pass(1);
      await vi.advanceTimersByTimeAsync(30_000);
      expect([fault, wrong, troubles.at(-1), values.get('cmi.interactions.0.result')]).toEqual([fault, wrong, undefined, 'correct']);
    }
  }
});

it('a system of SCORM 1.2 without answers is one, and nothing is wrong', async () => {
  const { api, window } = system();
  api.LMSGetLastError = () => '401';
  const set = api.LMSSetValue;
  api.LMSSetValue = (element, value) => (element.startsWith('cmi.interactions') ? 'false' : set(element, value));
  const player = playerWith();
  const record = new Scorm(SCORM_12, 'x', shelf(), window);
  const troubles: unknown[] = [];
  record.troubles.listen((trouble) => troubles.push(trouble));
  await new Course(player.real, record, { watched: 0.9 }).begin();
  player.answer(3, ['yes']);
  await vi.advanceTimersByTimeAsync(30_000);
  expect(troubles).toEqual([]);
});

it('who only looks at a course finds it as it was left, and nothing is told', async () => {
  const { window, values } = system();
  values.set('cmi.core.lesson_mode', 'review');
  values.set('cmi.suspend_data', writeMemory({ ...memoryAt(20), answered: [{ name: 'q0', given: ['yes'], tries: 1 }] }));
  const before = new Map(values);
  const player = playerWith();
  const course = new Course(player.real, new Scorm(SCORM_12, 'x', shelf(), window), { watched: 0.9 });
  await course.begin();
  expect([player.currentTime, player.score.points]).toEqual([20, 1]);
  player.pass(40);
  player.answer(8, ['yes']);
  course.close();
  expect(values).toEqual(before);
});

it('a learner who leaves before the story is there leaves it as it was', async () => {
  const { window, values } = system();
  values.set('cmi.suspend_data', writeMemory(memoryAt(20)));
  values.set('cmi.core.entry', 'resume');
  const player = playerWith();
  player.readyState = 0;
  void new Course(player.real, new Scorm(SCORM_12, 'x', shelf(), window), { watched: 0.9 }).begin();
  await settled();
  page.dispatchEvent(new Event('pagehide'));
  expect(readMemory(values.get('cmi.suspend_data') ?? '')).toEqual(memoryAt(20));
  expect(readMemory('')).toBe(NOTHING);
});

it('a browser that keeps nothing says so', async () => {
  const record = new BrowserRecord('x', undefined);
  const troubles: unknown[] = [];
  record.troubles.listen((trouble) => troubles.push(trouble));
  const player = playerWith();
  await new Course(player.real, record, { watched: 0.9 }).begin();
  player.answer(3, ['yes']);
  expect(troubles).toEqual(['unkept']);
});

it('a new attempt that a system begins after a course was completed is one', async () => {
  const kept = shelf();
  const player = playerWith();
  const course = new Course(player.real, new Scorm(SCORM_12, 'x', kept, system().window), { watched: 0 });
  await course.begin();
  player.answer(3, ['yes']);
  course.close();
  const again = playerWith();
  await new Course(again.real, new Scorm(SCORM_12, 'x', kept, system(new Map([['cmi.core.entry', 'ab-initio']])).window), { watched: 0 }).begin();
  expect([again.currentTime, again.score.points]).toEqual([0, 0]);
});

it('a system that begins its session late has all that was done before', async () => {
  const { api, window, values } = system();
  let isThere = false;
  api.LMSInitialize = () => String(isThere);
  const player = playerWith();
  const record = new Scorm(SCORM_12, 'x', shelf(), window);
  const troubles: unknown[] = [];
  record.troubles.listen((trouble) => troubles.push(trouble));
  const begun = new Course(player.real, record, { watched: 0.9 }).begin();
  await settled();
  player.answer(3, ['yes']);
  expect([troubles, record.troubles.isKept]).toEqual([['away'], false]);
  isThere = true;
  await vi.advanceTimersByTimeAsync(30_000);
  await begun;
  expect([troubles.at(-1), record.troubles.isKept, values.get('cmi.core.score.raw'), values.get('cmi.interactions.0.result')]).toEqual([undefined, true, '1', 'correct']);
});

/** Returns two pages of one browser: each receives the other's storage events. */
function tabs() {
  const values = new Map<string, string>();
  const pages: EventTarget[] = [];
  const open = (): { readonly shelf: ReturnType<typeof shelf>; readonly page: EventTarget } => {
    const own = new EventTarget();
    pages.push(own);
    vi.stubGlobal('addEventListener', own.addEventListener.bind(own));
    const tell = (key: string, newValue: string | null) => {
      for (const other of pages) if (other !== own) other.dispatchEvent(Object.assign(new Event('storage'), { key, newValue }));
    };
    const all = shelf(values);
    return {
      page: own,
      shelf: {
        ...all,
        setItem: (key, value) => {
          if (values.get(key) === value) return;
          values.set(key, value);
          tell(key, value);
        },
        removeItem: (key) => {
          if (values.delete(key)) tell(key, null);
        },
      },
    };
  };
  return { open, values };
}

it('two tabs of a course lose nothing to each other', async () => {
  for (const kind of ['html', 'xapi', 'scorm'] as const) {
    const { open } = tabs();
    const lms = system();
    store = new FakeStore();
    vi.stubGlobal('fetch', store.fetch);
    const begin = async () => {
      const tab = open();
      const player = playerWith();
      const record = {
        html: () => new BrowserRecord('x', tab.shelf),
        xapi: () => new XapiRecord(launchOf(false), COURSE, tab.shelf),
        scorm: () => new Scorm(SCORM_12, 'x', tab.shelf, lms.window),
      }[kind]();
      const course = new Course(player.real, record, { watched: 0.9, pass: 0.5 });
      await course.begin();
      return { player, course };
    };
    const [a, b] = [await begin(), await begin()];
    a.player.answer(3, ['yes']);
    b.player.answer(8, ['yes']);
    a.player.pass(1);
    a.course.close();
    b.player.pass(2);
    b.course.close();
    await settled();
    const later = await begin();
    expect([kind, later.player.score.points]).toEqual([kind, 2]);
    if (kind === 'xapi') expect(scores().at(-1)).toEqual(['terminated', 2]);
  }
});

it('two tabs with a store that is away tell all in the end, and a review in between takes nothing away', async () => {
  const { open } = tabs();
  store.status = (_, resource) => (resource.endsWith('statements') ? 503 : undefined);
  const begin = async (mode = 'Normal') => {
    prepare(store, mode);
    store.tokens = 0;
    const tab = open();
    const player = playerWith();
    const course = new Course(player.real, new XapiRecord(launchOf(true), COURSE, tab.shelf), { watched: 0.9 });
    await course.begin();
    return { player, course };
  };
  const [a, b] = [await begin(), await begin()];
  a.player.answer(3, ['yes']);
  b.player.answer(8, ['no']);
  a.course.close();
  b.course.close();
  await settled();
  store.status = () => undefined;
  for (const mode of ['Review', 'Normal']) {
    const { course } = await begin(mode);
    await settled();
    course.close();
    await settled();
  }
  expect(verbs(store).filter((verb) => verb === 'answered')).toHaveLength(2);
});

it('who leaves waits until all is told, in its order', async () => {
  const slow = store.fetch;
  vi.stubGlobal('fetch', async (address: string, init: RequestInit) => {
    if (address.includes('statements')) await new Promise((done) => setTimeout(done, 2000));
    return slow(address, init);
  });
  const player = playerWith();
  const course = new Course(player.real, new XapiRecord(launchOf(true), COURSE, shelf()), { watched: 0.9 });
  await course.begin();
  player.answer(3, ['yes']);
  await vi.advanceTimersByTimeAsync(2500);
  player.answer(8, ['yes']);
  const left = course.leave();
  await vi.advanceTimersByTimeAsync(12_000);
  await left;
  expect(verbs(store)).toEqual(['initialized', 'answered', 'answered', 'scored', 'terminated']);
});

it('a seek is told from where it began', async () => {
  const player = playerWith();
  const course = new Course(player.real, new XapiRecord(launchOf(false), COURSE, shelf()), { watched: 0.9 });
  await course.begin();
  player.pass(20);
  player.currentTime = 40;
  for (const type of ['seeking', 'timeupdate', 'seeked']) player.dispatchEvent(new Event(type));
  course.close();
  await settled();
  const times = 'https://w3id.org/xapi/video/extensions/time-';
  expect(store.statements.find(({ verb }) => verb.id.endsWith('seeked'))?.['result']).toEqual({ extensions: { [`${times}from`]: 20, [`${times}to`]: 40 } });
});
