/** Requirements of cmi5 for a course's launch and session: a test for each row of the table in docs/courses.md. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Report } from '../course/report.js';
import { XapiRecord } from '../course/xapi.js';
import { faultsOf, verbOf, type SentStatement } from './course-statements.js';
import { ACTOR, COURSE, FakeStore, launchOf, prepare, REGISTRATION, report, SESSION_ID, settled, shelf } from './course-store.js';

const DOCS = readFileSync(join(import.meta.dirname, '../../docs/courses.md'), 'utf8');
const MASTERY = 'https://w3id.org/xapi/cmi5/context/extensions/masteryscore';

let store: FakeStore;
/** Requests in order. */
let asked: { readonly method: string; readonly url: URL; readonly headers: { readonly [name: string]: string } }[];

beforeEach(() => {
  vi.useFakeTimers();
  store = new FakeStore();
  asked = [];
  vi.stubGlobal('fetch', (address: string, init: RequestInit = {}) => {
    asked.push({ method: init.method ?? 'GET', url: new URL(address), headers: (init.headers ?? {}) as { [name: string]: string } });
    return store.fetch(address, init);
  });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const told = (): SentStatement[] => store.statements as unknown as SentStatement[];
const judged = (points: number, isPassed: boolean): Report => ({ ...report(57, true), score: { points, most: 10 }, isSettled: true, isPassed });
const categories = (it: SentStatement): string[] => (it.context.contextActivities['category'] ?? []).map(({ id }) => id.split('/').at(-1) ?? '');

/** Runs a session with every possible report. */
async function session(more: object = {}, reports: readonly Report[] = [judged(8, true)], mode = 'Normal'): Promise<XapiRecord> {
  prepare(store, mode, more);
  store.tokens = 0;
  const record = new XapiRecord(launchOf(true), COURSE, shelf());
  await record.open();
  record.save(report(1));
  record.note({ kind: 'played' });
  for (const it of reports) record.save(it);
  record.keep();
  record.close();
  await settled();
  return record;
}

const ROWS: { readonly [section: string]: () => Promise<void> } = {
  '8.1 launch': async () => {
    // The parameters of the address: endpoint, fetch, actor, registration and activityId.
    await session();
    expect(asked.map(({ url }) => url.origin)).toEqual(asked.map(() => 'https://lrs.example'));
    expect(told()[0]).toMatchObject({ actor: JSON.parse(ACTOR), object: { id: COURSE.activityId }, context: { registration: REGISTRATION } });
  },
  '8.2 fetch': async () => {
    await session();
    const fetches = asked.filter(({ url }) => url.pathname === '/token');
    expect(fetches.map(({ method }) => method)).toEqual(['POST']);
    const others = asked.filter(({ url }) => url.pathname !== '/token');
    expect(others.every(({ headers }) => headers['Authorization'] === 'Basic abc')).toBe(true);
  },
  '8.2.3 fetch errors': async () => {
    prepare(store, 'Normal');
    store.tokens = 1;
    await expect(new XapiRecord(launchOf(true), COURSE, shelf()).open()).rejects.toMatchObject({ why: 'not-let-in' });
    expect(told()).toEqual([]);
  },
  '9.1 and 9.7 statement ids and timestamps': async () => {
    await session();
    expect(told().flatMap((it) => faultsOf(it, true))).toEqual([]);
  },
  '9.3.2 initialized': async () => {
    await session();
    expect(told().map(verbOf).indexOf('initialized')).toBe(0);
    expect(told().filter((it) => verbOf(it) === 'initialized')).toHaveLength(1);
  },
  '9.3.3 completed': async () => {
    const kept = shelf();
    for (let visit = 0; visit < 2; visit++) {
      prepare(store, 'Normal');
      store.tokens = 0;
      const record = new XapiRecord(launchOf(true), COURSE, kept);
      await record.open();
      record.save(report(57, true));
      record.close();
      await settled();
    }
    const all = told().filter((it) => verbOf(it) === 'completed');
    expect(all.map(({ result }) => [result?.['completion'], typeof result?.['duration']])).toEqual([[true, 'string']]);
  },
  '9.3.4 passed': async () => {
    await session({ masteryScore: 0.6 }, [judged(8, true), judged(9, true)]);
    const all = told().filter((it) => verbOf(it) === 'passed');
    expect(all.map(({ result, context }) => [result?.['success'], (result?.['score'] as { scaled: number } | undefined)?.scaled, context.extensions[MASTERY]])).toEqual([
      [true, 0.8, 0.6],
    ]);
  },
  '9.3.5 failed': async () => {
    await session({ masteryScore: 0.6 }, [judged(3, false)]);
    const all = told().filter((it) => verbOf(it) === 'failed');
    expect(all.map(({ result }) => result?.['success'])).toEqual([false]);
    expect(told().map(verbOf).slice(-2)).toEqual(['failed', 'terminated']);
  },
  '9.3.5 failed after passed': async () => {
    const kept = shelf();
    for (const points of [8, 3]) {
      prepare(store, 'Normal');
      store.tokens = 0;
      const record = new XapiRecord(launchOf(true), COURSE, kept);
      await record.open();
      record.save(judged(points, points > 5));
      record.close();
      await settled();
    }
    expect(told().map(verbOf)).not.toContain('failed');
  },
  '9.3.8 terminated': async () => {
    const record = await session();
    record.note({ kind: 'played' });
    record.save(judged(9, true));
    await settled();
    expect(told().map(verbOf).at(-1)).toBe('terminated');
    expect(typeof told().at(-1)?.result?.['duration']).toBe('string');
  },
  '9.5.1 score': async () => {
    await session();
    const own = told().filter((it) => categories(it).includes('cmi5'));
    expect(own.filter(({ result }) => result?.['score'] !== undefined).map(verbOf)).toEqual(['passed']);
  },
  '9.6 context': async () => {
    await session();
    expect(told().every(({ context }) => context.extensions[SESSION_ID] === 's1')).toBe(true);
    expect(told().every(({ context }) => context.contextActivities['grouping']?.[0]?.id === 'https://a.example/publisher')).toBe(true);
  },
  '9.6.2 categories': async () => {
    await session();
    for (const it of told()) {
      const verb = verbOf(it);
      expect([verb, categories(it).includes('cmi5')]).toEqual([verb, ['initialized', 'completed', 'passed', 'terminated'].includes(verb)]);
      expect([verb, categories(it).includes('moveon')]).toEqual([verb, ['completed', 'passed'].includes(verb)]);
    }
  },
  '10.2 launch data': async () => {
    await session();
    const ids = asked.map(({ url }) => url.searchParams.get('stateId'));
    expect(ids.indexOf('LMS.LaunchData')).toBeGreaterThan(0);
    expect(ids.indexOf('LMS.LaunchData')).toBeLessThan(asked.findIndex(({ url }) => url.pathname.endsWith('statements')));
  },
  '10.2.2 launchMode': async () => {
    for (const mode of ['Browse', 'Review']) {
      store = new FakeStore();
      await session({}, [judged(8, true)], mode);
      expect(told().map(verbOf)).toEqual(['initialized', 'terminated']);
    }
  },
  '10.2.4 masteryScore': async () => {
    prepare(store, 'Normal', { masteryScore: 0.6 });
    expect(await new XapiRecord(launchOf(true), COURSE, shelf()).open()).toMatchObject({ pass: 0.6 });
  },
  '10.2.6 returnURL': async () => {
    for (const [returnURL, address] of [
      ['https://a.example/back', 'https://a.example/back'],
      ['javascript:alert(1)', undefined],
      [7, undefined],
    ]) {
      prepare(store, 'Normal', { returnURL });
      store.tokens = 0;
      expect(await new XapiRecord(launchOf(true), COURSE, shelf()).open()).toMatchObject({ returnAddress: address });
    }
  },
  '11 learner preferences': async () => {
    for (const [profile, isMuted] of [
      [undefined, false],
      ['{"languagePreference":"de","audioPreference":"off"}', true],
      ['{"audioPreference":"on"}', false],
      ['{', false],
    ] as const) {
      prepare(store, 'Normal');
      store.tokens = 0;
      if (profile !== undefined) store.profiles.set('cmi5LearnerPreferences', profile);
      expect(await new XapiRecord(launchOf(true), COURSE, shelf()).open()).toMatchObject({ isMuted });
    }
  },
};

describe('cmi5', () => {
  for (const [section, check] of Object.entries(ROWS)) it(section, check);

  it('has a row in the docs for each of them, and no other', () => {
    const rows = [...DOCS.matchAll(/^\| ((?:8|9|10|11)[.\d]* [^|]+?) \|/gm)].map(([, row]) => row);
    expect(rows).toEqual(Object.keys(ROWS));
  });
});
