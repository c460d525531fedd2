/** Tests of a story's questions: pauses, reactions to an answer, and the use of the form. */

import { AxeBuilder } from '@axe-core/playwright';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const ASKED = `<seq time='0'><null time='1'/>
  <r:ask time='0' name='who' prompt='Who sang?' tries='2' points='3' hint='It is green.'>
    <r:option name='frog' text='A frog' right='true'/><r:option name='stone' text='A stone &amp; more'/>
    <r:answer to='right'><event time='0.2' type='yes'/><null time='0.6'/></r:answer>
    <r:answer to='wrong'><event time='0.2' type='no'/><null time='0.6'/></r:answer>
  </r:ask><event time='0' type='after'/><null time='1'/></seq>`;

async function open(stage: Stage, attributes = ''): Promise<void> {
  await stage.open(`<main><h1>A page</h1><raconteur-player src="story.eml" quality="lowest" loading="eager" label="Songs" controls ${attributes}></raconteur-player></main>`, {
    'story.eml': story(ASKED),
  });
  await stage.ready();
}

const told = (stage: Stage) => stage.page.evaluate(() => window.record.events.filter(({ type }) => type === 'storyevent').map(({ detail }) => (detail as { type: string }).type));
const state = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => ({ paused: p.paused, asked: p.question?.name, score: p.score, secs: p.currentTime, ended: p.ended }));

test('the story rests until it is answered, performs the answer that fits, and goes on', async ({ stage, page }) => {
  await open(stage);
  await stage.play();
  const form = stage.player.locator('[part~=question]');
  await expect(form).toBeVisible();
  expect(await state(stage)).toMatchObject({ paused: true, asked: 'who', score: { points: 0, most: 3 } });
  expect((await state(stage)).secs).toBeCloseTo(1, 2);
  // The story does not continue, neither automatically nor on pressing play.
  await stage.player.evaluate((p: RaconteurPlayer) => p.play().catch(() => undefined));
  await page.waitForTimeout(600);
  expect(await state(stage)).toMatchObject({ paused: true, asked: 'who' });
  await form.getByLabel('A stone & more').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.getByRole('status')).toHaveText('Not yet. It is green. One try is left.');
  await form.getByLabel('A frog').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form).toHaveCount(0);
  await expect.poll(async () => (await state(stage)).ended, { timeout: 60_000 }).toBe(true);
  expect(await told(stage)).toEqual(['yes', 'after']);
  expect((await state(stage)).score).toEqual({ points: 3, most: 3 });
});

test('with the keyboard alone, and with no barriers', async ({ stage, page }) => {
  await open(stage);
  await stage.play();
  const form = stage.player.locator('[part~=question]');
  await expect(form).toBeVisible();
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ')).join('; ')}`)).toEqual([]);
  expect(await form.ariaSnapshot()).toContain('group "Who sang?"');
  await form.getByLabel('A frog').focus();
  await page.keyboard.press('ArrowDown');
  await expect(form.getByLabel('A stone & more')).toBeChecked();
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  await expect(form).toHaveCount(0);
  await expect.poll(() => told(stage), { timeout: 60_000 }).toEqual(['yes', 'after']);
});

test('nothing is sought past a question, and what was answered comes back', async ({ stage }) => {
  await open(stage);
  await stage.seek(3);
  await expect.poll(async () => (await state(stage)).asked).toBe('who');
  expect((await state(stage)).secs).toBeCloseTo(1, 2);
  await stage.player.evaluate((p: RaconteurPlayer) => p.answer('frog'));
  const kept = await stage.player.evaluate((p: RaconteurPlayer) => JSON.stringify(p.state()));
  await open(stage);
  await stage.player.evaluate((p: RaconteurPlayer, text) => p.restore(JSON.parse(text) as ReturnType<RaconteurPlayer['state']>), kept);
  expect((await state(stage)).score).toEqual({ points: 3, most: 3 });
  await stage.seek(0);
  await stage.play();
  await expect.poll(() => told(stage), { timeout: 60_000 }).toEqual(['after']);
});

test('320 pixels have room for a question', async ({ stage, page }) => {
  await page.setViewportSize({ width: 320, height: 480 });
  await open(stage);
  await stage.play();
  const form = stage.player.locator('[part~=question]');
  await expect(form).toBeVisible();
  const box = await form.boundingBox();
  expect(box?.x).toBeGreaterThanOrEqual(0);
  expect((box?.x ?? 0) + (box?.width ?? 0)).toBeLessThanOrEqual(320);
  expect((box?.height ?? 0) > 100).toBe(true);
});
