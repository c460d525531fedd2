/** How much of a test runs, and on which build: `docs/testing.md` tells of both tiers. */

import { type Kind, kinds } from '../tools/wasm.mjs';

/** Whether everything runs: `npm run test:long` sets the variable. */
export const isLong = process.env['TEST_LONG'] !== undefined;

/** The build that is tested: what ships in the long tier, in the gate one that is made sooner. */
export const kind: Kind = isLong ? kinds.shipped : kinds.quick;

/** A number of cases: `gate` of them in the gate, `long` where everything runs. */
export const sized = (gate: number, long: number): number => (isLong ? long : gate);
