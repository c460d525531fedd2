/** Tests of subtitles: `<track>` elements of a player, chosen in its list of languages, by a key and by a script. */

import type { Locator } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expectNoBarriers } from './access.js';
import { expect, test, type Stage } from './stage.js';

const PORTUGUESE = `WEBVTT

NOTE written for this test

STYLE
::cue { color: red }

first
00:00:00.500 --> 00:00:02.000 align:start position:10%
<v Sofia>Olá, <i>mundo</i>!</v>
<c.loud>Sou</c> a Sofia &amp; conto.

00:00:02.000 --> 00:00:03.000
<img src=x onerror=alert(1)>Um <b>coelho
`;
const GERMAN = 'WEBVTT\n\n00:00.500 --> 00:09.000\nHallo Welt!\n';
const files = { 'pt.vtt': PORTUGUESE, 'de.vtt': GERMAN, 'bad.vtt': '1\n00:00:00,500 --> 00:00:09,000\nSubRip\n' };
const pt = '<track kind="subtitles" srclang="pt" label="Português" src="pt.vtt">';
const de = '<track kind="captions" srclang="de" label="Deutsch" src="de.vtt" id="german">';

/** Opens a story with subtitles, and shows a time at which each of them has a text. */
async function open(stage: Stage, tracks: string, attributes = 'controls captions'): Promise<void> {
  await stage.open(`<main><h1>Story</h1><raconteur-player src="/assets/stories/white-rabbit/story.eml" quality="lowest" ${attributes}>${tracks}</raconteur-player></main>`, {
    ...files,
    'test.css': 'raconteur-player { width: 480px; height: 270px; aspect-ratio: auto } body, h1 { margin: 0 }',
  });
  await stage.ready();
  await stage.seek(1);
}

const button = ({ player }: Stage): Locator => player.getByRole('button', { name: 'Captions' });
const choice = ({ player }: Stage, name: string): Locator => player.getByRole('menuitemradio', { name });
const shown = ({ player }: Stage): Locator => player.locator('[part="captions"]');
const modes = ({ player }: Stage): Promise<string[]> => player.evaluate((p: RaconteurPlayer) => [...p.textTracks].map(({ kind, language, mode }) => `${kind} ${language} ${mode}`));
const setMode = ({ player }: Stage, language: string, mode: TextTrackMode): Promise<void> =>
  player.evaluate(
    (p: RaconteurPlayer, [of, to]) => {
      const track = [...p.textTracks].find((one) => one.language === of);
      if (track === undefined) throw new Error(`no track in ${of}`);
      track.mode = to;
    },
    [language, mode] as const,
  );

test('a language is chosen by mouse and keyboard; C hides and shows it', async ({ stage, page }) => {
  await open(stage, pt + de);
  await expect(shown(stage)).toHaveAttribute('lang', 'en');
  await expect(stage.captionWord).toHaveCount(1);
  await button(stage).click();
  await expect(choice(stage, 'English')).toBeFocused();
  await expect(choice(stage, 'English')).toHaveAttribute('aria-checked', 'true');
  for (const item of await stage.player.getByRole('menuitemradio').all()) expect((await item.boundingBox())?.height).toBeGreaterThanOrEqual(44);
  await expectNoBarriers(page, 'list of languages');
  await choice(stage, 'Português').click();
  await expect(button(stage)).toBeFocused();
  await expect(choice(stage, 'Português')).toHaveCount(0);
  await expect(shown(stage)).toHaveText('Olá, mundo!Sou a Sofia & conto.');
  await expect(shown(stage)).toHaveAttribute('lang', 'pt');
  await expect(stage.captionWord).toHaveCount(0);
  expect(await shown(stage).evaluate((box) => box.querySelectorAll('br').length)).toBe(1);
  await expectNoBarriers(page, 'subtitles');

  await page.keyboard.press('c');
  await expect(shown(stage)).toHaveCount(0);
  await page.keyboard.press('c');
  await expect(shown(stage)).toHaveAttribute('lang', 'pt');

  await page.keyboard.press('Enter');
  await expect(choice(stage, 'Português')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await expect(choice(stage, 'Deutsch')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await expect(choice(stage, 'Off')).toBeFocused();
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  await expect(button(stage)).toBeFocused();

  const secs = await stage.time();
  await page.keyboard.press('Enter');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Home');
  await expect(choice(stage, 'Off')).toBeFocused();
  await page.keyboard.press('Escape');
  await expect(choice(stage, 'Off')).toHaveCount(0);
  await expect(button(stage)).toBeFocused();
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  expect(await stage.time()).toBe(secs);

  await button(stage).click();
  await choice(stage, 'Off').click();
  await expect(shown(stage)).toHaveCount(0);
  expect(await modes(stage)).toEqual(['captions en disabled', 'subtitles pt disabled', 'captions de disabled']);
  await button(stage).click();
  await stage.player.getByRole('button', { name: 'Play', exact: true }).focus();
  await expect(choice(stage, 'Off')).toHaveCount(0);
});

test('markup is plain text', async ({ stage }) => {
  await open(stage, pt.replace('<track', '<track default'), 'controls');
  await expect(shown(stage)).toHaveText('Olá, mundo!Sou a Sofia & conto.');
  await stage.seek(2.5);
  await expect(shown(stage)).toHaveText('Um coelho');
  expect(await shown(stage).evaluate((box) => [...box.querySelectorAll('*')].map(({ localName }) => localName))).toEqual(['span']);
});

test('a script sets the modes; the own captions give way', async ({ stage }) => {
  await open(stage, pt + de);
  expect(await modes(stage)).toEqual(['captions en showing', 'subtitles pt disabled', 'captions de disabled']);
  await setMode(stage, 'de', 'showing');
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  expect(await modes(stage)).toEqual(['captions en disabled', 'subtitles pt disabled', 'captions de showing']);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.textTracks.getTrackById('german')?.label)).toBe('Deutsch');
  await setMode(stage, 'pt', 'showing');
  await expect(shown(stage)).toHaveText(['Olá, mundo!Sou a Sofia & conto.', 'Hallo Welt!']);
  const [upper, lower] = await Promise.all((await shown(stage).all()).map((box) => box.boundingBox()));
  expect((upper?.y ?? 0) + (upper?.height ?? 0)).toBeLessThanOrEqual(lower?.y ?? 0);
  await setMode(stage, 'pt', 'hidden');
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.textTracks[1]?.cues?.length)).toBe(2);
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  await setMode(stage, 'de', 'disabled');
  await expect(shown(stage)).toHaveCount(0);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.captions)).toBe(false);
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.captions = true));
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  await setMode(stage, 'en', 'showing');
  await expect(stage.captionWord).toHaveCount(1);
});

for (const [name, src, message] of [
  ['missing', 'none.vtt', 'The subtitle file was not found at /test/none.vtt.'],
  ['not WebVTT', 'bad.vtt', 'The subtitle file /test/bad.vtt is not WebVTT: it does not begin with WEBVTT.'],
] as const) {
  test(`a file that is ${name} is reported, and the story plays with its own captions`, async ({ stage }) => {
    await open(stage, pt.replace('pt.vtt', src));
    await button(stage).click();
    await choice(stage, 'Português').click();
    await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => `${d.code}: ${d.message}`))).toEqual([`subtitles-missing: ${message}`]);
    await expect(shown(stage)).toHaveAttribute('lang', 'en');
    await stage.play();
    await stage.until(1.5);
  });
}

/** Adds a `<track>` to the player by a script. */
const add = ({ player }: Stage, about: { readonly [name: string]: string }): Promise<void> =>
  player.evaluate((p, given) => p.append(Object.assign(document.createElement('track'), given)), about);
const portuguese = { kind: 'subtitles', srclang: 'pt', label: 'Português', src: 'pt.vtt' };

test('elements come, change and go; the language stays with another story', async ({ stage }) => {
  await open(stage, '');
  await expect(button(stage)).toHaveAttribute('aria-pressed', 'true');
  await add(stage, portuguese);
  await add(stage, { kind: 'captions', srclang: 'de', src: 'de.vtt' });
  await button(stage).click();
  await expect(choice(stage, 'Deutsch')).toHaveAttribute('lang', 'de');
  await choice(stage, 'Português').click();
  await expect(shown(stage)).toHaveAttribute('lang', 'pt');

  await stage.player.evaluate((p: RaconteurPlayer) => p.querySelector('track')?.setAttribute('src', 'de.vtt'));
  await expect(shown(stage)).toHaveText('Hallo Welt!');
  await stage.player.evaluate((p: RaconteurPlayer) => p.querySelector('track')?.setAttribute('label', 'Brasileiro'));
  await expect(shown(stage)).toHaveAttribute('lang', 'pt');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.textTracks.shown[0]?.label)).toBe('Brasileiro');

  await stage.player.evaluate((p: RaconteurPlayer) => {
    p.querySelector('track')?.remove();
    p.src = '/assets/stories/hello-world/story.eml';
  });
  await add(stage, portuguese);
  await stage.ready();
  await stage.seek(1);
  await expect(shown(stage)).toHaveText('Olá, mundo!Sou a Sofia & conto.');

  await stage.player.evaluate((p: RaconteurPlayer) => p.replaceChildren());
  await expect.poll(() => modes(stage)).toEqual(['captions en showing']);
  await expect(button(stage)).toHaveAttribute('aria-pressed', 'true');
});
