/** Tests of emotions expressed by camera, light and music: the applied rules, the image, and two settings side by side. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { expect, poseOf, ready, test } from './stage.js';

/** Story time of a static image, seconds. */
const SHOWN_SECS = 12;

async function open(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.goto('/expression/');
  await ready(page.locator('#a'));
}

const eml = (page: Page): Promise<string> => page.locator('#eml').evaluate((code) => code.textContent ?? '');
/** Selects an option by its label, without waiting for an image rendered in software. */
const choose = (page: Page, name: string, role: 'radio' | 'checkbox' | 'button' | 'tab' = 'radio'): Promise<void> =>
  page.getByRole(role, { name, exact: true }).evaluate((b: HTMLElement) => b.click());
const strength = (page: Page, value: number): Promise<void> => page.getByRole('slider', { name: 'Potential' }).fill(String(value));

/** Waits until the player shows a text at its settled time. */
async function settled(page: Page, id: string, holds: string): Promise<void> {
  await expect.poll(() => page.locator(id).evaluate((p: RaconteurPlayer) => (p.readyState === 4 ? `${p.currentTime} ${p.textContent}` : ''))).toContain(holds);
  await expect.poll(() => page.locator(id).evaluate((p: RaconteurPlayer) => p.currentTime)).toBe(SHOWN_SECS);
  await expect(page.locator('.still')).toHaveCount(0);
}

const ANGER = 'type="anger" potential="3.5"';

async function anger(page: Page): Promise<void> {
  await choose(page, 'anger');
  await strength(page, 3.5);
  await settled(page, '#a', ANGER);
}

test('anger comes near from below in red, and each channel can be turned off', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const player = page.locator('#a');
  const rules = page.locator('.rules');
  const height = async (): Promise<number> => {
    const pose = await poseOf(player);
    return pose === undefined ? 0 : pose.camera.eye[1] - pose.camera.target[1];
  };
  await anger(page);
  await expect(rules).toContainText('Anger → low angle 3.5.4.1, rule 1');
  await expect(rules).toContainText('Potential 3.5 in [2.5; 4.5) → close-up 3.5.4.1, rule 5');
  await expect(rules).toContainText('Anger → red key light table 3.2');
  await expect(rules).toContainText('= 0.35');
  await expect(rules).toContainText('→ negative-calm');
  expect(await eml(page)).toContain(ANGER);
  expect(await height()).toBeLessThan(-0.2);
  await expect(page.locator('#problems')).toBeEmpty();

  const lit = (await stage.picture(player)).png;
  await choose(page, 'Light', 'checkbox');
  await settled(page, '#a', 'light="false"');
  await expect(rules).toContainText('Off: the light of the set');
  expect(await stage.difference(lit, (await stage.picture(player)).png)).toBeGreaterThan(4);

  await choose(page, 'Camera', 'checkbox');
  await settled(page, '#a', 'camera="false"');
  expect(Math.abs(await height())).toBeLessThan(0.1);
  await choose(page, 'Night');
  await expect.poll(() => eml(page)).toContain('set="night"');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await expect.poll(() => eml(page)).toContain('camera="true" light="true" music="true" set="curtain"');
  await choose(page, 'neutral');
  await expect(rules).toContainText('No emotion: no rule applies');
});

test('two settings stand side by side and play as one', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await anger(page);
  await expect(page.locator('#b')).toBeHidden();
  await choose(page, 'Compare', 'button');
  await settled(page, '#b', 'camera="false" light="false" music="false"');
  await expect(page.locator('raconteur-player:visible')).toHaveCount(2);
  await expect(page.locator('.rules ul')).toHaveCount(2);
  const boxes = await Promise.all(['#a', '#b'].map((id) => page.locator(id).boundingBox()));
  expect(boxes[1]!.x).toBeGreaterThan(boxes[0]!.x + boxes[0]!.width);
  // The controls change the second one, until the first is chosen again.
  await choose(page, 'hope');
  await expect.poll(() => eml(page)).toContain('type="hope"');
  await settled(page, '#b', 'type="hope"');
  await settled(page, '#a', ANGER);
  await choose(page, 'A');
  await expect.poll(() => eml(page)).toContain(ANGER);

  await choose(page, 'Play', 'button');
  const times = (): Promise<number[]> => page.locator('raconteur-player').evaluateAll((all) => (all as RaconteurPlayer[]).map((p) => p.currentTime));
  await expect.poll(async () => Math.min(...(await times()))).toBeGreaterThan(SHOWN_SECS + 0.5);
  expect(await page.locator('raconteur-player').evaluateAll((all) => (all as RaconteurPlayer[]).map((p) => p.muted))).toEqual([false, true]);
  await expect.poll(() => page.evaluate(() => window.record.starts.length)).toBeGreaterThan(0);
  // A change during playback does not stop it, nor the other player.
  await strength(page, 1);
  await expect.poll(() => page.locator('#a').evaluate((p: RaconteurPlayer) => p.readyState === 4 && p.textContent)).toContain('potential="1"');
  await expect.poll(() => page.locator('raconteur-player').evaluateAll((all) => all.map((p) => (p as RaconteurPlayer).paused))).toEqual([false, false]);
  await expect.poll(async () => (await times()).reduce((first, second) => (first > SHOWN_SECS ? Math.abs(first - second) : Infinity))).toBeLessThan(0.6);
  await choose(page, 'Pause', 'button');
  await expect.poll(() => page.locator('#b').evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
  await choose(page, 'Compare', 'button');
  await expect(page.locator('#b')).toBeHidden();

  // At its end it returns to the time at which all emotions are visible.
  await page.locator('#a').evaluate((p: RaconteurPlayer) => void (p.currentTime = p.duration - 0.5));
  await choose(page, 'Play', 'button');
  await expect.poll(() => page.locator('#a').evaluate((p: RaconteurPlayer) => [p.paused, p.currentTime])).toEqual([true, SHOWN_SECS]);
});

test('the disc is dragged and walked by keys: direction is the type, distance its potential', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await choose(page, 'Disc', 'tab');
  const disc = page.getByRole('button', { name: /^Emotion:/ });
  const box = await disc.boundingBox();
  if (box === null) throw new Error('no disc');
  const middle = [box.x + box.width / 2, box.y + box.height / 2] as const;
  // Love is 30° below the horizontal of the positive side; the rim is 88 of 170 to the side.
  const rim = (box.width / 2) * (88 / 170);
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 0.2 * rim, middle[1]);
  await page.mouse.move(middle[0] + 0.6 * rim * Math.cos(Math.PI / 6), middle[1] + 0.6 * rim * Math.sin(Math.PI / 6));
  await page.mouse.up();
  await expect(disc).toHaveAttribute('aria-label', /^Emotion: love, potential (5\.9|6\.0|6\.1), extreme close-up/);
  await settled(page, '#a', 'type="love"');
  await disc.focus();
  await page.keyboard.press('ArrowDown');
  await expect(disc).toHaveAttribute('aria-label', /^Emotion: satisfaction/);
  await page.keyboard.press('Home');
  await expect(disc).toHaveAttribute('aria-label', /^Emotion: neutral/);
  await page.keyboard.press('Shift+ArrowLeft');
  await expect(disc).toHaveAttribute('aria-label', /^Emotion: \w+, potential 0\.5, full shot/);
  await page.keyboard.press('Control+z');
  await expect.poll(() => eml(page)).not.toContain('r:emotion');
});

test('expression is accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await choose(page, 'Compare', 'button');
  await ready(page.locator('#b'));
  for (const look of LOOKS) {
    await lookAt(page, look);
    for (const tab of partsIn(look, ['Disc', 'Types'])) {
      await choose(page, tab, 'tab');
      await expectNoBarriers(page, `${tab}, ${look.device}`);
    }
    const [a, b] = await Promise.all(['#a', '#b'].map((id) => page.locator(id).boundingBox()));
    if (look.device === 'phone') expect(b!.y).toBeGreaterThanOrEqual(a!.y + a!.height);
    else expect(b!.x).toBeGreaterThan(a!.x);
  }
});
