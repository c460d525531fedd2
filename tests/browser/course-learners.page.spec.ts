/** Tests of random learners of a course in systems and with record stores: the record matches their actions, even after faults. */

import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import type { BrowserContext, Frame, Page } from '@playwright/test';
import { random, type Next } from '../../web/test/course-questions.js';
import { sized } from '../../web/test/tier.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { exported, kept, serve, TYPES, type SYSTEMS } from './lms.js';
import { Lrs, verbOf } from './lrs.js';
import { expect, test } from './stage.js';

/** Two parts, four questions, one of them not on all paths. */
const STORY = `<eml xmlns:r='urn:raconteur:eml:1'><body><seq time='0'><r:part time='0' name='one' title='One'><seq time='0'><null time='1'/>
  <r:ask time='0' name='who' prompt='Who sang?' points='2' tries='2'><r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone'/>
    <r:answer to='right'><null time='0.5'/></r:answer><r:answer to='wrong'><null time='1'/></r:answer></r:ask>
  <null time='1'/>
  <r:ask time='0' name='green' type='several' prompt='What is green?' points='1'><r:option name='leaf' text='A leaf' right='true'/><r:option name='frog' text='A frog' right='true'/><r:option name='snow' text='Snow'/></r:ask>
  <r:if name='who' is='wrong'><r:ask time='0' name='more' prompt='Once more: who?' points='1'><r:option name='frog' text='A frog' right='true'/><r:option name='owl' text='An owl'/></r:ask></r:if>
  </seq></r:part><r:part time='0' name='two' title='Two'><seq time='0'><null time='1'/>
  <r:ask time='0' name='why' type='text' prompt='Why?' points='3' tries='2'><r:option name='cold' accepts='cold|winter' right='true'/></r:ask><null time='1'/></seq></r:part></seq></body></eml>`;
const GIVEN: { readonly [name: string]: readonly (readonly string[])[] } = {
  who: [['frog'], ['stone']],
  green: [['leaf', 'frog'], ['snow'], ['leaf']],
  more: [['frog'], ['owl']],
  why: [['It was cold.'], ['No idea, really.']],
};
const WATCHED = 0.9;
/** Share of answers that may be lost: some tenths of a second before a page is killed, at each of three kills. */
const LOST_SHARE = 0.35;

interface SeenAnswer {
  readonly name: string;
  readonly given: readonly string[];
  readonly isRight: boolean | undefined;
}

/** Environment of a course, with its final record. */
interface World {
  open(page: Page): Promise<Frame>;
  fault(page: Page, next: Next | undefined): Promise<void>;
  record(page: Page): Promise<{ readonly answers: readonly (boolean | undefined)[]; readonly points: number; readonly isComplete: boolean }>;
}

const story = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'story.eml');
writeFileSync(story, STORY);
const OPTIONS = ['--watched', String(100 * WATCHED)];

function system(standard: keyof typeof SYSTEMS): World {
  return {
    async open(page) {
      await serve(page, standard, story, ...OPTIONS);
      await page.locator('iframe').waitFor();
      return page.frames()[1] as Frame;
    },
    fault: (page, next) => page.evaluate((refuses) => void Object.assign(window, { refuses }), next !== undefined && next() < 0.5),
    async record(page) {
      const [interactions, status, raw] = [
        (await kept(page, ['interactions'])) as { [n: string]: { result: string } },
        await kept(page, standard === 'scorm12' ? ['core', 'lesson_status'] : ['completion_status']),
        await kept(page, standard === 'scorm12' ? ['core', 'score', 'raw'] : ['score', 'raw']),
      ];
      const isComplete = ['completed', 'passed', 'failed'].includes(String(status));
      return { answers: Object.values(interactions).map(({ result }) => result === 'correct'), points: Number(raw), isComplete };
    },
  };
}

function store(standard: 'xapi' | 'cmi5'): World {
  const lrs = new Lrs({ contextTemplate: { extensions: { 'https://w3id.org/xapi/cmi5/context/extensions/sessionid': 's' } }, launchMode: 'Normal', moveOn: 'Completed' });
  const files = exported(standard, story, ...OPTIONS);
  return {
    async open(page) {
      await page.unrouteAll();
      await lrs.serve(page.context());
      await page.route('**/site/**', (route) => {
        const path = new URL(route.request().url()).pathname.replace(/^\/site\//, '') || 'index.html';
        const file = files[path];
        return file === undefined ? route.fulfill({ status: 404 }) : route.fulfill({ contentType: TYPES[extname(path)] ?? 'application/octet-stream', body: Buffer.from(file) });
      });
      await page.goto(lrs.launch('/site/', standard === 'cmi5'));
      return page.mainFrame();
    },
    fault: (_, next) => {
      lrs.fault = next === undefined ? undefined : ([undefined, undefined, 'away', 'lost', 401, 500] as const)[Math.floor(6 * next())];
      return Promise.resolve();
    },
    record: () => {
      const told = [...lrs.statements].sort((a, b) => a.timestamp.localeCompare(b.timestamp));
      const scores = told.flatMap((it) => (verbOf(it) === 'answered' ? [] : (it.result?.score?.raw ?? [])));
      return Promise.resolve({
        answers: told.filter((it) => verbOf(it) === 'answered').map(({ result }) => result?.success),
        points: scores.at(-1) ?? 0,
        isComplete: told.filter((it) => verbOf(it) === 'completed').length === 1,
      });
    },
  };
}

const WORLDS = { scorm12: () => system('scorm12'), scorm2004: () => system('scorm2004'), xapi: () => store('xapi'), cmi5: () => store('cmi5') } as const;

/** Actions of a learner as the page reported them. */
interface Truth {
  readonly told: SeenAnswer[];
  /** Tenths of a second of the story that were played. */
  readonly seen: Set<number>;
}

/** Opens a page of the course without rendering, which records the learner's actions. */
async function opened(context: BrowserContext, world: World, truth: Truth): Promise<{ page: Page; frame: Frame }> {
  const page = await context.newPage();
  await page.addInitScript(() => {
    // The recorded data does not depend on rendering.
    HTMLCanvasElement.prototype.getContext = () => null;
    Object.defineProperty(navigator, 'gpu', { value: undefined });
  });
  await page.exposeBinding('tell', (_, answered: SeenAnswer | undefined, seen: number[]) => {
    if (answered !== undefined) truth.told.push(answered);
    for (const tenth of seen) truth.seen.add(tenth);
  });
  const frame = await world.open(page);
  await frame.waitForFunction(() => ((document.querySelector('raconteur-player') as RaconteurPlayer | null)?.readyState ?? 0) >= 2, undefined, { timeout: 60_000 });
  await frame.evaluate(() => {
    const player = document.querySelector('raconteur-player') as RaconteurPlayer;
    const { tell } = window as unknown as { tell(answered: SeenAnswer | undefined, seen: number[]): void };
    player.muted = true;
    player.playbackRate = 2;
    const seen = () => {
      const { played } = player;
      const spans = Array.from({ length: played.length }, (_, i) => [played.start(i), played.end(i)] as const);
      return Array.from({ length: Math.ceil(10 * player.duration) }, (_, i) => i).filter((i) => spans.some(([from, to]) => from <= i / 10 + 0.05 && i / 10 + 0.05 < to));
    };
    player.addEventListener('answer', ({ detail: { name, given, isRight } }) => tell({ name, given, isRight }, seen()));
    setInterval(() => tell(undefined, seen()), 100);
  });
  return { page, frame };
}

/** Performs a random action. */
async function act(frame: Frame, next: Next): Promise<void> {
  const asked = await frame.evaluate(() => (document.querySelector('raconteur-player') as RaconteurPlayer).question?.name);
  const given = asked === undefined ? [] : (GIVEN[asked] ?? []);
  const [kind, share, rate] = [next(), next(), [0.5, 1, 1.5, 2][Math.floor(4 * next())]];
  await frame.evaluate(
    ([given, kind, share, rate]) => {
      const player = document.querySelector('raconteur-player') as RaconteurPlayer;
      if (given !== undefined) player.answer(...given);
      else if (kind < 0.1) player.pause();
      else if (kind < 0.2) player.currentTime = share * player.duration;
      else if (kind < 0.3) player.playbackRate = rate ?? 1;
      else player.play().catch(() => undefined);
    },
    [given[Math.floor(given.length * next())], kind, share, rate] as const,
  );
  await frame.waitForTimeout(100 + 500 * next());
}

async function learn(context: BrowserContext, world: World, next: Next): Promise<void> {
  const truth: Truth = { told: [], seen: new Set() };
  for (let visit = 0; visit < 3; visit++) {
    const isLast = visit === 2;
    await world.fault(await blank(context), undefined);
    const { page, frame } = await opened(context, world, truth);
    for (let i = 0; i < (isLast ? 3 : 10); i++) {
      if (next() < 0.4) await world.fault(page, isLast ? undefined : next);
      await act(frame, next);
    }
    if (isLast) {
      await world.fault(page, undefined);
      // The page sends a failed report again within a minute. A page that unloads sends it
      // immediately, and the next page sends the rest.
      await page.goto('about:blank');
      const again = await opened(context, world, truth);
      await expect.poll(async () => (await world.record(again.page)).answers.length, { timeout: 90_000 }).toBe(truth.told.length);
      const { optional, duration } = await again.frame.evaluate(() => {
        const { optional, duration } = document.querySelector('raconteur-player') as RaconteurPlayer;
        return { optional, duration };
      });
      // The story plays before the system has returned the earlier answers.
      const score = () => again.frame.evaluate(() => (document.querySelector('raconteur-player') as RaconteurPlayer).score.points);
      await expect.poll(async () => (await score()) - (await world.record(again.page)).points, { timeout: 60_000 }).toBe(0);
      const scored = await score();
      await again.page.goto('about:blank');
      await again.page.waitForTimeout(500);
      // A page of the same origin reads the data that a system stores here.
      await again.page.route('**/nothing', (route) => route.fulfill({ contentType: 'text/html', body: '<title>Nothing</title>' }));
      await again.page.goto('/nothing');
      const { answers, points, isComplete } = await world.record(again.page);
      expect(answers).toEqual(truth.told.map(({ isRight }) => isRight));
      expect(points).toBe(scored);
      const wanted = Array.from({ length: Math.floor(10 * duration) }, (_, i) => i).filter((i) => !optional.some(([from, to]) => from <= i / 10 && i / 10 < to));
      const share = wanted.filter((i) => truth.seen.has(i)).length / wanted.length;
      if (isComplete) expect(share).toBeGreaterThan(WATCHED - 0.05);
      else expect(share).toBeLessThan(WATCHED + LOST_SHARE);
    } else if (next() < 0.5) {
      // The machine shuts down.
      const devtools = await context.newCDPSession(page);
      await Promise.race([devtools.send('Page.crash').catch(() => undefined), page.waitForEvent('crash')]);
    } else await page.goto('about:blank');
    await page.close();
  }
}

/** Opens an arbitrary page for requests to systems. */
async function blank(context: BrowserContext): Promise<Page> {
  const page = context.pages()[0] ?? (await context.newPage());
  return page;
}

for (const [standard, make] of Object.entries(WORLDS)) {
  test(`what ${sized(1, 50)} random learners do is what the record of ${standard} has`, async ({ browser, baseURL }) => {
    test.setTimeout(sized(240_000, 3_000_000));
    for (let learner = 0; learner < sized(1, 50); learner++) {
      const context = await browser.newContext({ ...(baseURL === undefined ? {} : { baseURL }) });
      await test.step(`learner ${learner}`, () => learn(context, make(), random(learner + 1)));
      await context.close();
    }
  });
}
