/** The web-platform-tests for media elements, run on the browser's own element and on the player. */

import { sampled, seed } from '../../web/test/tier.js';
import { ask, makeFilm, openKit } from './media-kit.js';
import { themes } from './platform/index.js';
import { inapplicable } from './platform/inapplicable.js';
import { missed } from './platform/missed.js';
import type { Row, Theme } from './platform/rows.js';
import { expect, test, type Stage } from './stage.js';

/** Time limit: longer than any answer takes, and short enough for some rows that never return one. */
const LIMIT_MS = 8000;
/** The least share of the rows that the player answers as the specification expects. */
const MIN = 0.97;

const rows = themes.flatMap((theme) => theme.rows);
const known = new Map(missed.map(({ test, why }) => [test, why]));

interface Answers {
  readonly test: string;
  readonly expected: unknown;
  readonly control: unknown;
  readonly ours: unknown;
}

async function answersOf(stage: Stage, { control, rows }: Theme): Promise<Answers[]> {
  const all: Answers[] = [];
  for (const { test, given, expected, uncontrolled } of rows) {
    const to = { name: test, given, backend: stage.backend, limitMs: LIMIT_MS };
    const native = uncontrolled === undefined ? await ask(stage.page, control, to) : expected;
    all.push({ test, expected, control: native, ours: await ask(stage.page, 'raconteur-player', to) });
  }
  return all;
}

const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/** Formats a row whose answer differs from the expected one. */
const line = ({ test, expected }: Answers, got: unknown) => `${test}: ${JSON.stringify(got)}, not ${JSON.stringify(expected)}`;

test('every row is there once, and the share of those that are missed is small', () => {
  const names = rows.map(({ test }: Row) => test);
  expect(names.filter((name, i) => names.indexOf(name) !== i)).toEqual([]);
  expect([...known.keys()].filter((name) => !names.includes(name))).toEqual([]);
  const isOut = (name: string) => inapplicable.some(({ test }) => (test.endsWith('*') ? name.startsWith(test.slice(0, -1)) : name === test));
  expect(names.filter(isOut)).toEqual([]);
  const share = 1 - known.size / names.length;
  console.log(`${names.length} tests of web-platform-tests, ${(100 * share).toFixed(1)} % as expected; ${inapplicable.length} entries do not apply`);
  expect(share).toBeGreaterThanOrEqual(MIN);
});

for (const whole of themes) {
  test(`as web-platform-tests expect: ${whole.name}`, async ({ stage }) => {
    const theme = { ...whole, rows: sampled(whole.rows, 2, ({ test }) => test) };
    console.log(`${theme.rows.length} of ${whole.rows.length} rows, drawn by TEST_SEED=${seed}`);
    // Browsers list devices only if a microphone is allowed.
    await stage.page.context().grantPermissions(['microphone']);
    await openKit(stage, Object.fromEntries(theme.rows.map(({ test, ask }) => [test, ask])), { hasPicture: theme.seen ?? false, isStrict: false });
    if (theme.seen) await makeFilm(stage.page);
    const answers = await answersOf(stage, theme);
    const unlike = answers.filter(({ control, expected }) => !same(control, expected));
    expect.soft(unlike.map((row) => line(row, row.control))).toEqual([]);
    const failed = answers.filter(({ ours, expected }) => !same(ours, expected));
    expect.soft(failed.filter(({ test }) => !known.has(test)).map((row) => line(row, row.ours))).toEqual([]);
    const passed = answers.filter(({ test }) => known.has(test) && !failed.some((row) => row.test === test));
    expect.soft(passed.map(({ test }) => `${test}: passes, and is in the list of missed ones`)).toEqual([]);
  });
}
