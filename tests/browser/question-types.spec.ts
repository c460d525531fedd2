/** Tests of each type of question with user input, subsequent paths, expired time limits, and hostile stories. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Locator } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const ask = (type: string, prompt: string, options: string, more = '') =>
  `<seq time='0'><null time='0.5'/><r:ask time='0' name='q' type='${type}' prompt='${prompt}' ${more}>${options}
    <r:answer to='right'><event time='0.2' type='yes'/><null time='0.4'/></r:answer>
    <r:answer to='wrong'><event time='0.2' type='no'/><null time='0.4'/></r:answer></r:ask><null time='0.5'/></seq>`;

async function open(stage: Stage, body: string, attributes = '', css?: string, files: { [path: string]: Buffer } = {}): Promise<Locator> {
  await stage.open(`<main><h1>A page</h1><raconteur-player src="story.eml" quality="lowest" loading="eager" label="Songs" controls ${attributes}></raconteur-player></main>`, {
    'story.eml': story(body),
    ...files,
    ...(css === undefined ? {} : { 'test.css': css }),
  });
  await stage.ready();
  await stage.play();
  const form = stage.player.locator('[part~=question]');
  await expect(form).toBeVisible();
  return form;
}

const told = (stage: Stage) => stage.page.evaluate(() => window.record.events.filter(({ type }) => type === 'storyevent').map(({ detail }) => (detail as { type: string }).type));
const answered = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => (p.state().answered as { given: string[]; isRight: boolean }[])[0]);

async function hasNoBarriers(stage: Stage): Promise<void> {
  const { violations } = await new AxeBuilder({ page: stage.page }).analyze();
  expect(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ')).join('; ')}`)).toEqual([]);
}

test('things are put in order by keys, and stay under the focus', async ({ stage, page }) => {
  const form = await open(stage, ask('order', 'In order?', `<r:option name='a' text='First'/><r:option name='b' text='Second'/><r:option name='c' text='Third'/>`));
  await hasNoBarriers(stage);
  const texts = async () => (await form.locator('li span').allTextContents()).map((text) => text.trim());
  expect(await texts()).not.toEqual(['First', 'Second', 'Third']);
  for (const [text, place] of [
    ['First', 0],
    ['Second', 1],
  ] as const) {
    for (let i = 0; i < 3 && (await texts()).indexOf(text) > place; i += 1) {
      await form.getByRole('button', { name: `Move up: ${text}` }).focus();
      await page.keyboard.press('Enter');
      await expect(form.getByRole('button', { name: `Move up: ${text}` })).toBeFocused();
    }
  }
  expect(await texts()).toEqual(['First', 'Second', 'Third']);
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['yes']);
  expect(await answered(stage)).toMatchObject({ given: ['a', 'b', 'c'], isRight: true });
});

test('partners are chosen, in any order of theirs', async ({ stage }) => {
  const form = await open(stage, ask('match', 'Which go together?', `<r:option name='a' text='Frog' partner='Pond'/><r:option name='b' text='Owl' partner='Tree'/>`));
  await hasNoBarriers(stage);
  await form.getByLabel('Frog').selectOption({ label: 'Tree' });
  await form.getByLabel('Owl').selectOption({ label: 'Tree' });
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['no']);
  expect(await answered(stage)).toMatchObject({ given: ['b', 'b'], isRight: false });
});

test('gaps are filled, whatever their capitals and accents', async ({ stage }) => {
  const form = await open(
    stage,
    ask('gap', 'The [who] sat in a [where].', `<r:option name='where' accepts='café|inn'/><r:option name='who' accepts='frog'/>`, `tries='2' hint='It is green.'`),
  );
  await hasNoBarriers(stage);
  await expect(form).toContainText('The … sat in a ….');
  await form.getByLabel('Gap 1 of 2').fill('stone');
  await form.getByLabel('Gap 2 of 2').fill('inn');
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.getByRole('status')).toHaveText('Not yet. It is green. One try is left.');
  await form.getByLabel('Gap 1 of 2').fill(' FROG!');
  await form.getByLabel('Gap 2 of 2').fill('cafe');
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['yes']);
});

test('numbers and texts go by rules', async ({ stage, page }) => {
  const number = await open(stage, ask('number', 'How far?', `<r:option name='near' least='2.5' most='3' right='true'/><r:option name='far' least='3'/>`));
  await hasNoBarriers(stage);
  await number.getByLabel('Your answer').fill('about three');
  await page.keyboard.press('Enter');
  await expect(number.getByRole('status')).toHaveText('There is no answer yet.');
  await number.getByLabel('Your answer').fill('2,75');
  await page.keyboard.press('Enter');
  await expect.poll(() => told(stage)).toEqual(['yes']);
  const text = await open(stage, ask('text', 'Why?', `<r:option name='well' accepts='cold|winter' rejects='summer' right='true'/>`));
  await hasNoBarriers(stage);
  await text.getByLabel('Your answer').fill('<b>In</b> the *Winter*, <script>alert(1)</script>');
  await text.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['yes']);
});

test('the figure is pointed at, on the stage or in the form', async ({ stage, page }) => {
  const options = `<r:option name='left' text='The left hand' at='l_wrist' right='true'/><r:option name='right' text='The right hand' at='r_wrist'/>`;
  await page.setViewportSize({ width: 840, height: 600 });
  const form = await open(stage, ask('point', 'Which one?', options), '', 'raconteur-player { width: 800px; height: 450px }');
  await hasNoBarriers(stage);
  const marks = stage.player.locator('.marker');
  await expect(marks).toHaveCount(2);
  const box = await stage.player.boundingBox();
  await expect.poll(async () => ((await marks.first().boundingBox())?.x ?? 0) - (box?.x ?? 0)).toBeGreaterThan(20);
  // The character's left is the viewer's right.
  const [left, right] = [await marks.nth(0).boundingBox(), await marks.nth(1).boundingBox()];
  expect(left?.x).toBeGreaterThan(right?.x ?? 0);
  // It moves with the figure, a little all the time.
  const at = await marks.nth(1).boundingBox();
  await page.mouse.click((at?.x ?? 0) + (at?.width ?? 0) / 2, (at?.y ?? 0) + (at?.height ?? 0) / 2);
  await expect(form.getByLabel('The right hand')).toBeChecked();
  await form.getByLabel('The right hand').focus();
  await page.keyboard.press('ArrowUp');
  await expect(form.getByLabel('The left hand')).toBeChecked();
  await page.keyboard.press('Enter');
  await expect.poll(() => told(stage)).toEqual(['yes']);
});

test('the figure waits, alive, and goes on where it is', async ({ stage }) => {
  await open(stage, ask('choice', 'Which?', `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`));
  const pose = () => stage.player.evaluate((p: RaconteurPlayer) => [...(p.pose()?.numbers ?? [])].join());
  const first = await pose();
  await expect.poll(pose).not.toBe(first);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.currentTime)).toBeCloseTo(0.5, 2);
});

test('time that is over is an answer, and more of it is given', async ({ stage }) => {
  const form = await open(stage, ask('choice', 'Soon?', `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`, `limit='12' tries='3'`));
  await expect(form.getByRole('timer')).toHaveText(/Time left: \d+ s/);
  await expect(form.getByRole('timer')).toHaveText(/Time left: [1-9] s/);
  await form.getByRole('button', { name: 'More time' }).click();
  await expect(form.getByRole('timer')).toHaveText(/Time left: 1[012] s/);
  await hasNoBarriers(stage);
  await expect.poll(() => told(stage), { timeout: 60_000 }).toEqual(['no']);
  expect(await answered(stage)).toMatchObject({ given: [], isRight: false });
});

test('ways follow from answers, and parts are chapters', async ({ stage }) => {
  const body = `<seq time='0'>
    <r:part time='0' name='one' title='The &lt;start&gt;'><seq time='0'><null time='0.3'/>
      <r:ask time='0' name='q' prompt='Which way?'><r:option name='a' text='Left' right='true'/><r:option name='b' text='Back'/>
        <r:answer to='b'><seq time='0'><event time='0.1' type='back'/><r:goto time='0.1' to='one'/></seq></r:answer></r:ask>
      <r:set time='0' name='way' value='left'/></seq></r:part>
    <r:if name='way' is='right'><event time='0.1' type='never'/><null time='30'/></r:if>
    <r:if name='q' is='right'><event time='0.1' type='left'/><null time='0.3'/></r:if>
    <r:part time='0' name='two' title='The end'><event time='0.1' type='end'/><null time='0.4'/></r:part></seq>`;
  const form = await open(stage, body);
  const chapters = await stage.player.evaluate((p: RaconteurPlayer) =>
    [...p.textTracks].filter(({ kind }) => kind === 'chapters').flatMap((track) => [...(track.cues ?? [])].map((cue) => (cue as VTTCue).text)),
  );
  expect(chapters).toEqual(['The &lt;start>', 'The end']);
  await form.getByLabel('Back').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['back']);
  await expect(form).toBeVisible();
  await form.getByLabel('Left').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
  expect(await told(stage)).toEqual(['back', 'left', 'end']);
});

test('a page asks by a fragment, hears of the answer, and says what follows', async ({ stage }) => {
  await stage.open('<main><h1>A page</h1><raconteur-player quality="lowest" loading="eager" label="Songs" controls></raconteur-player></main>', {});
  const answers = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const told = await p.perform(`<r:ask xmlns:r='urn:raconteur:eml:1' time='0.5' name='live' prompt='Shall I go on?'>
      <r:option name='yes' text='Yes' right='true'/><r:option name='no' text='No'/></r:ask>`);
    await p.play();
    return told.map(({ kind }) => kind);
  });
  expect(answers).toEqual(['accepted']);
  const form = stage.player.locator('[part~=question]');
  await expect(form).toBeVisible({ timeout: 60_000 });
  await form.getByLabel('No').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form).toHaveCount(0);
  const state = await stage.player.evaluate((p: RaconteurPlayer) => ({ answered: p.state().answered, paused: p.paused }));
  expect(state).toMatchObject({ answered: [{ name: 'live', given: ['no'], isRight: false }], paused: false });
  // An interrupted fragment does not ask its question.
  await stage.player.evaluate(async (p: RaconteurPlayer) => {
    await p.perform(`<r:ask xmlns:r='urn:raconteur:eml:1' time='3' name='late' prompt='Late?'><r:option name='yes' text='Yes' right='true'/></r:ask>`);
    p.interrupt();
  });
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.score.most)).toBe(1);
});

test('another story knows nothing of the answers to the one before', async ({ stage }) => {
  const body = ask('choice', 'Who?', `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`);
  await open(stage, body);
  await stage.player.evaluate((p: RaconteurPlayer) => p.answer('a'));
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.score.points)).toBe(1);
  await stage.player.evaluate(async (p: RaconteurPlayer) => {
    p.src = 'story.eml?again';
    await p.load();
  });
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.readyState)).toBe(4);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.score.points, (p.state().answered as unknown[]).length])).toEqual([0, 0]);
});

test('a press on play while something is asked goes to the question', async ({ stage }) => {
  const form = await open(stage, ask('choice', 'Which?', `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`));
  const before = await stage.page.evaluate(() => window.record.events.filter(({ type }) => type === 'play').length);
  await stage.player.getByRole('button', { name: /play/i }).first().click();
  await expect(form.getByLabel('A', { exact: true })).toBeFocused();
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.play().catch((error: Error) => error.name))).toBe('InvalidStateError');
  expect(await stage.page.evaluate(() => window.record.events.filter(({ type }) => type === 'play').length)).toBe(before);
});

test('a story from the right has its form there, in words of its language where there are some', async ({ stage }) => {
  const asked = ask('choice', 'من غنى؟', `<r:option name='a' text='ضفدع' right='true'/><r:option name='b' text='حجر'/>`);
  const form = await open(stage, asked, 'lang="ar"');
  await expect(form).toHaveAttribute('dir', 'rtl');
  await hasNoBarriers(stage);
  const german = await open(stage, asked, 'lang="de-AT"');
  await expect(german.getByRole('button', { name: 'Antworten' })).toBeVisible();
});

test('where nothing is performed, what was right is read and said, and can be closed', async ({ stage }) => {
  const options = `<r:option name='a' text='A' right='true'/><r:option name='b' text='B'/>`;
  const body = `<seq time='0'><null time='0.3'/><r:ask time='0' name='one' prompt='One?'>${options}</r:ask>
    <r:ask time='0' name='two' prompt='Two?' feedbackRight='Well seen!'>${options}</r:ask><null time='30'/></seq>`;
  const form = await open(stage, body);
  await form.getByLabel('B', { exact: true }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.locator('legend')).toHaveText('Two?');
  await expect(form.locator('[part~=feedback]')).toHaveText('That is not right. Correct answer: A');
  await expect(stage.player.locator('.unseen')).toHaveText('That is not right. Correct answer: A Question: Two?');
  await hasNoBarriers(stage);
  await form.getByLabel('A', { exact: true }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form).toHaveCount(0);
  const note = stage.player.locator('[part~=feedback]');
  await expect(note).toContainText('Well seen!');
  await hasNoBarriers(stage);
  await note.getByRole('button', { name: 'Close' }).click();
  await expect(note).toHaveCount(0);
});

test('what is not graded is taken as it is', async ({ stage }) => {
  const body = `<seq time='0'><null time='0.3'/><r:ask time='0' name='why' type='text' prompt='Why?' graded='false'/>
    <r:ask time='0' name='liked' prompt='Did you like it?' graded='false'><r:option name='yes' text='Yes'/><r:option name='no' text='No'/>
    <r:answer to='answered'><event time='0.1' type='thanks'/><null time='0.4'/></r:answer></r:ask><null time='1'/></seq>`;
  const form = await open(stage, body);
  await form.getByLabel('Your answer').fill('Because.');
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.locator('[part~=feedback]')).toHaveText('Thank you.');
  await form.getByLabel('No').check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['thanks']);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.state().answered, p.score])).toEqual([
    [
      { name: 'why', given: ['Because.'], fits: [], points: 0, tries: 1, isFinal: true },
      { name: 'liked', given: ['no'], fits: ['no'], points: 0, tries: 1, isFinal: true },
    ],
    { points: 0, most: 0 },
  ]);
});

test('options are in an order by chance, and of a pool some is asked: the same for whoever comes back', async ({ stage }) => {
  const options = (from: number) => Array.from({ length: 6 }, (_, i) => `<r:option name='o${i}' text='Option ${from + i}' ${i === 0 ? `right='true'` : ''}/>`).join('');
  const asks = Array.from(
    { length: 4 },
    (_, i) =>
      `<seq time='0.1'><event time='0' type='item${i}'/><null time='0.2'/><r:ask time='0' name='q${i}' prompt='Question ${i}?' shuffle='true'>${options(10 * i)}</r:ask></seq>`,
  );
  const body = `<seq time='0'><null time='0.3'/><r:pool time='0' count='2'>${asks.join('')}</r:pool><event time='0' type='after'/><null time='0.3'/></seq>`;
  const form = await open(stage, body);
  const shown = async () => [await form.locator('legend').innerText(), ...(await form.locator('label').allInnerTexts())];
  const first = await shown();
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.score.most, p.questions.length])).toEqual([2, 2]);
  const kept = await stage.player.evaluate((p: RaconteurPlayer) => JSON.stringify(p.state()));
  const name = first[0]?.replace(/\D/g, '') ?? '';
  await form.getByLabel(`Option ${name === '0' ? '' : name}0`, { exact: true }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect(form.locator('legend')).not.toHaveText(first[0] ?? '');
  const second = await shown();
  // Another visit of the same attempt.
  await open(stage, body);
  await stage.player.evaluate((p: RaconteurPlayer, text) => p.restore(JSON.parse(text) as ReturnType<RaconteurPlayer['state']>), kept);
  await stage.seek(0);
  // Until here another attempt was played.
  const before = (await told(stage)).length;
  await stage.play();
  await expect.poll(shown).toEqual(first);
  await form.locator('input').first().check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(shown).toEqual(second);
  await form.locator('input').first().check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.ended), { timeout: 60_000 }).toBe(true);
  const items = (await told(stage)).slice(before).filter((type) => type.startsWith('item'));
  expect(new Set(items)).toEqual(new Set([first, second].map(([legend]) => `item${legend?.replace(/\D/g, '') ?? ''}`)));
  expect((await told(stage)).at(-1)).toBe('after');
});

test('questions and options have pictures, from the folder of the story alone', async ({ stage }) => {
  const body = ask(
    'choice',
    'Who sang?',
    `<r:option name='a' picture='a b.png' alt='A frog' right='true'/><r:option name='b' text='An owl' picture='%2e%2e/owl.png' alt=''/>`,
    `picture='a b.png' alt='A pond'`,
  );
  const png = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==', 'base64');
  const form = await open(stage, body, '', undefined, { 'a%20b.png': png });
  await hasNoBarriers(stage);
  const images = form.locator('img');
  await expect(images).toHaveCount(3);
  expect(await images.evaluateAll((all) => all.map((it) => new URL((it as HTMLImageElement).src).pathname.split('/').pop()))).toEqual(['a%20b.png', 'a%20b.png', 'owl.png']);
  await expect.poll(() => images.first().evaluate((it: HTMLImageElement) => it.naturalWidth)).toBe(1);
  expect(await images.nth(2).evaluate((it: HTMLImageElement) => it.src.includes('/%252e%252e/owl.png'))).toBe(true);
  await form.getByRole('radio', { name: 'A frog' }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => told(stage)).toEqual(['yes']);
});

test('ten thousand questions are a story', async ({ stage }) => {
  const one = (i: number) => `<r:ask time='0' name='q${i}' prompt='Which?'><r:option name='a' text='A' right='true'/></r:ask>`;
  const form = await open(stage, `<seq time='0'><null time='0.3'/>${Array.from({ length: 10_000 }, (_, i) => one(i)).join('')}</seq>`);
  await form.getByLabel('A', { exact: true }).check();
  await form.getByRole('button', { name: 'Answer' }).click();
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.question?.name)).toBe('q1');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.score)).toEqual({ points: 1, most: 10_000 });
});
