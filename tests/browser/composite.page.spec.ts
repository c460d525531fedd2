/** Tests of the composite editor: features, parts, faces of the database, constraints, history, session, speech. */

import type { Locator, Page } from '@playwright/test';
import type { CompositeEventMap, RaconteurComposite } from '../../web/composite/element.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers, lookAt, LOOKS, partsIn } from './access.js';
import { open, Visit } from './composite.js';
import { expect, test, type Stage } from './stage.js';

const ready = (page: Page): Promise<void> => page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.ready);

const value = (page: Page | Locator, name: string) => page.getByLabel(`${name}, exactly`);

/** Sets a feature by its number. */
async function set(page: Page | Locator, name: string, to: string): Promise<void> {
  await value(page, name).fill(to);
  await value(page, name).blur();
}

async function group(page: Page, name: string): Promise<void> {
  await page.getByLabel('Group').selectOption(name);
}

test('what the browser kept is there again, and a hostile file loses nothing', async ({ page }) => {
  await open(page);
  await set(page, 'weight', '0.5');
  await page.getByRole('tab', { name: 'History' }).click();
  const present = page.locator('.steps-list [aria-current="step"]');
  await expect(present).toContainText('weight');
  await page.reload();
  await ready(page);
  await page.getByRole('tab', { name: 'Features' }).click();
  await expect(value(page, 'weight')).toHaveValue('0.5');
  await page.locator('.file input').setInputFiles({ name: 'bad.json', mimeType: 'application/json', buffer: Buffer.from('{"format":"raconteur-composite","version":9}') });
  await expect(page.locator('#trouble')).toContainText('newer version');
  await expect(value(page, 'weight')).toHaveValue('0.5');
});

test('the face says a sentence, and nothing leaves the machine', async ({ page, baseURL }) => {
  const elsewhere: string[] = [];
  page.on('request', (request) => {
    const { origin, protocol } = new URL(request.url());
    if (protocol.startsWith('http') && origin !== new URL(baseURL ?? '').origin) elsewhere.push(request.url());
    // Neither of them carries anything.
    if (!['GET', 'HEAD'].includes(request.method())) elsewhere.push(`${request.method()} ${request.url()}`);
  });
  await open(page);
  await set(page, 'weight', '0.5');
  await page.getByLabel('Let this face speak').fill('Hello world. This is a face that speaks for a while, so that it can be stopped before it has come to its end.');
  await page.getByRole('button', { name: 'Speak' }).click();
  const time = () => page.locator('#player').evaluate((p: RaconteurPlayer) => p.currentTime);
  await expect.poll(time, { timeout: 60_000 }).toBeLessThan(1.5);
  await page.getByRole('button', { name: 'Stop' }).click();
  await expect.poll(time).toBe(1.6);
  await expect(value(page, 'weight')).toHaveValue('0.5');
  expect(elsewhere).toEqual([]);
});

type Embedded = ReturnType<typeof embedded>;

/** Opens an editor embedded in a third-party page, and records the events that the page receives. */
const embedded = (page: Page, id: string) => {
  const editor = page.locator(`#${id}`);
  return {
    editor,
    ready: () => editor.evaluate((e: RaconteurComposite) => e.ready),
    /** Begins to write down the events. */
    hear: () =>
      editor.evaluate((e: RaconteurComposite) => {
        for (const type of ['change', 'error'] as const) {
          e.addEventListener(type, (event) => {
            const { detail } = event as CompositeEventMap[typeof type];
            e.dataset[type] = JSON.stringify(detail);
          });
        }
      }),
    changes: () => editor.getAttribute('data-change'),
  };
};

/** Opens two editors on a third-party page with a strict policy. */
async function openTwo(stage: Stage, page: Page): Promise<[Embedded, Embedded]> {
  // A processor renders two stages, with two cores for all tests.
  test.setTimeout(480_000);
  await page.setViewportSize({ width: 1300, height: 900 });
  const body = `<script type="module" src="/raconteur-composite.js"></script><h1>A page</h1><input aria-label="Elsewhere">
    <div id="there"></div>
    <raconteur-composite id="one" assets="/assets/" session="one" label="One" quality="lowest"></raconteur-composite>
    <raconteur-composite id="two" assets="/assets" session="two" label="Two" figure="papous" quality="lowest"></raconteur-composite>`;
  await stage.open(body, { 'test.css': '#two { width: 420px; --accent: rgb(0, 90, 160); } body { margin: 0 }' });
  const [one, two] = [embedded(page, 'one'), embedded(page, 'two')];
  const begun = async ({ ready, hear, editor }: Embedded) => {
    await ready();
    await hear();
    await editor.getByRole('tab', { name: 'Features' }).click();
  };
  await Promise.all([begun(one), begun(two)]);
  return [one, two];
}

test('two editors stand on a strict page of somebody else, each for itself', async ({ stage, page }) => {
  const [one, two] = await openTwo(stage, page);
  expect(await two.editor.evaluate((e: RaconteurComposite) => e.player?.currentFigure)).toBe('papous');

  // A slider moves: one step of one editor.
  const slider = one.editor.getByRole('slider', { name: 'weight' });
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await expect(value(one.editor, 'weight')).toHaveValue('0.01');
  await expect.poll(() => one.changes()).toBe('{"label":"weight +0.01","steps":1}');
  expect(await two.changes()).toBeNull();
  await expect(value(two.editor, 'weight')).toHaveValue('0');

  // Names of radio buttons and identifiers are an editor's own.
  for (const { editor } of [one, two]) await editor.getByRole('tab', { name: 'Parts' }).click();
  await two.editor.locator('.choice').getByText('Right', { exact: true }).click();
  await one.editor.locator('.choice').getByText('Left', { exact: true }).click();
  await expect(one.editor.getByRole('radio', { name: 'Left' })).toBeChecked();
  await expect(two.editor.getByRole('radio', { name: 'Right' })).toBeChecked();

  // Keys act where the focus is, and nowhere else.
  await page.getByLabel('Elsewhere').focus();
  await page.keyboard.press('Control+z');
  await two.editor.getByRole('tab', { name: 'Features' }).focus();
  await page.keyboard.press('Control+z');
  expect(await one.editor.evaluate((e: RaconteurComposite) => e.save()?.here)).toBe(1);
  await one.editor.getByRole('tab', { name: 'Features' }).click();
  await page.keyboard.press('Control+z');
  expect(await one.editor.evaluate((e: RaconteurComposite) => e.save()?.here)).toBe(0);
  await one.editor.evaluate((e: RaconteurComposite) => e.redo());

  // The layout depends on the element's own width, the colours on the page.
  const place = (editor: Locator, name: string) =>
    editor.locator(name).evaluate((e) => e.getBoundingClientRect().left - (e.getRootNode() as ShadowRoot).host.getBoundingClientRect().left);
  expect(await place(one.editor, '.controls')).toBeGreaterThan(500);
  expect(await place(two.editor, '.controls')).toBeLessThan(20);
  await expect(two.editor.getByRole('button', { name: 'Speak' })).toHaveCSS('background-color', 'rgb(0, 90, 160)');
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(1300);

  // Another editor opens the saved state and refuses an invalid one.
  const moved = await one.editor.evaluate(async (e: RaconteurComposite, other) => {
    await document.querySelector<RaconteurComposite>(other)?.open(e.save());
    return await e.open({ format: 'nothing' }).catch((error: Error) => error.message);
  }, '#two');
  expect(moved).toBe('This is not a session of the composite editor.');
  expect(await two.changes()).toBe('{"label":"weight +0.01","steps":1}');
});

test('two editors come back with their work: where they are moved, taken away, and opened anew', async ({ stage, page }) => {
  const [one, two] = await openTwo(stage, page);
  for (const { editor } of [one, two]) {
    await editor.getByRole('slider', { name: 'weight' }).focus();
    await page.keyboard.press('ArrowRight');
    await expect(value(editor, 'weight')).toHaveValue('0.01');
  }

  // A moved element continues; an element that returns after longer restores its face.
  await one.editor.evaluate((e: RaconteurComposite) => document.querySelector('#there')?.append(e));
  await expect(value(one.editor, 'weight')).toHaveValue('0.01');
  await page.evaluate(async () => {
    const away = document.querySelector('#two');
    away?.remove();
    await new Promise((later) => setTimeout(later, 300));
    if (away !== null) document.body.append(away);
  });
  await two.editor.scrollIntoViewIfNeeded();
  await expect.poll(() => two.editor.evaluate((e: RaconteurComposite) => e.player?.currentTime), { timeout: 60_000 }).toBe(1.6);
  expect(await two.editor.evaluate((e: RaconteurComposite) => e.snapshot()?.width)).toBeGreaterThan(100);

  // The browser stores the work of each editor under its own name.
  await one.editor.evaluate((e: RaconteurComposite) => e.undo());
  await page.reload();
  await Promise.all([one.ready(), two.ready()]);
  expect(await one.editor.evaluate((e: RaconteurComposite) => e.save()?.here)).toBe(0);
  expect(await two.editor.evaluate((e: RaconteurComposite) => e.save()?.here)).toBe(1);
});

test('an editor begins with a saved session, and says what it cannot open', async ({ stage, page }) => {
  const body = (src: string) => `<script type="module" src="/raconteur-composite.js"></script><raconteur-composite id="one" src="${src}"></raconteur-composite>`;
  await stage.open(body('missing.json'));
  const one = embedded(page, 'one');
  await one.ready();
  await expect(one.editor.locator('[part="trouble"]')).toContainText('was not found at /test/missing.json');
  const saved = await one.editor.evaluate((e: RaconteurComposite) => {
    const start = e.save();
    const steps = [...(start?.steps ?? []), { parent: 0, act: { kind: 'random', seed: 3 } }];
    return JSON.stringify({ ...start, steps, here: 1 });
  });
  await page.unrouteAll();
  await stage.open(body('mine.json'), { 'mine.json': saved });
  await one.ready();
  await one.editor.getByRole('tab', { name: 'History' }).click();
  await expect(one.editor.locator('[aria-current="step"]')).toContainText('A random face');
  // Nothing is stored unless the page requests it.
  expect(await page.evaluate(async () => (await indexedDB.databases()).length)).toBe(0);
});

/** Tests that need only an editor. */
test.describe('in one visit', () => {
  test.describe.configure({ mode: 'serial' });
  let visit: Visit;
  let page: Page;
  test.beforeAll(async ({ browser }, { file }) => {
    visit = await Visit.begin(browser, file);
    page = visit.page;
  });
  test.afterAll(() => visit.end());
  test.beforeEach(() => visit.anew());

  test('the editor is accessible by day and by night, on a phone and on a desktop, without a sideways scroll', async () => {
    for (const look of LOOKS) {
      await lookAt(page, look);
      for (const tab of partsIn(look, ['Features', 'Parts', 'Held', 'History', 'Faces'])) {
        await page.getByRole('tab', { name: tab }).click();
        await expectNoBarriers(page, `${tab}, ${look.device}`);
      }
    }
  });

  test('features change, are held, undone and found by a word', async () => {
    await group(page, 'nose');
    await set(page, 'breadth of the alar wings', '0.8');
    await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
    await page.getByRole('button', { name: 'Hold breadth of the alar wings' }).click();
    await set(page, 'length of the nose', '0.1');
    await page.getByRole('button', { name: 'length of the nose: more' }).click();
    await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
    await expect(value(page, 'length of the nose')).toHaveValue('0.2');
    await page.getByRole('tab', { name: 'Held' }).click();
    await expect(page.getByRole('button', { name: 'Release breadth of the alar wings' })).toBeVisible();
    await page.getByRole('tab', { name: 'Features' }).click();
    for (let i = 0; i < 4; i += 1) await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await expect(value(page, 'breadth of the alar wings')).toHaveValue('0');
    await expect(page.getByRole('button', { name: 'Undo', exact: true })).toBeDisabled();
    await page.keyboard.press('Control+Shift+Z');
    await expect(value(page, 'breadth of the alar wings')).toHaveValue('0.8');
    await page.getByLabel('Search').fill('freckl');
    await expect(value(page, 'freckles')).toBeVisible();
  });

  test('plain words in three languages lead to what is meant, also beside the features', async () => {
    const search = page.getByLabel('Search');
    await search.fill('eyes wider apart');
    await expect(page.locator('.feature .name').first()).toHaveText('distance of the eyes');
    await search.fill('Schnurrbart');
    await page.getByRole('button', { name: 'Moustache Style, beard' }).click();
    await expect(page.getByRole('tab', { name: 'Style' })).toHaveAttribute('aria-selected', 'true');
    await expect(page.getByRole('region', { name: 'Beard' }).getByLabel('Style')).toBeFocused();
    await page.getByRole('tab', { name: 'Features' }).click();
    await search.fill('scar');
    await expect(value(page, 'scared')).toHaveCount(0);
    await page.getByRole('button', { name: 'Scar Marks' }).click();
    await expect(page.getByRole('button', { name: 'Scar', exact: true })).toHaveAttribute('aria-pressed', 'true');
    await page.getByRole('tab', { name: 'Features' }).click();
    await search.fill('freqles');
    await page.getByRole('button', { name: 'freckles', exact: true }).click();
    await expect(value(page, 'freckles')).toBeVisible();
    await search.fill('');
  });

  test('the editor writes nothing on itself, and is a region by its label', async () => {
    const editor = page.locator('raconteur-composite');
    // The page itself marks an editor that is ready.
    expect(await editor.evaluate((e) => e.getAttributeNames().filter((name) => name !== 'data-ready'))).toEqual(['id', 'session', 'label']);
    // Properties that an element sets through ElementInternals appear only in the accessibility
    // tree of the browser.
    const devtools = await page.context().newCDPSession(page);
    const { nodes } = await devtools.send('Accessibility.getFullAXTree');
    expect(nodes.some(({ role, name }) => role?.value === 'region' && name?.value === 'Build a face')).toBe(true);
    await devtools.detach();
  });

  /** Drags a slider to some positions, one after another, and releases it. */
  const drag = (name: string, to: readonly number[]) =>
    page.getByRole('slider', { name, exact: true }).evaluate((slider, places) => {
      for (const place of places) {
        (slider as HTMLInputElement).value = String(place);
        slider.dispatchEvent(new Event('input', { bubbles: true }));
      }
      slider.dispatchEvent(new Event('change', { bubbles: true }));
    }, to);
  const acts = () => page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.save()?.steps.map(({ act }) => act) ?? []);

  test('age, caricature and detail are sliders: one step each, however far they were dragged', async () => {
    await page.getByRole('tab', { name: 'Parts' }).click();
    await drag('Age', [10, 40, 60]);
    await drag('Caricature, shape', [20, 50]);
    await drag('Detail of the skin', [30]);
    expect(await acts()).toMatchObject([{ kind: 'average' }, { kind: 'age', amount: 0.6 }, { kind: 'caricature', part: 'shape', level: 1.5 }, { kind: 'detail', strength: 0.3 }]);
    await expect(page.getByRole('slider', { name: 'Age', exact: true })).toHaveValue('0');
  });

  test('a feature is made more on the left than on the right, and back again', async () => {
    await group(page, 'mouth');
    await page.getByText('Left and right apart', { exact: true }).click();
    const skin = () => page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => [...(e.faces?.skin() ?? [])]);
    const before = await skin();
    const name = 'Left − right, width of the mouth';
    await drag(name, [0.2, 0.4]);
    await expect(page.getByRole('slider', { name, exact: true })).toHaveValue('0.4');
    expect(await acts()).toMatchObject([{ kind: 'average' }, { kind: 'asymmetry', name: 'width of the mouth', amount: 0.4 }]);
    const far = (after: readonly number[]) => Math.max(...after.map((x, i) => Math.abs(x - (before[i] ?? 0))));
    expect(far(await skin())).toBeGreaterThan(2e-4);
    await drag(name, [0]);
    expect(far(await skin())).toBeLessThan(1e-9);
    await page.getByText('Left and right apart', { exact: true }).click();
  });

  test('a face gives its colour alone, and what contradicts is told with both values', async () => {
    await page.getByRole('tab', { name: 'Faces' }).click();
    await page.locator('.choice').getByText('Colour', { exact: true }).click();
    await page.locator('.sheet button').nth(2).click();
    await page.locator('.choice').getByText('Shape and colour', { exact: true }).click();
    expect((await acts())[1]).toMatchObject({ kind: 'import', part: 'texture' });
    const held = [0.2, 0.9].map((value) => ({ part: 'shape', name: 'weight', value }));
    const told = await page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite, both) => {
      const good = e.save();
      const steps = [...(good?.steps ?? []), { parent: 0, act: { kind: 'hold', held: both } }];
      return await e.open({ ...good, steps, here: steps.length - 1 }).catch((error: Error) => error.message);
    }, held);
    expect(told).toBe('No face has both: weight +0.20, and weight +0.90. Release one of them.');
  });

  test('sessions out of all bounds are refused by what is wrong with them, and nothing changes', async () => {
    await group(page, 'overall');
    await set(page, 'weight', '0.5');
    const refused = await page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite) => {
      const good = e.save();
      const region = { segments: ['nose'] };
      const scaled = { kind: 'transform', scale: [1, 1, 1e9], turn: [0, 0, 0], way: [0, 0, 0], region };
      const grown = { kind: 'transform', scale: [4, 4, 4], turn: [0, 0, 0], way: [0, 0, 0], region };
      const tried = async (acts: readonly unknown[]): Promise<string> => {
        const steps = [...(good?.steps.slice(0, 1) ?? []), ...acts.map((act, i) => ({ parent: i, act }))];
        return await e.open({ ...good, steps, here: acts.length }).then(
          () => 'opened',
          (error: Error) => error.message,
        );
      };
      return [
        await tried([scaled]),
        await tried([{ kind: 'add', part: 'shape', name: 'weight', amount: 1e308, region: {} }]),
        await tried(Array.from({ length: 1_000_000 }, () => ({ kind: 'average' }))),
        // Each step is within its limits, all of them together are not.
        await tried(Array.from({ length: 40 }, () => grown)),
      ];
    });
    expect(refused.slice(0, 3)).toEqual([
      'This session cannot be read. Step 1: scale 1000000000 is more than 4.',
      'This session cannot be read. Step 1: amount 1e+308 is more than 20.',
      'This session has 1000001 steps, more than 10000.',
    ]);
    expect(refused[3]).not.toBe('opened');
    await expect(value(page, 'weight')).toHaveValue('0.5');
  });

  test('a description chooses faces, and parts of them are taken over', async () => {
    await page.getByRole('tab', { name: 'Parts' }).click();
    await page.getByRole('checkbox', { name: 'nose', exact: true }).check();
    await page.getByRole('tab', { name: 'Faces' }).click();
    await page.getByText('A woman', { exact: true }).click();
    await page.getByText('66 and older', { exact: true }).click();
    const faces = page.locator('.sheet button');
    await expect(faces.first()).toContainText(/^\s*Woman of (6[6-9]|7\d|80)/);
    // Choosing a part is not a step that can be undone.
    await expect(page.getByRole('button', { name: 'Undo', exact: true })).toBeDisabled();
    await expect(page.locator('.sheet img').first()).toBeVisible({ timeout: 60_000 });
    await faces.nth(1).click();
    await page.getByRole('tab', { name: 'History' }).click();
    await expect(page.locator('.steps-list [aria-current="step"]')).toContainText('nose');
  });
});
