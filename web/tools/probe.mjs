// Measures the current speed of this machine with a fixed piece of work on all processors. The
// times of checks are compared with those of the reference machine in docs/testing.md by it. Uses
// only Node's own modules.

import { availableParallelism } from 'node:os';
import { fileURLToPath } from 'node:url';
import { isMainThread, parentPort, Worker } from 'node:worker_threads';

/** Runs a workload typical of compilers and tests: hashing, pointer chasing through memory larger than any cache, and floating-point arithmetic. */
function work() {
  const size = 1 << 22;
  const next = new Uint32Array(size);
  let seed = 1;
  const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0);
  for (let i = 0; i < size; i++) next[i] = random() % size;
  let at = 0;
  for (let i = 0; i < 6_000_000; i++) at = next[(at + i) % size] ?? 0;
  const values = Float64Array.from({ length: 1_500_000 }, () => random() / 2 ** 32);
  let sum = 0;
  for (let round = 0; round < 40; round++) for (let i = 0; i < values.length; i++) sum += Math.sqrt((values[i] ?? 0) + round);
  const names = new Map();
  for (let i = 0; i < 600_000; i++) names.set(`n${random() % 200_000}`, i);
  values.sort();
  return at + sum + names.size;
}

/** Returns the duration in seconds of the workload on all processors simultaneously. */
export async function probe() {
  const begun = performance.now();
  await Promise.all(
    Array.from({ length: availableParallelism() }, () => new Promise((resolve, reject) => new Worker(fileURLToPath(import.meta.url)).once('message', resolve).once('error', reject))),
  );
  return (performance.now() - begun) / 1000;
}

if (!isMainThread) parentPort?.postMessage(work());
