import { expect, test, vi } from 'vitest';
import { SharedTasks } from '../element/base/shared.js';

/** Returns work whose end the test decides. */
function work() {
  const signals: AbortSignal[] = [];
  const ends: ((value: string) => void)[] = [];
  const make = vi.fn((signal: AbortSignal) => {
    signals.push(signal);
    return new Promise<string>((resolve, reject) => {
      ends.push(resolve);
      signal.addEventListener('abort', () => reject(signal.reason as Error));
    });
  });
  return { make, signals, ends };
}

const pause = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

test('what two want is made once, and kept', async () => {
  const shared = new SharedTasks<string>();
  const { make, ends } = work();
  const both = [shared.get('a', undefined, make), shared.get('a', new AbortController().signal, make)];
  ends[0]?.('made');
  expect(await Promise.all(both)).toEqual(['made', 'made']);
  expect(await shared.get('a', undefined, make)).toBe('made');
  expect(make).toHaveBeenCalledTimes(1);
});

test('what has failed is made again', async () => {
  const shared = new SharedTasks<string>();
  await expect(shared.get('a', undefined, () => Promise.reject(new Error('away')))).rejects.toThrow('away');
  expect(await shared.get('a', undefined, () => Promise.resolve('there'))).toBe('there');
});

test('who does not want it any more does not wait, and the others do', async () => {
  const shared = new SharedTasks<string>(10);
  const { make, signals, ends } = work();
  const [first, second] = [new AbortController(), new AbortController()];
  const left = shared.get('a', first.signal, make);
  const stays = shared.get('a', second.signal, make);
  first.abort(new Error('closed'));
  await expect(left).rejects.toThrow('closed');
  await pause(30);
  expect(signals[0]?.aborted).toBe(false);
  ends[0]?.('made');
  expect(await stays).toBe('made');
});

test('what nobody wants any more ends after a while, and is made anew for the next', async () => {
  const shared = new SharedTasks<string>(10);
  const { make, signals, ends } = work();
  const abort = new AbortController();
  const left = shared.get('a', abort.signal, make);
  abort.abort();
  await expect(left).rejects.toThrow();
  // A request that follows soon finds the value.
  const soon = new AbortController();
  const again = shared.get('a', soon.signal, make);
  await pause(30);
  expect([make.mock.calls.length, signals[0]?.aborted]).toEqual([1, false]);
  soon.abort();
  await expect(again).rejects.toThrow();
  await vi.waitFor(() => expect(signals[0]?.aborted).toBe(true));
  const late = shared.get('a', undefined, make);
  ends[1]?.('made');
  expect(await late).toBe('made');
  expect(make).toHaveBeenCalledTimes(2);
});
