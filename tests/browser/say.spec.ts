/** Tests of speech synthesis in the page for text without a recording. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test } from './stage.js';

test('a story without a recording is spoken in the page, and its words have the times of the sound', async ({ stage }) => {
  await stage.open('<raconteur-player src="story.eml" quality="lowest" loading="eager" speech="here"></raconteur-player>', {
    'story.eml': "<eml><body><voice-text time='0'>One, two, three.</voice-text></body></eml>",
  });
  await stage.ready();
  // The player fetches no figure before playback.
  expect(await stage.page.evaluate(() => performance.getEntriesByType('resource').some((r) => r.name.includes('flite')))).toBe(false);
  await stage.play();
  await stage.page.waitForFunction(() => document.querySelector('raconteur-player')?.ended, undefined, { timeout: 60_000 });
  const events = await stage.page.evaluate(() =>
    window.record.events.filter((e) => e.type === 'phone' || e.type === 'diagnostic').map((e) => e.detail as { symbol?: string; code?: string }),
  );
  expect(events.map((e) => e.symbol).join(' ')).toMatch(/w ah n .*t uw .*th r iy/);
  expect(events.map((e) => e.code)).not.toContain('voice-missing');
  const sounds = await stage.page.evaluate(() => window.record.starts.map((s) => s.secs));
  expect(Math.max(...sounds)).toBeGreaterThan(0.8);
});

test('what a page has performed is spoken, too', async ({ stage }) => {
  await stage.open('<raconteur-player src="story.eml" quality="lowest" loading="eager" speech="here"></raconteur-player>', { 'story.eml': '<eml><body/></eml>' });
  await stage.ready();
  const answers = await stage.player.evaluate((p: RaconteurPlayer) => p.perform("<voice-text time='0'>The cat sat.</voice-text>"));
  expect(answers.map((a) => a.kind)).toContain('accepted');
  await stage.play();
  const phones = () => stage.page.evaluate(() => window.record.events.filter((e) => e.type === 'phone').map((e) => (e.detail as { symbol: string }).symbol));
  await expect.poll(async () => (await phones()).join(' '), { timeout: 60_000 }).toMatch(/k ae t s ae t/);
  const sounds = await stage.page.evaluate(() => window.record.starts.map((s) => s.secs));
  expect(Math.max(...sounds)).toBeGreaterThan(0.6);
});
