/** Tests of question forms: focus, announcements, and accessibility of pointer targets. */

import type { Locator } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const TWO = `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`;
const HANDS = `<r:option name='left' text='The left hand' at='l_wrist' right='true'/><r:option name='right' text='The right hand' at='r_wrist'/>
  <r:option name='elbow' text='The left elbow' at='l_elbow'/><r:option name='head' text='The head' at='skull'/><r:option name='foot' text='The left foot' at='l_subtalar'/>`;

const asks = (questions: string) => `<seq time='0'><null time='0.5'/>${questions}<null time='20'/></seq>`;

async function open(stage: Stage, body: string, css?: string): Promise<Locator> {
  await stage.open('<main><h1>A page</h1><raconteur-player src="story.eml" quality="lowest" loading="eager" label="Songs" controls></raconteur-player></main>', {
    'story.eml': story(body),
    ...(css === undefined ? {} : { 'test.css': css }),
  });
  await stage.ready();
  return stage.player.locator('form[part~=question]');
}

/** Returns the focused element in the player: the value or the name of a control, or the player itself. */
const focused = (stage: Stage) =>
  stage.player.evaluate((p: RaconteurPlayer) => {
    if (document.activeElement !== p) return 'elsewhere';
    const inner = p.shadowRoot?.activeElement;
    // The player's frame takes the focus.
    if (inner === null || inner === undefined || inner.classList.contains('frame')) return 'player';
    return inner instanceof HTMLInputElement ? inner.value : (inner.textContent ?? '').trim();
  });

test('who begins a story by keys answers by keys, and goes on with them', async ({ stage, page }) => {
  const form = await open(
    stage,
    asks(`<r:ask time='0' name='one' prompt='One?'>${TWO}</r:ask><null time='0.5'/><r:ask time='0' name='two' type='point' prompt='Two?'>${HANDS}</r:ask>`),
  );
  await stage.player.locator('[part~=big-play]').focus();
  await page.keyboard.press('Enter');
  await expect(form).toBeVisible();
  await expect.poll(() => focused(stage)).toBe('a');
  await page.keyboard.press('Space');
  await page.keyboard.press('Enter');
  await expect(form.locator('legend')).toHaveText('Two?');
  await expect.poll(() => focused(stage)).toBe('left');
  // One Tab press leads from the options to the next control.
  await page.keyboard.press('Tab');
  expect(await focused(stage)).toBe('Answer');
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Space');
  await page.keyboard.press('Tab');
  expect(await focused(stage)).toBe('Answer');
  await page.keyboard.press('Enter');
  await expect(form).toHaveCount(0);
  await expect.poll(() => focused(stage)).toBe('player');
  // A key closes the feedback, and the focus is not lost.
  await stage.player.getByRole('button', { name: 'Close' }).focus();
  await page.keyboard.press('Enter');
  await expect.poll(() => focused(stage)).toBe('player');
});

test('nothing is missing before somebody answers, and then it is said in the words of the story', async ({ stage, page }) => {
  const gap = `<r:ask time='0' name='gap' type='gap' prompt='The [x] and the [y].'><r:option name='x' accepts='frog'/><r:option name='y' accepts='owl'/></r:ask>`;
  const form = await open(stage, asks(`<r:ask time='0' name='one' prompt='One?'>${TWO}</r:ask>${gap}`));
  await stage.play();
  const status = form.locator('.said[role=status]');
  await expect(form).toBeVisible();
  await expect(status).toHaveText('');
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(status).toHaveText('There is no answer yet.');
  // The browser shows no validation messages in its own language.
  expect(await form.evaluate((it: HTMLFormElement) => it.noValidate)).toBe(true);
  await form.getByLabel('A', { exact: true }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.locator('legend')).toHaveText('The … and the ….');
  await expect(status).toHaveText('');
  // A gap that is left is no answer.
  await form.getByLabel('Gap 1 of 2').fill('frog');
  await page.keyboard.press('Enter');
  await expect(status).toHaveText('There is no answer yet.');
  await expect(form.getByLabel('Gap 2 of 2')).toBeFocused();
});

test('on a phone every mark can be pressed', async ({ stage, page }) => {
  await page.setViewportSize({ width: 360, height: 640 });
  const form = await open(
    stage,
    asks(`<r:ask time='0' name='q' type='point' prompt='Which one is it that waves to everybody?'>${HANDS}</r:ask>`),
    'body { margin: 0 } h1 { display: none }',
  );
  await stage.play();
  await expect(form).toBeVisible();
  await expect(stage.player.locator('.marker')).toHaveCount(5);
  await page.waitForTimeout(800);
  const found = await stage.player.evaluate((p: RaconteurPlayer) => {
    p.scrollIntoView();
    const picture = p.getBoundingClientRect();
    return [...(p.shadowRoot?.querySelectorAll('.marker') ?? [])].map((marker) => {
      const { left, top, right, bottom, width } = marker.getBoundingClientRect();
      const hit = p.shadowRoot?.elementFromPoint((left + right) / 2, (top + bottom) / 2);
      return { isHit: hit === marker, isInside: left >= picture.left && top >= picture.top && right <= picture.right && bottom <= picture.bottom, isShown: width > 20 };
    });
  });
  expect(found).toEqual(Array.from({ length: 5 }, () => ({ isHit: true, isInside: true, isShown: true })));
});
