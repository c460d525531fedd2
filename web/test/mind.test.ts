import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { MindLink, type MindHost } from '../element/mind/mind.js';
import type { Answer } from '../element/base/performance.js';
import type { Diagnostic, MindState } from '../element/base/types.js';

/** A socket whose other side is the test. */
class FakeSocket {
  static readonly OPEN = 1;
  static all: FakeSocket[] = [];
  readyState = 0;
  bufferedAmount = 0;
  sent: { kind: string; count?: number }[] = [];
  closedWith: number | undefined;
  onopen?: () => void;
  onmessage?: (event: { data: unknown }) => void;
  onclose?: () => void;

  constructor(readonly url: URL) {
    FakeSocket.all.push(this);
  }

  send(text: string): void {
    this.sent.push(JSON.parse(text) as { kind: string });
  }

  open(): void {
    this.readyState = 1;
    this.onopen?.();
  }

  close(code?: number): void {
    this.closedWith = code;
    this.readyState = 3;
    this.onclose?.();
  }
}

let answers: Answer[];
let performed: string[];
let states: MindState[];
let reports: Diagnostic[];
let turn: AbortController;

const host: MindHost = {
  hello: () => ({ timeSecs: 0, endSecs: 1, figure: 'sofia' }),
  perform: (fragment) => {
    performed.push(fragment);
    return answers;
  },
  interrupts: (message) => message === '<interrupt/>',
  turn: () => turn.signal,
  dropped: () => [{ kind: 'failed', timeSecs: 1, code: 'live::interrupted', message: 'dropped' }],
  report: (diagnostic) => reports.push(diagnostic),
  state: (state) => states.push(state),
};

const last = (): FakeSocket => {
  const socket = FakeSocket.all.at(-1);
  if (socket === undefined) throw new Error('nothing was opened');
  return socket;
};

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('WebSocket', FakeSocket);
  vi.stubGlobal('document', { baseURI: 'https://stories.example/page/' });
  FakeSocket.all = [];
  [answers, performed, states, reports] = [[], [], [], []];
  turn = new AbortController();
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test("addresses are those of WebSockets, or the page's own server", () => {
  for (const [address, url] of [
    ['wss://minds.example/a#b', 'wss://minds.example/a'],
    ['/mind', 'wss://stories.example/mind'],
    ['ws://localhost:7373', 'ws://localhost:7373/'],
  ] as const) {
    MindLink.open(address, host);
    vi.advanceTimersByTime(0);
    expect(last().url.href).toBe(url);
  }
  for (const address of ['javascript:alert(1)', 'data:text/plain,x', 'wss://user:pass@minds.example', 'http://[']) {
    expect(MindLink.open(address, host)).toBeUndefined();
  }
  expect(reports.map((r) => r.code)).toEqual(Array(4).fill('mind-address'));
});

test('what a mind sends is performed, and it is told the answers', () => {
  answers = [{ kind: 'accepted', timeSecs: 0, fragment: 1, clauses: [] }];
  const link = MindLink.open('wss://m.example', host);
  vi.advanceTimersByTime(0);
  last().open();
  expect(link?.listening).toBe(true);
  last().onmessage?.({ data: '<null/>' });
  expect(performed).toEqual(['<null/>']);
  expect(last().sent.map((m) => m.kind)).toEqual(['hello', 'accepted']);
  // A slow reader misses lines, and gets a message about it.
  last().bufferedAmount = 2e6;
  link?.send({ kind: 'mark', timeSecs: 1, name: 'a' });
  link?.send({ kind: 'mark', timeSecs: 1, name: 'b' });
  last().bufferedAmount = 0;
  link?.send({ kind: 'mark', timeSecs: 1, name: 'c' });
  expect(last().sent.slice(2)).toEqual([
    { kind: 'lost', count: 2 },
    { kind: 'mark', timeSecs: 1, name: 'c' },
  ]);
});

test('what has to be spoken first is answered in its order, and what comes meanwhile waits', async () => {
  const spoken: (() => void)[] = [];
  const order: string[] = [];
  MindLink.open('wss://m.example', {
    ...host,
    perform: (fragment) => {
      order.push(fragment);
      const all: Answer[] = [{ kind: 'accepted', timeSecs: order.length, fragment: order.length, clauses: [] }];
      return fragment === 'speech' ? new Promise((resolve) => spoken.push(() => resolve(all))) : all;
    },
  });
  vi.advanceTimersByTime(0);
  const socket = last();
  socket.open();
  for (const data of ['hand', 'speech', 'hand']) socket.onmessage?.({ data });
  expect(order).toEqual(['hand', 'speech']);
  spoken[0]?.();
  await vi.waitFor(() => expect(order).toEqual(['hand', 'speech', 'hand']));
  await vi.waitFor(() => expect(socket.sent.map((m) => m.kind)).toEqual(['hello', 'accepted', 'accepted', 'accepted']));
  // A flood of speech is one, too.
  for (let i = 0; i < 200; i++) socket.onmessage?.({ data: 'speech' });
  expect(socket.closedWith).toBe(4008);
});

test('an interruption passes what waits, which is answered and not performed', async () => {
  const spoken: (() => void)[] = [];
  const order: string[] = [];
  MindLink.open('wss://m.example', {
    ...host,
    turn: () => turn.signal,
    perform: (fragment) => {
      order.push(fragment);
      if (fragment === '<interrupt/>') {
        turn.abort();
        turn = new AbortController();
      }
      const all: Answer[] = [{ kind: 'accepted', timeSecs: 1, fragment: order.length, clauses: [] }];
      return fragment === 'speech' ? new Promise((resolve) => spoken.push(() => resolve(all))) : all;
    },
  });
  vi.advanceTimersByTime(0);
  const socket = last();
  socket.open();
  for (const data of ['speech', 'hand', '<interrupt/>', 'anew']) socket.onmessage?.({ data });
  expect(order).toEqual(['speech', '<interrupt/>']);
  await vi.waitFor(() => expect(order).toEqual(['speech', '<interrupt/>', 'anew']));
  spoken[0]?.();
  await vi.waitFor(() => expect(socket.sent.map((m) => m.kind)).toEqual(['hello', 'accepted', 'accepted', 'accepted', 'failed']));
  expect(order).toEqual(['speech', '<interrupt/>', 'anew']);
});

test('waits double, up to half a minute, and begin anew after a steady connection', () => {
  vi.spyOn(Math, 'random').mockReturnValue(1);
  const link = MindLink.open('wss://m.example', host);
  vi.advanceTimersByTime(0);
  const waits: number[] = [];
  for (let i = 0; i < 9; i++) {
    const count = FakeSocket.all.length;
    last().close();
    let waited = 0;
    while (FakeSocket.all.length === count) {
      vi.advanceTimersByTime(250);
      waited += 250;
    }
    waits.push(waited);
  }
  expect(waits).toEqual([500, 1000, 2000, 4000, 8000, 16000, 30000, 30000, 30000]);
  // It is reported once, not nine times.
  expect(reports).toHaveLength(1);
  last().open();
  vi.advanceTimersByTime(6000);
  last().close();
  expect(link?.listening).toBe(true);
  const count = FakeSocket.all.length;
  vi.advanceTimersByTime(500);
  expect(FakeSocket.all).toHaveLength(count + 1);
  vi.advanceTimersByTime(31_000);
  expect(link?.listening).toBe(false);
  link?.close();
  vi.advanceTimersByTime(100_000);
  expect(FakeSocket.all).toHaveLength(count + 1);
});

test('floods, bytes and endless messages close the connection', () => {
  answers = [{ kind: 'failed', timeSecs: 0, code: 'live::busy', message: '' }];
  MindLink.open('wss://m.example', host);
  vi.advanceTimersByTime(0);
  const socket = last();
  socket.open();
  for (let i = 0; i < 500; i++) socket.onmessage?.({ data: '<null/>' });
  expect([performed.length, socket.closedWith]).toEqual([100, 4008]);
  for (const [data, code] of [
    [new ArrayBuffer(8), 4003],
    ['x'.repeat(70_000), 4009],
  ] as const) {
    vi.advanceTimersByTime(30_000);
    last().open();
    last().onmessage?.({ data });
    expect(last().closedWith).toBe(code);
  }
  expect(performed).toHaveLength(100);
});
