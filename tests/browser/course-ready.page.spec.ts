/** Tests of the complete sample course in a learning management system, from its first question to its last, by keyboard only. */

import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers } from './access.js';
import { exported, kept, playerIn, root, serve } from './lms.js';
import { expect, ready, test } from './stage.js';

const COURSE = join(root, 'assets/courses/how-a-story-is-told');

test('the ready course is passed with the keyboard alone, and the system has all that was answered', async ({ page }) => {
  test.setTimeout(400_000);
  await page.setViewportSize({ width: 1000, height: 760 });
  // Seeking is not watching.
  await serve(page, 'scorm2004', COURSE, '--watched', '0');
  const player = playerIn(page);
  await ready(player);
  const form = page.frameLocator('iframe').locator('[part~=question]');
  await player.evaluate((p: RaconteurPlayer) => {
    p.muted = true;
    p.setAttribute('quality', 'lowest');
  });
  const { questions, chapters, score } = await player.evaluate((p: RaconteurPlayer) => ({
    questions: p.questions,
    chapters: p.chapters.map(({ title }) => title),
    score: p.score,
  }));
  expect(questions.map(({ kind }) => kind)).toEqual(['choice', 'gap', 'match', 'point', 'order', 'text']);
  expect(chapters).toHaveLength(3);
  expect(score).toEqual({ points: 0, most: 15 });

  const press = async (...keys: readonly string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  /** Functions that answer each question with the keyboard, from its first field, which has the focus. */
  const answers: { readonly [name: string]: () => Promise<void> } = {
    opening: () => press('ArrowDown', 'Enter'),
    pause: async () => {
      await page.keyboard.type('Wait');
      await press('Tab');
      await page.keyboard.type('look!');
      await press('Enter');
    },
    hands: async () => {
      for (const [i, { partner = '' }] of (questions[2]?.options ?? []).entries()) {
        const partners = await form.locator('select').nth(i).locator('option').allTextContents();
        for (let k = 0; k < partners.indexOf(partner); k += 1) await press('ArrowDown');
        await press('Tab');
      }
      await press('Enter');
    },
    first: () => press('Space', 'Enter'),
    bones: async () => {
      const names = questions[4]?.options.map(({ text }) => text) ?? [];
      // Each option is moved to its place with its button, the first one first.
      for (const [place, text] of names.entries()) {
        for (let i = 0; i < 5; i += 1) {
          const shown = await form.locator('li span').allTextContents();
          if (shown[place]?.trim() === text) break;
          await form.getByRole('button', { name: `Move up: ${text}` }).focus();
          await press('Enter');
        }
      }
      await form.getByRole('button', { name: 'Answer' }).focus();
      await press('Enter');
    },
    change: async () => {
      await page.keyboard.type('In the end he waves.');
      await press('Tab', 'Enter');
    },
  };
  // The system opens the page through a link, which counts as activation.
  await page.frameLocator('iframe').getByRole('heading').first().click();
  for (const { name, atSecs } of questions) {
    await player.evaluate((p: RaconteurPlayer, secs) => {
      p.currentTime = secs;
    }, atSecs - 0.1);
    await player.focus();
    await player.evaluate((p: RaconteurPlayer) => void p.play().catch(() => undefined));
    await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.question?.name)).toBe(name);
    await expect(form.locator('input, select, textarea, button').first()).toBeFocused();
    expect(await form.ariaSnapshot()).toMatch(/group ".+"/);
    await answers[name]?.();
    await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.question?.name)).not.toBe(name);
    await player.evaluate((p: RaconteurPlayer) => {
      p.pause();
    });
  }
  expect(await player.evaluate((p: RaconteurPlayer) => p.score)).toEqual({ points: 15, most: 15 });
  await expect.poll(() => kept(page, ['success_status'])).toBe('passed');
  expect(await kept(page, ['completion_status'])).toBe('completed');
  const told = Object.values((await kept(page, ['interactions'])) as { [n: string]: { id: string; type: string; result: string } });
  expect(told.map(({ id, type, result }) => [id, type, result])).toEqual([
    ['opening', 'choice', 'correct'],
    ['pause', 'fill-in', 'correct'],
    ['hands', 'matching', 'correct'],
    ['first', 'choice', 'correct'],
    ['bones', 'sequencing', 'correct'],
    ['change', 'long-fill-in', 'correct'],
  ]);
  await expectNoBarriers(page, 'the course in a system');
});

for (const language of ['pt', 'de']) {
  test(`the course in ${language} is packed without a recording`, () => {
    const files = Object.keys(exported('html', join(COURSE, language)));
    expect(files).toContain('index.html');
    expect(files.filter((path) => path.endsWith('.opus') && path.includes('voice/'))).toEqual([]);
  });
}
