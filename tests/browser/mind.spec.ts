/** A mind behind the storyteller: EML by WebSocket while the story plays. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { Mind, type MindMessage } from './mind-server.js';
import { expect, test as base, type Stage } from './stage.js';

const LINE = '<voice-text time="0" timeId="v"><div>Hello <emph><tm name="w"/>world!</emph></div></voice-text>';
const HAND = '<gesture-key time="0" timeId="hand" duration="1.5" handedness="right"><motion><key x="-14" y="40" z="-6"/></motion></gesture-key>';

const test = base.extend<{ mind: Mind }>({
  // biome-ignore lint/correctness/noEmptyPattern: Playwright reads from it which fixtures this one needs.
  mind: async ({}, use) => {
    const mind = await Mind.listen();
    await use(mind);
    mind.close();
  },
});

/** Opens a waiting figure, with the voice of hello-world, and a connected mind. */
async function open(stage: Stage, mind: Mind): Promise<void> {
  await stage.open(
    `<raconteur-player src="waiting/story.eml" mind="${mind.origin}/x" captions controls></raconteur-player>`,
    { 'waiting/story.eml': '<eml><body/></eml>', ...(await voice(stage)) },
    mind.origin,
  );
  await stage.ready();
  await stage.play();
  await expect.poll(() => mind.told[0]?.kind).toBe('hello');
  // Beyond the story's end.
  await stage.until(1.5);
}

/** Returns the voice of hello-world as files of the test's folder. */
async function voice(stage: Stage): Promise<{ [path: string]: Buffer }> {
  const folder = '/assets/stories/hello-world/voice/';
  const bundle = await (await stage.page.request.get(`${folder}speech.json`)).body();
  const { utterances } = JSON.parse(bundle.toString()) as { utterances: { audio: { file: string }[] }[] };
  const files: { [path: string]: Buffer } = { 'waiting/voice/speech.json': bundle };
  for (const { file } of utterances.flatMap((u) => u.audio)) {
    files[`waiting/voice/${file}`] = await (await stage.page.request.get(folder + file)).body();
  }
  return files;
}

/** Waits for a message to the mind. */
async function told(mind: Mind, wanted: (told: MindMessage) => boolean): Promise<MindMessage> {
  await expect.poll(() => mind.told.some(wanted), { timeout: 60_000, intervals: [50] }).toBe(true);
  return mind.told.find(wanted) ?? { kind: '' };
}

test('a mind makes the storyteller speak a baked line and raise a hand', async ({ stage, page, mind }) => {
  await open(stage, mind);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.ended, p.duration])).toEqual([false, Infinity]);
  const before = await stage.picture();
  mind.send(LINE + HAND);
  const accepted = (await told(mind, (t) => t.kind === 'accepted')) as unknown as { fragment: number; clauses: { element: string; startSecs: number }[] };
  expect(accepted.clauses.map((c) => c.element)).toEqual(['voice-text', 'gesture-key']);
  // The hand is raised, the line is spoken and captioned.
  await told(mind, (t) => t.kind === 'clause' && t['element'] === 'gesture-key' && t['phase'] === 'start');
  const during = await stage.picture();
  expect(await stage.difference(before.png, during.png)).toBeGreaterThan(0.5);
  await told(mind, (t) => t.kind === 'mark' && t['name'] === 'w');
  await told(mind, (t) => t.kind === 'phone' && t['symbol'] === 'er');
  await told(mind, (t) => t.kind === 'clause' && t['element'] === 'voice-text' && t['phase'] === 'end');
  const sounds = await page.evaluate(() => window.record.starts.map((s) => s.secs));
  expect(sounds).toHaveLength(1);
  expect(sounds[0]).toBeCloseTo(1.316, 1);
  const words = await page.evaluate(() => window.record.events.filter((e) => e.type === 'word').map((e) => (e.detail as { word: { text: string } }).word.text));
  expect(words).toEqual(['Hello', 'world!']);
  const heard = mind.told.filter((t) => t.kind === 'word').map((t) => t['text']);
  expect(heard).toEqual(['Hello', 'world!']);
});

test('payloads are text, and the page may perform, too', async ({ stage, page, mind }) => {
  await open(stage, mind);
  mind.send('<event time="0" type="door">&lt;img src=x onerror=alert(1)&gt;</event>');
  await page.waitForFunction(() => window.record.events.some((e) => e.type === 'storyevent'));
  const detail = await page.evaluate(() => window.record.events.find((e) => e.type === 'storyevent')?.detail as { type: string; payload: string });
  expect([detail.type, detail.payload]).toEqual(['door', '<img src=x onerror=alert(1)>']);
  const answers = await stage.player.evaluate((p: RaconteurPlayer) => p.perform('<event time="0">from the page</event><null time="nobody"/>'));
  expect(answers.map((a) => a.kind)).toEqual(['accepted', 'failed']);
  // The mind receives events that other sources trigger.
  await told(mind, (t) => t.kind === 'storyevent' && t['payload'] === 'from the page');
});

test('garbage and a flood cost the mind its connection, not the player its story', async ({ stage, mind }) => {
  await open(stage, mind);
  mind.send('', 'hello', '<voice-text', '\u0000', '<!DOCTYPE x>', '{"eml": 1}');
  await expect.poll(() => mind.told.filter((t) => t.kind === 'failed').length).toBeGreaterThanOrEqual(6);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.error)).toBeNull();
  mind.send(...Array.from({ length: 5_000 }, () => '<null time="0"/>'));
  await told(mind, (t) => t.kind === 'failed' && t['code'] === 'live::busy');
  await expect.poll(() => mind.connections, { timeout: 60_000 }).toBe(2);
  const at = await stage.time();
  await stage.until(at + 0.5);
  // A binary message, or a message that is too long for a fragment, closes the connection
  // immediately.
  mind.sendBytes(Buffer.alloc(64, 7));
  await expect.poll(() => mind.connections, { timeout: 60_000 }).toBe(3);
  mind.send('x'.repeat(70_000));
  await expect.poll(() => mind.connections, { timeout: 60_000 }).toBe(4);
  // Then the player accepts its messages again.
  mind.send('<event time="0">well again</event>');
  await told(mind, (t) => t['payload'] === 'well again');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.length)).toBeLessThanOrEqual(200);
});

test('what is interrupted falls silent, and its mind hears no more of it', async ({ stage, page, mind }) => {
  await open(stage, mind);
  // Enough clauses that the last has not begun, however late a slow machine processes the second
  // message.
  const last = 8;
  mind.send(...Array.from({ length: last - 1 }, () => LINE), `${LINE}<event time="v+0.1">never</event>`);
  // The clauses speak one after another.
  await expect.poll(() => mind.told.filter((t) => t.kind === 'accepted').length).toBe(last);
  const spoken = mind.told.filter((t) => t.kind === 'accepted').map((t) => (t as unknown as { clauses: { startSecs: number; endSecs: number }[] }).clauses[0]);
  for (const [i, { startSecs } = { startSecs: 0 }] of spoken.slice(1).entries()) expect(startSecs).toBeCloseTo((spoken[i]?.endSecs ?? 0) + 0.15);
  await told(mind, (t) => t.kind === 'word' && t['fragment'] === 2);
  mind.send('<interrupt/>', '<event time="0.3">anew</event>');
  await told(mind, (t) => t['payload'] === 'anew');
  await stage.until((await stage.time()) + 2.5);
  const spoke = (phase: string) => mind.told.filter((t) => t.kind === 'utterance' && t['phase'] === phase).map((t) => t['fragment']);
  expect(spoke('end')).toEqual(spoke('start'));
  const begun = spoke('start').length;
  expect(begun).toBeGreaterThanOrEqual(2);
  expect(begun).toBeLessThan(last);
  const silenced = Array.from({ length: last - begun }, (_, i) => begun + 1 + i);
  const heard = new Set(mind.told.filter((t) => t.kind !== 'accepted').map((t) => t['fragment']));
  expect(silenced.filter((fragment) => heard.has(fragment))).toEqual([]);
  expect(await page.locator('raconteur-player .captions').allTextContents()).toEqual([]);
});

test('words that come piece by piece are said, and an interruption ends them', async ({ stage, page, mind }) => {
  await open(stage, mind);
  const words = () => page.evaluate(() => window.record.events.filter((e) => e.type === 'word').map((e) => (e.detail as { word: { text: string } }).word.text));
  await stage.player.evaluate(async (p: RaconteurPlayer) => {
    p.speech = 'browser';
    async function* coming() {
      for (const piece of ['One mo', 're. And t', 'wo']) yield await Promise.resolve(piece);
    }
    await p.tell(coming()).done;
  });
  expect(await words()).toEqual(['One', 'more.', 'And', 'two']);
  const before = (await words()).length;
  await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const telling = p.tell(`Once more. ${'And then once again, and so it goes on and on. '.repeat(9)}Finally.`);
    p.addEventListener('word', () => telling.interrupt(), { once: true });
    await telling.done;
  });
  // A slow frame reports all that was spoken in the meantime.
  await stage.until((await stage.time()) + 0.5);
  const told = (await words()).slice(before);
  expect(told[0]).toBe('Once');
  expect(told).not.toContain('Finally.');
  await stage.until((await stage.time()) + 1.5);
  expect((await words()).slice(before)).toEqual(told);
});

test('a lost mind is found again', async ({ stage, page, mind }) => {
  await open(stage, mind);
  await page.evaluate(() => {
    const states: string[] = [];
    Object.assign(window, { states });
    document.addEventListener('mindchange', (event) => states.push((event as CustomEvent<{ state: string }>).detail.state));
  });
  mind.drop();
  await expect.poll(() => mind.connections, { timeout: 60_000 }).toBe(2);
  await expect.poll(() => page.evaluate(() => (window as unknown as { states: string[] }).states)).toEqual(['closed', 'connecting', 'open']);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('mind-lost');
  mind.send('<event time="0">back</event>');
  await told(mind, (t) => t['payload'] === 'back');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(false);
});

test('an address that is none of a mind is named', async ({ stage }) => {
  await stage.load('hello-world', 'mind="javascript:alert(1)"');
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('mind-address');
});
