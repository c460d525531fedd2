/** The workshop for gestures: dragging, sliders, typing and undo. */

import type { Locator, Page } from '@playwright/test';
import { curvesOf } from '../../web/element/face/course.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { expect, moved, poseOf, ready, test } from './stage.js';

/** Returns the text as stored by the page. */
const text = (page: Page) => page.evaluate(() => sessionStorage.getItem('raconteur.gestures') ?? '');

async function open(page: Page, width = 1440, height = 900): Promise<void> {
  await page.setViewportSize({ width, height });
  await page.goto('/gestures/');
  const player = page.locator('raconteur-player');
  await ready(player);
  await expect(page.getByRole('button', { name: 'Play', exact: true })).toBeEnabled();
}

const step = (page: Page, name: string) => page.getByRole('tab', { name, exact: true }).click();
const phase = (page: Page, name: string) =>
  page
    .locator('.phase')
    .getByRole('button', { name: new RegExp(`^${name}`) })
    .first();

/** Presses in the middle of an element and drags it. */
async function drag(page: Page, what: Locator, right: number, down: number): Promise<{ x: number; y: number }> {
  const box = await what.boundingBox();
  if (box === null) throw new Error('not to be seen');
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 5 });
  await page.mouse.up();
  return { x: x + right, y: y + down };
}

/** Returns the target of the right arm, world, metres. */
async function target(page: Page): Promise<number[]> {
  const targets = (await poseOf(page.locator('raconteur-player')))?.targets ?? [];
  return [...(targets.find(({ name }) => name === 'rightArm')?.position ?? [])];
}

/** Types a whole text, replacing the existing one. */
async function type(page: Page, eml: string): Promise<void> {
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(eml);
}

test('the ball is rolled, the text says so, and one undo takes all of it back', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await step(page, 'Palm');
  const before = await text(page);
  const ball = page.locator('.ball');
  await expect(ball).toHaveAccessibleName(/Palm to the front, fingers up/);
  // A quarter turn, towards the speaker's left.
  const box = await ball.boundingBox();
  await drag(page, ball, (box?.width ?? 0) * 0.4 * (Math.PI / 2), 0);
  await expect(ball).toHaveAccessibleName(/Palm to the speaker’s left/);
  const rolled = await text(page);
  expect(rolled).toMatch(/<key a="-?\d+(\.\d)?" x="(1|0\.99\d*)"/);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect.poll(() => text(page)).toBe(before);
  await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  await page.getByRole('button', { name: 'Redo' }).click();
  await expect.poll(() => text(page)).toBe(rolled);
  await ball.focus();
  await page.keyboard.press('PageUp');
  expect(await text(page)).not.toBe(rolled);
});

test('a hand is dragged in the picture, and follows the pointer', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await step(page, 'Place');
  const grip = page.locator('.overlay .handle.chosen');
  const from = await target(page);
  const to = await drag(page, grip, 24, 60);
  const box = await grip.boundingBox();
  expect(Math.hypot((box?.x ?? 0) + (box?.width ?? 0) / 2 - to.x, (box?.y ?? 0) + (box?.height ?? 0) / 2 - to.y)).toBeLessThan(4);
  // The right of the image is the speaker's left, downwards is down.
  await expect.poll(async () => ((await target(page))[0] ?? 0) - (from[0] ?? 0)).toBeGreaterThan(0.03);
  await expect.poll(async () => (from[1] ?? 0) - ((await target(page))[1] ?? 0)).toBeGreaterThan(0.1);
  const now = await target(page);
  // The same by the keys: a unit is a 77th of the figure.
  await grip.focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await expect.poll(async () => ((await target(page))[0] ?? 0) - (now[0] ?? 0)).toBeCloseTo((2 / 77) * 1.66, 2);
});

test('a slider and its number set a place, and the text follows', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await step(page, 'Place');
  const slider = page.getByRole('slider', { name: 'Up', exact: true });
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await expect.poll(() => text(page)).toContain('<key x="-16" y="34.1" z="-8"/>');
  await page.getByRole('spinbutton', { name: 'Up, exactly' }).fill('30.5');
  await expect.poll(() => text(page)).toContain('<key x="-16" y="30.5" z="-8"/>');
  await expect(slider).toHaveValue('30.5');
  await page.keyboard.press('Control+z');
  await expect(slider).not.toHaveValue('30.5');
});

test('typed EML moves the controls, and controls keep what they do not understand', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const mine = `<eml xmlns:r="urn:raconteur:eml:1">
  <!-- my own remark -->
  <body>
    <gesture-is-on time="0" isOn="true"/>
    <gesture-key time="1" duration="2" handedness="right">
      <hand-shapes><key time="0.5s" id="19" r:id2="14" r:weight="0.25"/></hand-shapes>
      <motion><key time="50%" x="-12" y="20" z="-10"/></motion>
    </gesture-key>
    <null time="4" timeId="later"/>
  </body>
</eml>`;
  await type(page, mine);
  await step(page, 'Hand shape');
  await expect(page.getByRole('button', { name: 'Shape 19 pointing index', exact: true })).toBeVisible();
  await expect(page.getByRole('button', { name: 'Blended with 14 fist', exact: true })).toBeVisible();
  await expect(page.getByRole('slider', { name: 'Share of the second' })).toHaveValue('0.25');
  await page.getByRole('slider', { name: 'Share of the second' }).fill('0.5');
  await expect.poll(() => text(page)).toBe(mine.replace('0.25', '0.5'));
  await step(page, 'Place');
  await page.getByRole('spinbutton', { name: 'To the left, exactly' }).fill('-14');
  await expect.poll(() => text(page)).toBe(mine.replace('0.25', '0.5').replace('x="-12"', 'x="-14"'));
  await page.reload();
  await expect(page.getByRole('button', { name: 'Play', exact: true })).toBeEnabled({ timeout: 60_000 });
  await step(page, 'Place');
  await expect(page.getByRole('spinbutton', { name: 'To the left, exactly' })).toHaveValue('-14');
});

test('what is wrong with the text is said at its place, and the rest is performed', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await type(page, '<eml><body>\n<gesture-key time="1" duration="1" handedness="right">\n<hand-shapes><key id="99"/><key id="7"/></hand-shapes></gesture-key>\n</body></eml>');
  await expect(page.locator('#problems')).toContainText('1 error');
  await expect(page.locator('#problems')).toContainText('hand shape 99');
  await expect(page.locator('.cm-lintRange-error')).toHaveText('99');
  await page.getByRole('button', { name: 'Line 3' }).click();
  await expect(page.locator('.cm-content')).toBeFocused();
  await type(page, 'no gesture at all');
  await expect(page.locator('.panel')).toContainText('no gesture');
  await page.keyboard.press('Control+z');
  await expect(page.getByRole('button', { name: 'Shape 99 unknown shape', exact: true })).toBeVisible();
});

test('a shape is picked from all 61 pictures, by pointer and by keys', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  const shapes = page.getByRole('group', { name: 'Shape of the hand' });
  await expect(shapes.getByRole('radio')).toHaveCount(61);
  await shapes.locator('label', { has: page.getByRole('radio', { name: '32 L hand', exact: true }) }).click();
  await expect.poll(() => text(page)).toContain('<key id="32"/>');
  await page.keyboard.press('ArrowRight');
  await expect.poll(() => text(page)).toContain('<key id="33"/>');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await expect.poll(() => text(page)).toContain('<key id="4"/>');
  // The images are available: the sheet of 8 by 8.
  const sheet = await page.evaluate(async () => {
    const picture = document.querySelector('.shapes .picture');
    const url = /url\("(.*)"\)/.exec(picture === null ? '' : getComputedStyle(picture).backgroundImage)?.[1] ?? '';
    const image = new Image();
    image.src = url;
    await image.decode();
    return [image.naturalWidth / image.naturalHeight, image.naturalWidth];
  });
  expect(sheet[0]).toBe(1);
  expect(sheet[1]).toBeGreaterThan(800);
});

test('phases are drawn out, added and taken away on the timeline', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await phase(page, 'Stroke').click();
  const length = page.getByRole('slider', { name: 'Length of Stroke' });
  await drag(page, length, 60, 0);
  const longer = Number(await length.getAttribute('aria-valuenow'));
  expect(longer).toBeGreaterThan(1.3);
  await length.focus();
  await page.keyboard.press('ArrowLeft');
  await expect(length).toHaveAttribute('aria-valuenow', String(Math.round((longer - 0.05) * 100) / 100));
  await step(page, 'Phase');
  await page.getByRole('group', { name: 'After it, add a' }).getByRole('button', { name: 'Pre-stroke hold' }).click();
  await expect(phase(page, 'Pre-stroke hold')).toHaveAttribute('aria-pressed', 'true');
  await page.getByRole('button', { name: 'Remove this phase' }).click();
  await expect(phase(page, 'Pre-stroke hold')).toHaveCount(0);
  await phase(page, 'Stroke').click();
  await step(page, 'Place');
  const keys = page.locator('.lane.keys').nth(2).getByRole('button');
  const count = await keys.count();
  const second = keys.nth(2);
  await drag(page, second, 20, 0);
  await expect.poll(() => text(page)).not.toContain('<key time="33%" x="-12"');
  await page.getByRole('button', { name: 'Remove this key' }).click();
  await expect(keys).toHaveCount(count - 1);
  await page.getByText('Both, mirrored').isHidden();
  await step(page, 'Phase');
  await page.getByText('Both, mirrored').click();
  await expect.poll(() => text(page)).toMatch(/handedness="both"/);
});

test('a course is drawn by its handles', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await phase(page, 'Stroke').click();
  await step(page, 'Place');
  await step(page, 'Course');
  await page.getByText('Bézier', { exact: true }).click();
  await expect.poll(() => text(page)).toContain('r:interpolation="bezier" r:controls="0.4 0 0.2 1"');
  const handle = page.getByRole('button', { name: /Second control point/ });
  await handle.scrollIntoViewIfNeeded();
  await drag(page, handle, 30, -14);
  const [, x = '', y = ''] = /r:controls="0\.4 0 ([\d.]+) ([\d.]+)"/.exec(await text(page)) ?? [];
  expect(Number(x)).toBeGreaterThan(0.22);
  expect(Number(y)).toBeGreaterThan(1.02);
  await page.getByText('Every key of the phase').click();
  await page.getByText('Hermite', { exact: true }).click();
  await expect.poll(() => text(page)).toContain('<motion r:interpolation="hermite" r:controls="0 0">');
  await page.getByRole('spinbutton', { name: 'Slope at the end, exactly' }).fill('1.5');
  await expect.poll(() => text(page)).toContain('r:controls="0 1.5"');
});

test('a gesture is built with the keyboard alone', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await page.keyboard.press('Tab');
  await expect(page.getByRole('link', { name: 'Skip to the steps' })).toBeFocused();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await expect(page.getByRole('tab', { name: 'Hand shape' })).toBeFocused();
  await page.keyboard.press('ArrowRight');
  await expect(page.getByRole('tab', { name: 'Palm' })).toHaveAttribute('aria-selected', 'true');
  const focused = () => page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent?.trim() ?? '');
  const tabTo = async (name: RegExp): Promise<void> => {
    for (let i = 0; i < 40; i += 1) {
      await page.keyboard.press('Tab');
      if (name.test(await focused())) return;
    }
    throw new Error(`Tab does not come to ${String(name)}, but to ${await focused()}`);
  };
  await tabTo(/^Palm to/);
  await page.keyboard.press('ArrowUp');
  await expect.poll(() => text(page)).toMatch(/<key a="[-\d.]+" x="0" y="0\.087" z="-0\.996"\/>/);
  await tabTo(/^Turn about the normal$/);
  await page.keyboard.press('ArrowRight');
  await tabTo(/^Add a key/);
  await page.keyboard.press('Enter');
  expect((await text(page)).match(/<palms>[\s\S]*?<\/palms>/)?.[0].match(/<key/g)).toHaveLength(2);
  // Out of the editor, too: Tab leaves it.
  const inside = () => page.evaluate(() => document.activeElement?.shadowRoot?.activeElement?.getAttribute('aria-label'));
  await expect(async () => {
    await page.keyboard.press('Tab');
    expect(await inside()).toBe('EML of the gesture');
  }).toPass({ intervals: [0] });
  await page.keyboard.press('Tab');
  expect(await inside()).toBeUndefined();
  await page.keyboard.press('Control+z');
  expect((await text(page)).match(/<palms>[\s\S]*?<\/palms>/)?.[0].match(/<key/g)).toHaveLength(1);
});

test('it plays in a loop, and the text can be taken away', async ({ stage, page, context }) => {
  expect(stage.backend).toBe('page');
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await open(page);
  const player = page.locator('raconteur-player');
  await page.getByRole('slider', { name: 'Time on stage' }).fill('3.4');
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await expect.poll(() => page.evaluate(() => window.record.events.filter((e) => e.type === 'seeked').map((e) => e.at)), { timeout: 60_000 }).toContain(0);
  expect(await player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(false);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Copy EML' }).click();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(await text(page));
  const saved = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Download' }).click();
  expect((await saved).suggestedFilename()).toBe('wave.eml');
  await page.getByLabel('Begin with').selectOption('Point');
  await expect.poll(() => text(page)).toContain('name="point"');
  await page.keyboard.press('Control+z');
  await expect.poll(() => text(page)).toContain('name="wave"');
});

test('an element that is ended by hand has one end', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page);
  await type(page, '');
  await page.keyboard.type('<eml><body></body></eml>');
  await expect.poll(() => text(page)).toBe('<eml><body></body></eml>');
});

test('each line of the text has its number beside it, and the first is whole, at each width', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await open(page, 390, 844);
  // Also while it is out of sight, where heights are not measured.
  const drift = (): Promise<string[]> =>
    page.locator('.cm-content').evaluate((content) => {
      const lines = [...content.querySelectorAll('.cm-line')];
      return lines.flatMap((line, i) => (getComputedStyle(line, '::before').content.startsWith(`"${i + 1}"`) ? [] : [`${i + 1}: ${getComputedStyle(line, '::before').content}`]));
    });
  const first = async (): Promise<number> => {
    const [line, box] = [await page.locator('.cm-line').first().boundingBox(), await page.locator('#editor').boundingBox()];
    return (line?.y ?? NaN) - (box?.y ?? NaN);
  };
  for (const [width, height] of [
    [390, 844],
    [1024, 768],
    [1440, 900],
  ] as const) {
    await page.setViewportSize({ width, height });
    await page.evaluate(() => scrollTo(0, 0));
    expect(await drift(), `${width}`).toEqual([]);
    await page.locator('#editor').scrollIntoViewIfNeeded();
    await expect.poll(first).toBeGreaterThanOrEqual(0);
    expect(await drift(), `${width}`).toEqual([]);
    // A line more, and all below it have other numbers.
    await page.locator('.cm-content').press('ControlOrMeta+Home');
    await page.locator('.cm-content').press('Enter');
    await expect.poll(drift).toEqual([]);
  }
});

test('a hand that gestures is in the picture from every side at each width', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page);
  const player = page.locator('raconteur-player');
  const sides = page.getByLabel('Seen', { exact: true });
  for (const figure of ['papous', 'kenji', 'sofia']) {
    await page.locator('#tools').getByLabel('On stage').selectOption(figure);
    await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentFigure), { timeout: 60_000 }).toBe(figure);
    for (const [width, height] of [
      [390, 844],
      [1024, 1366],
      [1920, 1080],
    ] as const) {
      await moved(player, () => page.setViewportSize({ width, height }));
      const shown = await sides.evaluate((select: HTMLSelectElement) => select.selectedOptions[0]?.text ?? '');
      // The current side comes last, because choosing it again would render nothing.
      const names = await sides.locator('option').allTextContents();
      for (const side of [...names.filter((name) => name !== shown), shown]) {
        await moved(player, () => sides.selectOption(side));
        const pose = await poseOf(player);
        const box = await player.boundingBox();
        if (pose === undefined || box === null) throw new Error('nobody is on stage');
        const hand = pose.joints.filter(({ name }) => /^bone_r_(wrist|thumb|index|middle|ring|pinky)/.test(name));
        expect(hand.length).toBeGreaterThan(10);
        const rooms = hand.map(({ position }) => {
          const { x, y } = pose.camera.project(position, box.width, box.height) ?? { x: NaN, y: NaN };
          return Math.min(x, box.width - x, y, box.height - y);
        });
        // A fingertip is further than its joint.
        expect(Math.min(...rooms) / Math.min(box.width, box.height), `${figure}, ${side}, ${width}`).toBeGreaterThan(0.06);
      }
    }
  }
});

test('the eyes are open while the editor shows its pose', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page);
  const player = page.locator('raconteur-player');
  const lid = async (): Promise<number> => {
    const told = await player.evaluate((p: RaconteurPlayer) => [...(p.course(p.currentTime, p.currentTime, 1)?.curves ?? [])]);
    const { upperLidLeft, upperLidRight } = curvesOf({ curves: Float32Array.from(told) }, 1).direct;
    return Math.max(upperLidLeft[0] ?? NaN, upperLidRight[0] ?? NaN);
  };
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBeGreaterThan(0);
  expect(await lid()).toBeLessThan(0.3);
  // Also at every key and phase that is looked at after that.
  for (const tab of ['Phase', 'Hand shape', 'Palm', 'Place', 'Course']) {
    await step(page, tab);
    for (const button of await page.locator('.lane.keys').getByRole('button').all()) {
      await button.click({ force: true });
      expect(await lid(), `${tab}, ${(await button.getAttribute('aria-label')) ?? ''}`).toBeLessThan(0.3);
    }
  }
});

test('the workshop is accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  // Ten analyses of the whole page.
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await open(page);
  for (const look of LOOKS) {
    await lookAt(page, look);
    for (const tab of partsIn(look, ['Phase', 'Hand shape', 'Palm', 'Place', 'Course'])) {
      await step(page, tab);
      await expectNoBarriers(page, `${tab}, ${look.device}`);
    }
    // The stage stays in sight while the steps are used.
    const box = await page.locator('raconteur-player').boundingBox();
    expect(box?.y).toBeGreaterThanOrEqual(0);
    expect(box?.y).toBeLessThan(look.height / 2);
  }
});
