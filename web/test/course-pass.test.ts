/** Passing and failing, as reported by the course. */

import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Course } from '../course/course.js';
import { NOTHING } from '../course/memory.js';
import type { KnownLearner, Record, Reply, Report } from '../course/report.js';
import { Scorm, SCORM_12 } from '../course/scorm.js';
import { StorageProblems } from '../course/storage-problems.js';
import type { RaconteurPlayer } from '../element/element.js';
import type { Answered } from '../element/base/answers.js';
import { Ranges, type Span } from '../element/base/ranges.js';
import type { Question } from '../element/base/questions.js';

const question = (name: string, atSecs: number): Question => ({
  order: 0,
  name,
  kind: 'text',
  atSecs,
  endSecs: atSecs,
  prompt: 'Why?',
  points: 1,
  tries: 2,
  options: [],
  answers: [],
});

/** Continuation of an answer, irrelevant here. */
const NONE = { fits: [] };

/** Player that has been watched nearly to the end, with as many questions as points. */
class Seen extends EventTarget {
  readonly readyState = 4;
  readonly duration = 60;
  readonly currentTime = 59;
  ended = false;
  readonly played = new Ranges([[0, 59]]);
  readonly questions: readonly Question[];
  readonly answered = new Map<string, Answered>();

  constructor(count: number) {
    super();
    this.questions = Array.from({ length: count }, (_, i) => question(`q${i}`, i));
  }

  get optional(): readonly Span[] {
    return this.questions.map(({ atSecs, endSecs }): Span => [atSecs, endSecs]);
  }

  get score() {
    return { points: [...this.answered.values()].reduce((sum, { points }) => sum + points, 0), most: this.questions.length };
  }

  state() {
    return { placeSecs: 60, answered: [...this.answered.values()] };
  }

  answer(name: string, isRight: boolean, isFinal = true): void {
    const detail: Answered = { ...NONE, name, given: ['x'], isRight, points: isRight ? 1 : 0, tries: 1, isFinal };
    this.answered.set(name, detail);
    this.dispatchEvent(Object.assign(new Event('answer'), { detail }));
  }
}

/** Reports in order. */
class HeardEvent implements Record {
  readonly troubles = new StorageProblems();
  readonly heard: (boolean | undefined | string)[] = [];
  readonly #known: KnownLearner;

  constructor(pass?: number) {
    this.#known = { memory: NOTHING, isComplete: false, pass };
  }

  open = (): Promise<KnownLearner> => Promise.resolve(this.#known);
  save = ({ isPassed }: Report): void => void this.heard.push(isPassed);
  reply = ({ answered }: Reply): void => void this.heard.push(answered.name);
  keep = (): void => undefined;
  close = (): void => undefined;
}

beforeEach(() => {
  const page = Object.assign(new EventTarget(), { hidden: false });
  vi.stubGlobal('document', page);
  vi.stubGlobal('addEventListener', page.addEventListener.bind(page));
});
afterEach(() => void vi.unstubAllGlobals());

async function begun(player: Seen, record: Record, pass: number | undefined): Promise<void> {
  await new Course(player as unknown as RaconteurPlayer, record, { watched: 0.9, pass }).begin();
}

it('nobody has failed before all is answered for good, and an answer comes before what follows from it', async () => {
  const player = new Seen(3);
  const record = new HeardEvent();
  await begun(player, record, 0.6);
  player.answer('q0', false);
  player.answer('q1', true);
  player.answer('q2', false, false);
  player.answer('q2', false);
  expect(record.heard).toEqual([undefined, undefined, 'q0', undefined, 'q1', undefined, 'q2', undefined, 'q2', false]);
});

it('a story that has ended is settled, whatever it did not ask on its way', async () => {
  const player = new Seen(3);
  const record = new HeardEvent();
  await begun(player, record, 0.6);
  player.answer('q0', true);
  player.ended = true;
  player.dispatchEvent(new Event('ended'));
  expect(record.heard).toEqual([undefined, undefined, 'q0', undefined, false]);
});

it('the share that the system wants counts before the author’s', async () => {
  for (const [wanted, pass, last] of [
    [undefined, undefined, undefined],
    [undefined, 0.5, true],
    [0.6, 0.5, false],
    [0.5, 1, true],
    [0.5, undefined, true],
    [0, 1, true],
  ] as const) {
    const player = new Seen(2);
    const record = new HeardEvent(wanted);
    await begun(player, record, pass);
    player.answer('q0', true);
    player.answer('q1', false);
    expect([wanted, pass, record.heard.at(-1)]).toEqual([wanted, pass, last]);
  }
});

it('who had seen enough passes later with SCORM 1.2, and points beyond 100 are told as a share of that', async () => {
  const values = new Map([['cmi.core.lesson_status', 'completed']]);
  const api = {
    LMSInitialize: () => 'true',
    LMSGetValue: (element: string) => values.get(element) ?? '',
    LMSSetValue: (element: string, value: string) => String(values.set(element, value).size > 0),
    LMSCommit: () => 'true',
  };
  const top = { API: api, parent: undefined as unknown };
  top.parent = top;
  const player = new Seen(300);
  await begun(player, new Scorm(SCORM_12, 'x', undefined, top as unknown as Window), 0.01);
  expect(values.get('cmi.core.lesson_status')).toBe('completed');
  for (const name of ['q0', 'q1', 'q2']) player.answer(name, true);
  expect(['lesson_status', 'score.raw', 'score.max'].map((name) => values.get(`cmi.core.${name}`))).toEqual(['passed', '1', '100']);
});
