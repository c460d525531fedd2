/** Test tier and tested build: `docs/testing.md` describes both tiers. */

import { createHash } from 'node:crypto';
import { ask } from '../tools/steps.mjs';
import { type Kind, kinds } from '../tools/wasm.mjs';

/** True if all tests run: `npm run test:long` sets the variable. */
export const isLong = process.env['TEST_LONG'] !== undefined;

/** Tested build: the shipped one in the long tier, a quickly built one in the gate. */
export const kind: Kind = isLong ? kinds.shipped : kinds.quick;

/** Returns a number of cases: `gate` of them in the gate, `long` where everything runs. */
export const sized = (gate: number, long: number): number => (isLong ? long : gate);

/** Seed of samples: the commit, so that everything is covered over time, or `TEST_SEED`. */
export const seed = process.env['TEST_SEED'] ?? ask('git', ['rev-parse', 'HEAD'])?.trim() ?? '';

/** Returns one in `turns` of the items, by their names and the seed; all of them in the long tier. */
export function sampled<T>(things: readonly T[], turns: number, name: (thing: T) => string): readonly T[] {
  if (isLong) return things;
  const turn = (text: string) => (createHash('sha256').update(`${seed}\0${text}`).digest()[0] ?? 0) % turns;
  return things.filter((thing) => turn(name(thing)) === 0);
}
