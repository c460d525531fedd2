/** Tests of playback, compared with a media element. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { bundle, expect, test } from './stage.js';
import { steadyClock } from './tap.js';

/** Sounds are planned as they are decoded, in any order; the first is the one that begins first. */
function firstSound<S extends { when: number; offset: number }>(starts: readonly S[]): S | undefined {
  return [...starts].sort((a, b) => a.when - a.offset - (b.when - b.offset))[0];
}

test('plays with sound, captions and a moving picture', { tag: '@draws' }, async ({ stage, page }) => {
  await stage.load('white-rabbit');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.activeBackend)).toBe(stage.backend);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.duration)).toBeGreaterThan(75);
  const before = await stage.picture();
  expect(before.spread).toBeGreaterThan(8);

  await stage.play();
  await stage.until(1.5);
  expect(await page.evaluate(() => window.record.contexts.map((c) => c.state))).toEqual(['running']);
  const during = await stage.picture();
  expect(await stage.difference(before.png, during.png)).toBeGreaterThan(0.5);

  // The scheduled audio matches the story's time. Both clocks are read in one task, in which the
  // audio clock stands still.
  const [now, context, starts] = await stage.player.evaluate((p: RaconteurPlayer) => {
    const audio = window.record.contexts[0];
    return [p.currentTime, (audio?.currentTime ?? 0) - (audio?.outputLatency ?? 0), window.record.starts] as const;
  });
  const first = firstSound(starts);
  expect(first).toBeDefined();
  const clause = await page.evaluate(() => window.record.events.find((e) => e.type === 'clause' && (e.detail as { element: string }).element === 'voice-text'));
  const heard = context - (first?.when ?? 0) + (first?.offset ?? 0);
  const spoken = now - ((clause?.detail as { timeSecs: number } | undefined)?.timeSecs ?? NaN);
  expect(Math.abs(heard - spoken)).toBeLessThan(0.06);
  expect(await stage.events()).toEqual(expect.arrayContaining(['loadedmetadata', 'play', 'playing', 'timeupdate', 'word', 'clause']));
});

test('the caption marks the word being spoken', async ({ stage, page }) => {
  const [first] = bundle('white-rabbit');
  if (first === undefined) throw new Error('the story says nothing');
  await steadyClock(page);
  await stage.load('white-rabbit', 'captions controls');
  const words = first.words;
  // During playback: whenever the caption changes, it marks the word spoken at that time.
  const marked = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const seen: { text: string; at: number }[] = [];
    let text: string | undefined;
    const observer = new MutationObserver(() => {
      const now = p.shadowRoot?.querySelector('mark')?.textContent ?? '';
      if (now !== text) seen.push({ text: (text = now), at: p.currentTime });
    });
    if (p.shadowRoot) observer.observe(p.shadowRoot, { subtree: true, childList: true, characterData: true });
    await p.play();
    while (seen.filter((s) => s.text !== '').length < 5 && !p.ended) await new Promise((done) => setTimeout(done, 50));
    observer.disconnect();
    return seen;
  });
  // Spoken words, each at its story time; a slow machine shows words of several utterances.
  const told = await page.evaluate(() =>
    window.record.events.filter((e) => e.type === 'utterance').map(({ detail }) => detail as { phase: string; text: string; startSecs: number }),
  );
  const spoken = told
    .filter(({ phase }) => phase === 'start')
    .flatMap(({ text, startSecs }) => {
      const utterance = bundle('white-rabbit').find((u) => u.text === text);
      return (utterance?.words ?? []).map((w) => ({ text: w.text, from: startSecs + w.start_secs, to: startSecs + w.end_secs }));
    });
  const start = told[0]?.startSecs ?? NaN;
  for (const { text, at } of marked) {
    // Times of words are sums: the last bits may differ.
    const slack = text === '' ? -1e-6 : 1e-6;
    const heard = spoken.filter((w) => at > w.from - slack && at < w.to + slack).map((w) => w.text);
    if (text === '') expect(heard, `at ${at} s`).toEqual([]);
    else expect(heard, `at ${at} s`).toContain(text);
  }
  expect(marked.length).toBeGreaterThanOrEqual(4);
  // At rest: exactly.
  await stage.pause();
  for (const index of [0, Math.floor(words.length / 2), words.length - 1]) {
    const word = words[index];
    if (word === undefined) continue;
    await stage.seek(start + (word.start_secs + word.end_secs) / 2);
    await expect(stage.captionWord).toHaveText(word.text);
  }
});

test('seeks forwards and back, at rest and while playing', async ({ stage, page }) => {
  await stage.load('white-rabbit');
  await stage.seek(20);
  const at20 = await stage.picture();
  await stage.seek(6);
  const at6 = await stage.picture();
  expect(await stage.difference(at20.png, at6.png)).toBeGreaterThan(0.3);
  await stage.seek(20);
  const again = await stage.picture();
  expect(await stage.difference(at20.png, again.png)).toBeLessThan(0.05);

  await stage.play();
  await stage.until(20.3);
  await stage.seek(40);
  expect(await stage.time()).toBeGreaterThanOrEqual(40);
  await stage.until(40.5);
  await stage.seek(10);
  expect(await stage.time()).toBeLessThan(12);
  await stage.until(10.4);
  expect(await stage.events()).toEqual(expect.arrayContaining(['seeking', 'seeked']));
  // Words between the two positions were not spoken.
  const words = await page.evaluate(() => window.record.events.filter((e) => e.type === 'word').map((e) => (e.detail as { word: { startSecs: number } }).word.startSecs));
  expect(words.filter((t) => t > 24 && t < 39.9)).toEqual([]);
});

test('pausing stops the time, and playing goes on from there', async ({ stage, page }) => {
  await stage.load('white-rabbit');
  await stage.play();
  await stage.until(1);
  await stage.pause();
  const at = await stage.time();
  await page.waitForTimeout(600);
  expect(await stage.time()).toBe(at);
  await stage.play();
  await stage.until(at + 0.3);
  expect((await stage.events()).filter((e) => e === 'play' || e === 'pause')).toEqual(['play', 'pause', 'play']);
});

test('plays faster, with sound of the right length', async ({ stage, page }) => {
  await stage.load('white-rabbit');
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.playbackRate = 2));
  await stage.play();
  await stage.until(1);
  // Compared with the clock of the audible sound, so the load of the machine has no effect.
  const times = () => stage.player.evaluate((p: RaconteurPlayer) => [p.currentTime, window.record.contexts[0]?.currentTime ?? NaN] as const);
  const [begin, heardFrom] = await times();
  await stage.until(begin + 3);
  const [end, heardTo] = await times();
  expect((end - begin) / (heardTo - heardFrom)).toBeGreaterThan(1.9);
  expect((end - begin) / (heardTo - heardFrom)).toBeLessThan(2.1);
  const length = bundle('white-rabbit')[0]?.duration_secs ?? 0;
  const sound = firstSound(await page.evaluate(() => window.record.starts))?.secs ?? 0;
  expect(Math.abs(sound - length / 2)).toBeLessThan(0.05);
});

test('ends, and plays again from the start', async ({ stage }) => {
  await stage.load('hello-world');
  await stage.seek(await stage.player.evaluate((p: RaconteurPlayer) => p.duration - 0.3));
  await stage.play();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.ended)).toBe(true);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
  await stage.player.getByRole('button', { name: 'Play the story again' }).click();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(false);
  expect(await stage.time()).toBeLessThan(2);
});

test('two players on one page keep their own time', { tag: '@draws' }, async ({ stage, page }) => {
  const one = (id: string) => `<raconteur-player id="${id}" loading="eager" src="/assets/stories/white-rabbit/story.eml" captions></raconteur-player>`;
  await stage.open(one('a') + one('b'));
  const [a, b] = [page.locator('#a'), page.locator('#b')];
  await stage.ready(a);
  await stage.ready(b);
  await stage.seek(8, a);
  await stage.play(a);
  await stage.play(b);
  await stage.until(8.5, a);
  await stage.until(0.4, b);
  await stage.pause(a);
  const at = await stage.time(a);
  const other = await stage.time(b);
  await stage.until(other + 0.3, b);
  expect(await stage.time(a)).toBe(at);
  for (const player of [a, b]) expect((await stage.picture(player)).spread).toBeGreaterThan(8);
});

test('the controls and the keys do what they say', async ({ stage, page }) => {
  await stage.load('white-rabbit');
  const state = () => stage.player.evaluate((p: RaconteurPlayer) => ({ paused: p.paused, muted: p.muted, captions: p.captions, volume: p.volume, time: p.currentTime }));
  await stage.player.focus();
  await page.keyboard.press('Space');
  await expect.poll(async () => (await state()).paused).toBe(false);
  await page.keyboard.press('Space');
  await expect.poll(async () => (await state()).paused).toBe(true);
  const at = (await state()).time;
  await page.keyboard.press('ArrowRight');
  expect((await state()).time).toBeCloseTo(at + 5, 5);
  await page.keyboard.press('ArrowLeft');
  expect((await state()).time).toBeCloseTo(at, 5);
  await page.keyboard.press('ArrowDown');
  expect((await state()).volume).toBeCloseTo(0.9, 5);
  await page.keyboard.press('m');
  expect((await state()).muted).toBe(true);
  await page.keyboard.press('c');
  expect((await state()).captions).toBe(false);
  await page.keyboard.press('f');
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe('raconteur-player');
  await page.keyboard.press('Escape');
  await expect.poll(() => page.evaluate(() => document.fullscreenElement)).toBeNull();

  // By name, as a screen reader finds it.
  const seek = stage.player.getByRole('slider', { name: 'Seek' });
  await seek.focus();
  await page.keyboard.press('Home');
  expect((await state()).time).toBe(0);
  await expect(seek).toHaveAttribute('aria-valuetext', /^0 seconds of \d+ minutes? /);
  await stage.player.getByRole('button', { name: 'Mute' }).click();
  expect((await state()).muted).toBe(false);
  await stage.player.getByRole('combobox', { name: 'Speed' }).selectOption('1.5');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.playbackRate)).toBe(1.5);
  await stage.player.getByRole('button', { name: 'Play', exact: true }).click();
  await expect(stage.player.getByRole('status')).toHaveText('Playing');
});
