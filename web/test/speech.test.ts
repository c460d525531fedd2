import { beforeEach, expect, test, vi } from 'vitest';
import type { WorkerRequest, Reply } from '../speech/messages.js';
import type { SpokenAudio, SpeechSource } from '../speech/source.js';

/** Worker that answers on command. */
class FakeWorker {
  static all: FakeWorker[] = [];
  onmessage?: (event: { data: Reply }) => void;
  onerror?: () => void;
  asked: WorkerRequest[] = [];
  ended = false;

  constructor() {
    FakeWorker.all.push(this);
  }

  postMessage(ask: WorkerRequest): void {
    this.asked.push(ask);
  }

  terminate(): void {
    this.ended = true;
  }

  say(id: number): void {
    this.onmessage?.({ data: { kind: 'part', id, bundle: `{"${id}":1}`, sounds: [[`${id}.wav`, new Uint8Array(2)]], problems: [] } });
    this.onmessage?.({ data: { kind: 'done', id } });
  }
}

/** Resolves once the worker has been asked, after it has been found. */
const asked = (): Promise<void> => new Promise((done) => setTimeout(done));

let flite: SpeechSource;
let aborts: AbortController;
const last = (): FakeWorker => {
  const worker = FakeWorker.all.at(-1);
  if (worker === undefined) throw new Error('no worker was made');
  return worker;
};
/** Speaks a text and returns its parts. */
const speak = async (eml: string, progress: (share: number) => void = () => undefined): Promise<SpokenAudio[]> => {
  const parts: SpokenAudio[] = [];
  await flite.speak({ eml, voice: 'slt' }, { signal: aborts.signal, progress, take: (part) => parts.push(part) });
  return parts;
};

beforeEach(async () => {
  FakeWorker.all = [];
  vi.stubGlobal('Worker', FakeWorker);
  // The script has the same origin, so that no other origin starts it.
  vi.stubGlobal('location', new URL(import.meta.url));
  vi.resetModules();
  ({ flite } = await import('../speech/flite.js'));
  aborts = new AbortController();
});

test('each text gets its own answer, in any order, from one worker', async () => {
  const shares: number[] = [];
  const [one, two] = [speak('one', (share) => shares.push(share)), speak('two')];
  expect(flite.ready).toBe(false);
  await asked();
  last().onmessage?.({ data: { kind: 'progress', share: 0.5 } });
  last().say(1);
  last().say(0);
  expect((await one).map((part) => [...part.sounds.keys()])).toEqual([['0.wav']]);
  expect((await two).map((part) => part.bundle)).toEqual(['{"1":1}']);
  expect([FakeWorker.all.length, shares, flite.ready]).toEqual([1, [0.5], true]);
});

test('two hundred texts, ended at random, leave nothing behind', async () => {
  let said = 0;
  let ended = 0;
  for (let i = 0; i < 200; i++) {
    aborts = new AbortController();
    const saying = speak(`text ${i}`).then(
      () => (said += 1),
      () => (ended += 1),
    );
    await asked();
    if ((i * 7919) % 3 === 0) aborts.abort();
    last().say(i);
    await saying;
  }
  expect([said, ended, FakeWorker.all.length]).toEqual([133, 67, 1]);
  // A cancelled text is not synthesised.
  expect(last().asked.filter(({ kind }) => kind === 'stop')).toHaveLength(67);
});

test('a voice that breaks down is told, and the next text gets a fresh one', async () => {
  const broken = speak('one');
  await asked();
  last().onmessage?.({ data: { kind: 'failed', id: 0, message: 'unreachable', dead: true } });
  await expect(broken).rejects.toThrow('unreachable');
  expect(last().ended).toBe(true);
  const again = speak('two');
  await asked();
  expect(FakeWorker.all).toHaveLength(2);
  last().say(1);
  await again;
  // An utterance that fails does not stop the engine.
  const strange = speak('three');
  await asked();
  last().onmessage?.({ data: { kind: 'failed', id: 2, message: 'too long', dead: false } });
  await expect(strange).rejects.toThrow('too long');
  expect(last().ended).toBe(false);
});

test('what is not wanted any more before there is a worker is not asked for', async () => {
  const saying = speak('one');
  aborts.abort();
  await expect(saying).rejects.toThrow();
  expect(last().asked).toEqual([]);
});

test('English alone is spoken, and figures have voices', () => {
  expect(['en', 'en-GB', 'EN-us', 'pt', 'de', 'enx', ''].map((tag) => flite.speaks(tag))).toEqual([true, true, true, false, false, false, false]);
  expect(flite.voiceOf('papous', 'en')).not.toBe(flite.voiceOf('sofia', 'en'));
});

test('packages of voices, which are built apart, make the policy of trusted types once', async () => {
  const made: string[] = [];
  vi.stubGlobal('trustedTypes', {
    createPolicy(name: string, rules: object) {
      if (made.includes(name)) throw new TypeError(`There is a policy ${name}.`);
      made.push(name);
      return rules;
    },
  });
  for (const text of ['one', 'two']) {
    vi.resetModules();
    ({ flite } = await import('../speech/flite.js'));
    const saying = speak(text);
    await asked();
    last().say(0);
    await saying;
  }
  expect([made, FakeWorker.all.length]).toEqual([['raconteur'], 2]);
});
