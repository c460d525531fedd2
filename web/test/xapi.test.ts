import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { NOTHING } from '../course/memory.js';
import { Outbox } from '../course/outbox.js';
import { RecordError } from '../course/report.js';
import type { Outcome, Statement } from '../course/store.js';
import { StorageProblems } from '../course/storage-problems.js';
import { XapiRecord } from '../course/xapi.js';
import { ACTOR, COURSE, FakeStore, launchOf, memoryAt, prepare, REGISTRATION, report, SESSION_ID, settled, shelf, verbs } from './course-store.js';
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
      expect(await record.open()).toMatchObject({ memory: NOTHING, isComplete: false });
      record.save(report(0));
      record.note({ kind: 'played' });
      record.save(report(20));
      record.note({ kind: 'seeked', fromSecs: 5 });
      record.note({ kind: 'paused' });
      record.save(report(57, true));
      record.save(report(58, true));
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
      first.save(report(57, true));
      first.close();
      await settled();
      store.tokens = 0;
      const again = new XapiRecord(launchOf(isCmi5), COURSE, kept);
      expect(await again.open()).toMatchObject({ memory: memoryAt(57), isComplete: true });
      again.save(report(58, true));
      again.close();
      await settled();
      expect(verbs(store).filter((verb) => verb === 'completed')).toHaveLength(1);
    });

    it('waits for a store that is away, and writes over nothing that it does not know', async () => {
      const first = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      await first.open();
      first.save(report(20));
      first.close();
      await settled();
      store.tokens = 0;
      const again = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      const opened = again.open();
      // The token has arrived; then the network fails.
      for (let i = 0; i < 3; i++) await Promise.resolve();
      store.isAway = true;
      await vi.advanceTimersByTimeAsync(20_000);
      again.keep();
      store.isAway = false;
      await vi.advanceTimersByTimeAsync(40_000);
      expect(await opened).toMatchObject({ memory: memoryAt(20), isComplete: false });
    });

    it('keeps what is done before the store comes, says that it is away, and tells it all in the end', async () => {
      const kept = shelf();
      for (const isKilled of [true, false]) {
        store.isAway = true;
        store.tokens = 0;
        const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
        const troubles: unknown[] = [];
        record.troubles.listen((trouble) => troubles.push(trouble));
        const opened = record.open();
        record.save(report(isKilled ? 20 : 30));
        record.note({ kind: 'played' });
        record.keep();
        // Two hours.
        await vi.advanceTimersByTimeAsync(7_200_000);
        expect(troubles).toEqual(['away']);
        if (isKilled) {
          vi.clearAllTimers();
          continue;
        }
        store.isAway = false;
        await vi.advanceTimersByTimeAsync(120_000);
        expect(troubles).toEqual(['away', undefined]);
        expect((await opened).memory.seen).toEqual([[0, 30]]);
        record.save(report(30));
        record.close();
        await settled();
      }
      expect(verbs(store).filter((verb) => verb === 'played')).toHaveLength(2);
      expect(verbs(store).at(-1)).toBe('terminated');
    });

    it('says that it is not let in, loses nothing, and goes on when it is', async () => {
      const record = new XapiRecord(launchOf(isCmi5), COURSE, shelf());
      const troubles: unknown[] = [];
      record.troubles.listen((trouble) => troubles.push(trouble));
      await record.open();
      await settled();
      for (const [status, trouble] of [
        [401, 'denied'],
        [403, 'denied'],
        [500, 'away'],
        [429, 'away'],
      ] as const) {
        store.status = (method) => (method === 'GET' ? undefined : status);
        record.note({ kind: 'played' });
        record.save(report(status / 10));
        record.keep();
        await settled();
        expect([status, troubles.at(-1)]).toEqual([status, trouble]);
        store.status = () => undefined;
        await vi.advanceTimersByTimeAsync(120_000);
        expect([status, troubles.at(-1)]).toEqual([status, undefined]);
      }
      expect(verbs(store)).toEqual(['initialized', 'played', 'played', 'played', 'played']);
      expect([...store.states.values()].at(-1)).toContain('42.9');
    });

    it('keeps a statement that the store refuses, says so, and sends it in the next session', async () => {
      const kept = shelf();
      const record = new XapiRecord(launchOf(isCmi5), COURSE, kept);
      const troubles: unknown[] = [];
      record.troubles.listen((trouble) => troubles.push(trouble));
      await record.open();
      await settled();
      let refused = '';
      store.status = (_, resource, ids) => {
        if (!resource.endsWith('statements')) return undefined;
        refused ||= ids[0] ?? '';
        return ids.includes(refused) ? 400 : undefined;
      };
      for (const kind of ['played', 'paused', 'played'] as const) record.note({ kind });
      await settled();
      await settled();
      expect(verbs(store)).toEqual(['initialized', 'paused', 'played']);
      expect(troubles).toEqual(['refused']);
      record.close();
      await settled();
      store.status = () => undefined;
      store.tokens = 0;
      await new XapiRecord(launchOf(isCmi5), COURSE, kept).open();
      await settled();
      expect(store.statements.some(({ id }) => id === refused)).toBe(true);
    });

    it('is left as it was by who leaves before there is a story', async () => {
      const first = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
      await first.open();
      first.save(report(20));
      first.close();
      await settled();
      for (let visit = 0; visit < 2; visit++) {
        store.tokens = 0;
        const again = new XapiRecord(launchOf(isCmi5), COURSE, undefined);
        expect(await again.open()).toMatchObject({ memory: memoryAt(20), isComplete: false });
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
            record.save(report(at / 20));
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
        const isMark = (verb: string) => verb === 'initialized' || verb === 'terminated';
        // A session of cmi5 has its own marks: those that could not be sent in their own are over.
        if (isCmi5) expect(verbs(store).filter((verb) => !isMark(verb))).toEqual(made.filter((verb) => !isMark(verb)));
        else expect(verbs(store)).toEqual([...made, 'initialized']);
      }
    });
  });
}

describe('A launch', () => {
  it('that is none is told in a sentence', async () => {
    for (const address of ['https://a.example/', 'https://a.example/?endpoint=https://x/', 'https://a.example/?endpoint=https://x/&actor={']) {
      await expect(new XapiRecord(address, COURSE, undefined).open()).rejects.toThrow(RecordError);
    }
    await expect(new XapiRecord(launchOf(true), COURSE, undefined).open()).rejects.toMatchObject({ why: 'no-launch' });
    // The token is issued once.
    await expect(new XapiRecord(launchOf(true), COURSE, undefined).open()).rejects.toMatchObject({ why: 'not-let-in' });
  });

  it('for a review completes nothing', async () => {
    prepare(store, 'Review');
    const record = new XapiRecord(launchOf(true), COURSE, undefined);
    await record.open();
    record.save(report(60, true));
    record.close();
    await settled();
    expect(verbs(store)).toEqual(['initialized', 'terminated']);
    expect(store.states.size).toBe(1);
  });
});

describe('An outbox', () => {
  const statements = (count: number): Statement[] => Array.from({ length: count }, (_, i) => ({ id: `${i}` }));
  const troubles = new StorageProblems();
  const outboxOf = (send: (batch: readonly Statement[]) => Promise<Outcome>, kept = shelf()) => new Outbox('x', kept, { send, trouble: (what, it) => troubles.set(what, it) });

  it('goes past what a store does not take, which it keeps, and waits longer each time it is away', async () => {
    const tried: string[] = [];
    let isAway = true;
    const kept = shelf();
    const outbox = outboxOf((batch) => {
      tried.push(batch.map(({ id }) => id).join());
      return Promise.resolve(isAway ? 'away' : batch.some(({ id }) => id === '1') ? 'refused' : 'taken');
    }, kept);
    for (const statement of statements(4)) outbox.add(statement);
    outbox.open((waiting) => waiting);
    for (const ms of [1000, 2000, 4000, 8000, 16_000, 32_000, 60_000, 60_000]) {
      await vi.advanceTimersByTimeAsync(ms - 1);
      const before = tried.length;
      await vi.advanceTimersByTimeAsync(1);
      expect(tried.length).toBe(before + 1);
    }
    isAway = false;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(tried.slice(-5)).toEqual(['0,1,2,3', '0', '1', '2', '3']);
    expect(outbox.waiting).toEqual([{ id: '1' }]);
    outbox.close();
    expect(outboxOf(() => Promise.resolve('away'), kept).waiting).toEqual([{ id: '1' }]);
  });

  it('sends together what is said together, and on leaving what is not on its way', async () => {
    const sent: string[] = [];
    const outbox = outboxOf((batch) => {
      sent.push(batch.map(({ id }) => id).join());
      return new Promise((taken) => setTimeout(() => taken('taken'), 5000));
    });
    outbox.open((waiting) => waiting);
    for (const statement of statements(3)) outbox.add(statement);
    await vi.advanceTimersByTimeAsync(1500);
    outbox.add({ id: '3' });
    outbox.close();
    expect(sent).toEqual(['0,1,2', '3']);
    // A request that is too long for an unloading page waits for the next session.
    const long = outboxOf(() => Promise.resolve('taken'));
    long.open((waiting) => waiting);
    for (let i = 0; i < 8; i++) long.add({ id: `${i}`, text: 'x'.repeat(20_000) });
    long.close();
    await settled();
    expect(long.waiting.map(({ id }) => id)).toEqual(['2', '3', '4', '5', '6', '7']);
  });

  it('reads what another page has left, and nothing else', () => {
    for (const text of ['', '{', '{}', '[1,null,{"id":1}]']) {
      expect(outboxOf(() => Promise.resolve('away'), { ...shelf(), getItem: () => text }).waiting).toEqual([]);
    }
  });
});
