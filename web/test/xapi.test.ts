import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Outbox, type Statement } from '../course/outbox.js';
import { RecordError } from '../course/report.js';
import { XapiRecord } from '../course/xapi.js';
import { ACTOR, COURSE, FakeStore, launchOf, prepare, REGISTRATION, report, SESSION_ID, settled, shelf, verbs } from './course-store.js';
import { sized } from './tier.js';

let store: FakeStore;
beforeEach(() => {
  vi.useFakeTimers();
  store = new FakeStore();
  vi.stubGlobal('fetch', store.fetch);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

for (const isCmi5 of [false, true]) {
  describe(`A course with a record store${isCmi5 ? ', launched by cmi5' : ''}`, () => {
    beforeEach(() => prepare(store, 'Normal'));

    it('tells a session in its order, and ends it with the last statement', async () => {
      const record = new XapiRecord(launchOf(isCmi5), COURSE, shelf());
      expect(await record.open()).toEqual({ memory: '', isComplete: false });
      record.tell(report(0));
      record.note({ kind: 'played' });
      record.tell(report(20));
      record.note({ kind: 'seeked', fromSecs: 5 });
      record.note({ kind: 'paused' });
      record.tell(report(57, true));
      record.tell(report(58, true));
      record.keep();
      record.close();
      record.note({ kind: 'played' });
      record.close();
      await settled();
      expect(verbs(store)).toEqual(['initialized', 'played', 'seeked', 'paused', 'completed', 'terminated']);
      expect(store.faults).toEqual([]);
      const [first, , seeked, paused, completed] = store.statements;
      expect(first).toMatchObject({ actor: JSON.parse(ACTOR), object: { id: COURSE.activityId }, context: { registration: REGISTRATION } });
      expect(seeked?.['result']).toEqual({ extensions: { 'https://w3id.org/xapi/video/extensions/time-from': 5, 'https://w3id.org/xapi/video/extensions/time-to': 20 } });
      expect(paused?.['result']).toMatchObject({ extensions: { 'https://w3id.org/xapi/video/extensions/played-segments': '0[.]20' } });
      expect(completed?.['result']).toMatchObject({ completion: true, duration: expect.stringMatching(/^PT[\d.]+S$/) as unknown });
      const categories = ({ context }: { [part: string]: unknown }) =>
        (context as { contextActivities: { category: { id: string }[] } }).contextActivities.category.map(({ id }) => id.split('/').at(-1));
      expect(store.statements.map(categories)).toEqual(
        isCmi5 ? [['video', 'cmi5'], ['video'], ['video'], ['video'], ['video', 'cmi5', 'moveon'], ['video', 'cmi5']] : store.statements.map(() => ['video']),
      );
      if (isCmi5) expect(first).toMatchObject({ context: { contextActivities: { grouping: [{ id: 'https://a.example/publisher' }] }, extensions: { [SESSION_ID]: 's1' } } });
    });

    it('is gone on with where it was left, and completed once', async () => {
      const kept = shelf();
      const first = new XapiRecord(launchOf(isCmi5), COURSE, kept);
      await first.open();
      first.tell(report(57, true));
      first.close();
      await settled();
      store.tokens = 0;
      const again = new XapiRecord(launchOf(isCmi5), COURSE, kept);
      expect(await again.open()).toEqual({ memory: 'at 57', isComplete: true });
      again.tell(report(58, true));
      again.close();
      await settled();
      expect(verbs(store).filter((verb) => verb === 'completed')).toHaveLength(1);
    });

    it('waits for a store that is away, and writes over nothing that it does not know', async () => {
      const first = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      await first.open();
      first.tell(report(20));
      first.close();
      await settled();
      store.tokens = 0;
      const again = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      const opened = again.open();
      // The token has come; then the network goes.
      for (let i = 0; i < 3; i++) await Promise.resolve();
      store.isAway = true;
      await vi.advanceTimersByTimeAsync(20_000);
      again.keep();
      store.isAway = false;
      await vi.advanceTimersByTimeAsync(40_000);
      expect(await opened).toEqual({ memory: 'at 20', isComplete: false });
    });

    it('is told in a sentence where the store does not come', async () => {
      const record = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      const opened = expect(record.open()).rejects.toThrow(isCmi5 ? /did not let it in|cannot be reached/ : 'cannot be reached');
      store.isAway = true;
      await vi.advanceTimersByTimeAsync(300_000);
      await opened;
      record.close();
      expect(store.states.size).toBe(1);
    });

    it('is left as it was by who leaves before there is a story', async () => {
      const first = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      await first.open();
      first.tell(report(20));
      first.close();
      await settled();
      for (let visit = 0; visit < 2; visit++) {
        store.tokens = 0;
        const again = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
        expect(await again.open()).toEqual({ memory: 'at 20', isComplete: false });
        again.close();
        await settled();
      }
    });

    it(`loses nothing and doubles nothing while the store is away, for ${sized(200, 1000)} random learners`, async () => {
      for (let learner = 0; learner < sized(200, 1000); learner++) {
        store = new FakeStore();
        prepare(store, 'Normal');
        vi.stubGlobal('fetch', store.fetch);
        const kept = shelf();
        const made: string[] = [];
        for (let visit = 0; visit < 3; visit++) {
          store.isAway = store.losesAnswers = false;
          store.tokens = 0;
          const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
          await record.open();
          made.push('initialized');
          for (let act = 0; act < 6; act++) {
            const at = (learner * 7919 + visit * 104_729 + act * 1_299_709) % 1000;
            store.isAway = at % 3 === 0;
            store.losesAnswers = at % 7 === 1;
            const kind = (['played', 'paused', 'seeked'] as const)[at % 3 === 0 ? 0 : at % 5 === 0 ? 1 : 2];
            record.tell(report(at / 20));
            record.note({ kind });
            made.push(kind);
            await settled();
            vi.advanceTimersByTime(at * 10);
            await settled();
          }
          record.close();
          made.push('terminated');
          await settled();
        }
        store.isAway = store.losesAnswers = false;
        store.tokens = 0;
        await new XapiRecord(launchOf(isCmi5), COURSE, kept).open();
        await settled();
        expect(verbs(store)).toEqual([...made, 'initialized']);
      }
    });
  });
}

describe('A launch', () => {
  it('that is none is told in a sentence', async () => {
    for (const address of ['https://a.example/', 'https://a.example/?endpoint=https://x/', 'https://a.example/?endpoint=https://x/&actor={']) {
      await expect(new XapiRecord(address, COURSE, undefined).open()).rejects.toThrow(RecordError);
    }
    await expect(new XapiRecord(launchOf(true), COURSE, undefined).open()).rejects.toThrow('does not say how');
    // The token is given once.
    await expect(new XapiRecord(launchOf(true), COURSE, undefined).open()).rejects.toThrow('open it there anew');
  });

  it('for a review completes nothing', async () => {
    prepare(store, 'Review');
    const record = new XapiRecord(launchOf(true), COURSE, undefined);
    await record.open();
    record.tell(report(60, true));
    record.close();
    await settled();
    expect(verbs(store)).toEqual(['initialized', 'terminated']);
    expect(store.states.size).toBe(1);
  });
});

describe('An outbox', () => {
  const statements = (count: number): Statement[] => Array.from({ length: count }, (_, i) => ({ id: `${i}` }));

  it('goes past what a store will never take, and waits longer each time it is away', async () => {
    const tried: string[] = [];
    let isAway = true;
    const outbox = new Outbox('x', undefined, (statement) => {
      tried.push(statement.id);
      return Promise.resolve(isAway ? 'away' : statement.id === '1' ? 'refused' : 'taken');
    });
    for (const statement of statements(3)) outbox.add(statement);
    for (const ms of [1000, 2000, 4000, 8000, 16_000, 30_000, 30_000]) {
      await settled();
      vi.advanceTimersByTime(ms - 1);
      await settled();
      const before = tried.length;
      vi.advanceTimersByTime(1);
      await settled();
      expect(tried.length).toBe(before + 1);
    }
    isAway = false;
    await vi.advanceTimersByTimeAsync(30_000);
    expect([outbox.waiting.length, tried.slice(-3)]).toEqual([0, ['0', '1', '2']]);
  });

  it('reads what another page has left, and nothing else', () => {
    for (const text of ['', '{', '{}', '[1,null,{"id":1}]']) {
      expect(new Outbox('x', { ...shelf(), getItem: () => text }, () => Promise.resolve('away')).waiting).toEqual([]);
    }
  });
});
