/** How much of a test runs, and on which build: `docs/testing.md` tells of both tiers. */

import { createHash } from 'node:crypto';
import { ask } from '../tools/steps.mjs';
import { type Kind, kinds } from '../tools/wasm.mjs';

/** Whether everything runs: `npm run test:long` sets the variable. */
export const isLong = process.env['TEST_LONG'] !== undefined;

/** The build that is tested: what ships in the long tier, in the gate one that is made sooner. */
export const kind: Kind = isLong ? kinds.shipped : kinds.quick;

/** A number of cases: `gate` of them in the gate, `long` where everything runs. */
export const sized = (gate: number, long: number): number => (isLong ? long : gate);

/** What samples are drawn by: the commit, so that in time all is looked at, or `TEST_SEED`. */
export const seed = process.env['TEST_SEED'] ?? ask('git', ['rev-parse', 'HEAD'])?.trim() ?? '';

/** One in `turns` of some things, by their names and the seed; all of them in the long tier. */
export function sampled<T>(things: readonly T[], turns: number, name: (thing: T) => string): readonly T[] {
  if (isLong) return things;
  const turn = (text: string) => (createHash('sha256').update(`${seed}\0${text}`).digest()[0] ?? 0) % turns;
  return things.filter((thing) => turn(name(thing)) === 0);
}
