/** Tests of many texts in succession, and unusual ones: none is mixed with another, lost, or left behind. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { sized } from '../../web/test/tier.js';
import { expect, type Stage, test } from './stage.js';

/** Number of texts, most of which are replaced during synthesis or speech. */
const TEXTS = sized(16, 200);

const story = (text: string) => `<eml><body><voice-text time='0.1'>${text}</voice-text></body></eml>`;

/** Replaces the text on stage and plays it; only its events are recorded. */
async function say(stage: Stage, text: string): Promise<void> {
  await stage.player.evaluate(async (p: RaconteurPlayer, eml) => {
    p.pause();
    await p.rehearse(eml);
    p.currentTime = 0;
    window.record.events.length = 0;
    void p.play().catch(() => undefined);
  }, story(text));
}

declare global {
  interface Window {
    /** Start and stop of each sound, in the context's time; -1 for one that never stopped. */
    heard: { from: number; to: number }[];
  }
}

test('texts that replace each other at any moment never sound together, and the last is said whole', async ({ stage }) => {
  test.setTimeout(300_000);
  await stage.page.addInitScript(() => {
    window.heard = [];
    const of = new WeakMap<AudioBufferSourceNode, { from: number; to: number }>();
    const { start, stop } = AudioBufferSourceNode.prototype;
    AudioBufferSourceNode.prototype.start = function (when = 0, offset = 0, ...rest: []) {
      const span = { from: when, to: when + (this.buffer?.duration ?? 0) - offset };
      of.set(this, span);
      window.heard.push(span);
      start.call(this, when, offset, ...rest);
    };
    AudioBufferSourceNode.prototype.stop = function (when = 0) {
      const span = of.get(this);
      // The audio fades out within 10 ms of the call and stays silent.
      if (span !== undefined) span.to = Math.min(span.to, Math.max(span.from, this.context.currentTime + 0.01));
      stop.call(this, when);
    };
  });
  await stage.open('<raconteur-player src="story.eml" quality="lowest" loading="eager" speech="here" captions></raconteur-player>', { 'story.eml': story('Hello.') });
  await stage.ready();
  await stage.play();
  await stage.page.waitForFunction(() => document.querySelector('raconteur-player')?.ended, undefined, { timeout: 60_000 });
  const session = await stage.page.context().newCDPSession(stage.page);
  const heap = async () => {
    await session.send('HeapProfiler.collectGarbage');
    return ((await session.send('Runtime.getHeapUsage')) as { usedSize: number }).usedSize;
  };
  const before = await heap();
  const errors: string[] = [];
  stage.page.on('pageerror', (error) => errors.push(error.message));
  let seed = 11;
  const random = (most: number) => (seed = (seed * 48_271) % 2_147_483_647) % most;
  const wordsSoFar = () => stage.page.evaluate(() => window.record.events.filter(({ type }) => type === 'word').length);
  for (let i = 0; i < TEXTS; i++) {
    const spoken = await wordsSoFar();
    await stage.player.evaluate(
      async (p: RaconteurPlayer, eml) => {
        p.pause();
        await p.rehearse(eml);
        p.currentTime = 0;
        void p.play().catch(() => undefined);
      },
      story(`Sentence ${i} has ${random(900)} words of its own, number ${random(90)}.`),
    );
    // However slow the machine is, some texts are replaced while they are spoken.
    if (i % 8 === 0) await stage.page.waitForFunction((n) => window.record.events.filter(({ type }) => type === 'word').length > n, spoken, { timeout: 60_000 });
    else await stage.page.waitForTimeout(random(700));
  }
  const last = 'And this one is the very last.';
  await say(stage, last);
  await stage.page.waitForFunction(() => document.querySelector('raconteur-player')?.ended, undefined, { timeout: 60_000 });
  const words = await stage.page.evaluate(() => window.record.events.flatMap((e) => (e.type === 'word' ? [(e.detail as { word: { text: string } }).word.text] : [])));
  expect(words.join(' ')).toBe(last);
  const heard = await stage.page.evaluate(() => window.heard);
  const spans = heard.filter(({ from, to }) => to > from).sort((a, b) => a.from - b.from);
  expect(spans.length).toBeGreaterThanOrEqual(TEXTS / 8);
  for (const [i, { from }] of spans.entries()) if (i > 0) expect(from, `sound ${i}`).toBeGreaterThan((spans[i - 1]?.to ?? 0) - 0.02);
  expect(errors).toEqual([]);
  // The player releases the audio and bundles of removed texts.
  expect((await heap()) - before).toBeLessThan(8e6);
});

test('strange texts are said or told of, and end nothing', async ({ stage }) => {
  test.setTimeout(240_000);
  await stage.open('<raconteur-player src="story.eml" quality="lowest" loading="eager" speech="here" captions></raconteur-player>', { 'story.eml': story('Hello.') });
  await stage.ready();
  const errors: string[] = [];
  stage.page.on('pageerror', (error) => errors.push(error.message));
  const strange = [
    'word '.repeat(20_000),
    'x'.repeat(100_000),
    '&#x202E;sdrawkcab&#x202C; שלום עולם مرحبا',
    '🐇🐇🐇 👩‍👩‍👧‍👦 ☃',
    '&lt;script>alert(1)&lt;/script> &amp;amp; ]]&gt;',
    '&#0;&#xFFFF;\u0001\u{10FFFF}',
    '…!?,;:—"\'()[]{}',
    "<r:nothing xmlns:r='urn:raconteur:eml:1'/><tm name='a'/><tm name='a'/>",
    'Ünïcödé àccênts ñ ß œ',
    '1e999999 -0 0x1F 10^10^10 $1,000,000,000,000,000,000',
  ];
  for (const text of strange) {
    await say(stage, text);
    await stage.page.waitForTimeout(300);
  }
  // The next text is spoken, whatever happened to these.
  await say(stage, 'Still here.');
  const phones = () => stage.page.evaluate(() => window.record.events.flatMap((e) => (e.type === 'phone' ? [(e.detail as { symbol: string }).symbol] : [])).join(' '));
  await expect.poll(phones, { timeout: 90_000 }).toMatch(/s t ih l hh i[hy] r/);
  // Loaded files need no network.
  await stage.page.context().setOffline(true);
  await say(stage, 'Without a wire.');
  await expect.poll(phones, { timeout: 60_000 }).toMatch(/w ay er|w ay r/);
  expect(errors).toEqual([]);
  expect(await stage.page.evaluate(() => window.record.violations)).toEqual([]);
});
