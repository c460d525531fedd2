/** Tests of the fallback without rendering: a film of the story in sync with its audio, else its poster. */

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story, voiceFiles } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

/** Length of the film, seconds; its first half is red, its second blue. */
const LENGTH_SECS = 8;
let film: Buffer;

test.beforeAll(() => {
  const folder = mkdtempSync(join(tmpdir(), 'film-'));
  const file = join(folder, 'film.webm');
  const half = (colour: string) => ['-f', 'lavfi', '-i', `color=${colour}:s=160x90:r=25:d=${LENGTH_SECS / 2}`];
  const args = [...half('red'), ...half('blue'), '-filter_complex', 'concat=n=2', '-c:v', 'libvpx', '-g', '25', '-deadline', 'realtime', file];
  execFileSync('ffmpeg', ['-loglevel', 'error', ...args]);
  film = readFileSync(file);
  rmSync(folder, { recursive: true });
});

const TEXT = 'One two three four';
const POSTER = `data:image/svg+xml,${encodeURIComponent("<svg xmlns='http://www.w3.org/2000/svg' width='16' height='9'><rect width='16' height='9' fill='lime'/></svg>")}`;

/** Opens a story of eight seconds, with neither WebGL nor WebGPU. */
async function open(stage: Stage, attributes: string, body = `<voice-text time='0'>${TEXT}</voice-text>`): Promise<string[]> {
  const { page } = stage;
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: []) {
      return /^webg/.test(kind) ? null : getContext.call(this, kind as '2d', ...rest);
    } as typeof getContext;
    Object.defineProperty(Navigator.prototype, 'gpu', { value: undefined });
  });
  const asked: string[] = [];
  await page.route('**/films/**', (route) => {
    const { pathname } = new URL(route.request().url());
    asked.push(pathname);
    if (pathname !== '/films/film.webm') return route.fulfill({ status: 404 });
    const [, from = '0', to] = /^bytes=(\d+)-(\d*)$/.exec(route.request().headers()['range'] ?? '') ?? [];
    const end = to ? Number(to) + 1 : film.length;
    const headers = { 'Content-Range': `bytes ${from}-${end - 1}/${film.length}`, 'Content-Type': 'video/webm', 'Accept-Ranges': 'bytes' };
    return route.fulfill({ status: 206, headers, body: film.subarray(Number(from), end) });
  });
  const made = [{ text: TEXT, msec: LENGTH_SECS * 1000, samples: new Float32Array(44_100 * LENGTH_SECS) }];
  await stage.open(`<raconteur-player src="story.eml" loading="eager" captions controls ${attributes}></raconteur-player>`, { 'story.eml': story(body), ...voiceFiles(made) });
  await stage.ready();
  return asked;
}

interface ShownState {
  readonly paused: boolean;
  /** Lead of the film over the audio, seconds. */
  readonly drift: number;
  readonly rate: number;
  readonly seeking: boolean;
}

const shown = (stage: Stage): Promise<ShownState | undefined> =>
  stage.player.evaluate((p: RaconteurPlayer) => {
    const video = p.shadowRoot?.querySelector('video');
    return video ? { paused: video.paused, drift: video.currentTime - p.currentTime, rate: video.playbackRate, seeking: video.seeking || video.readyState < 2 } : undefined;
  });

/** Waits until the film is paused at the position of the story. */
async function stands(stage: Stage): Promise<void> {
  await expect.poll(async () => (await shown(stage))?.seeking).toBe(false);
  await expect.poll(async () => Math.abs((await shown(stage))?.drift ?? 9)).toBeLessThan(0.05);
  expect((await shown(stage))?.paused).toBe(true);
}

/** Returns the colour of the stage away from notes, captions and controls. */
async function colour(stage: Stage): Promise<'red' | 'blue' | 'lime' | 'other'> {
  const png = await stage.player.screenshot({ animations: 'disabled' });
  const [r = 0, g = 0, b = 0] = await stage.page.evaluate(
    async (source) => {
      const image = new Image();
      image.src = source;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context?.drawImage(image, 0, 0);
      return [...(context?.getImageData(image.width * 0.75, image.height * 0.42, 1, 1).data ?? [])];
    },
    `data:image/png;base64,${png.toString('base64')}`,
  );
  if (r > 150 && b < 90 && g < 90) return 'red';
  if (b > 150 && r < 90) return 'blue';
  return g > 150 ? 'lime' : 'other';
}

/** Returns the expected colour of the film at the story's position: on a busy machine it may be past its middle. */
const due = async (stage: Stage) => ((await stage.time()) < LENGTH_SECS / 2 ? 'red' : 'blue');

test('a film follows the sound: it plays, rests, is sought, and changes its speed', async ({ stage }) => {
  await open(stage, 'film="/films/film.webm"');
  await stands(stage);
  await expect(stage.player.locator('[part~=picture-lost]')).toContainText('film');
  await stage.play();
  await stage.until(1.5);
  for (let i = 0; i < 5; i++) {
    const now = await shown(stage);
    expect(now?.paused).toBe(false);
    expect(Math.abs(now?.drift ?? 9)).toBeLessThan(0.25);
    await stage.page.waitForTimeout(100);
  }
  await expect(stage.player.locator('.captions')).toContainText('One');
  await stage.pause();
  await stands(stage);
  expect(await colour(stage)).toBe(await due(stage));
  // Into the second half, at rest.
  await stage.seek(6);
  await stands(stage);
  expect(await colour(stage)).toBe('blue');
  // And back, while it plays, at another speed.
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.playbackRate = 1.5));
  await stage.play();
  await stage.seek(0.5);
  await stage.until(2.5);
  const fast = await shown(stage);
  expect(fast?.rate).toBeGreaterThan(1.3);
  expect(Math.abs(fast?.drift ?? 9)).toBeLessThan(0.4);
  await stage.pause();
  await stands(stage);
  expect(await colour(stage)).toBe(await due(stage));
});

test('a film that is shorter than its story keeps its last picture', async ({ stage }) => {
  await open(stage, 'film="/films/film.webm"', `<voice-text time='0'>${TEXT}</voice-text><null time='20'/>`);
  await stage.seek(15);
  await expect.poll(async () => (await shown(stage))?.seeking).toBe(false);
  expect(await colour(stage)).toBe('blue');
  await stage.play();
  await stage.until(15.5);
  expect((await shown(stage))?.paused).toBe(true);
});

test('of several films the first is shown that can be played', async ({ stage }) => {
  const asked = await open(stage, 'film="/films/absent.mp4 /films/film.webm"');
  await stands(stage);
  expect(asked[0]).toBe('/films/absent.mp4');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).not.toContain('film-missing');
});

test('without a film the poster stays, and nothing is asked for', async ({ stage, page }) => {
  const absent: string[] = [];
  page.on('response', (response) => response.status() === 404 && absent.push(response.url()));
  const asked = await open(stage, `poster="${POSTER}"`);
  await stage.play();
  await stage.until(0.5);
  expect(await colour(stage)).toBe('lime');
  await expect(stage.player.locator('.captions')).toContainText('One');
  expect([asked, absent]).toEqual([[], []]);
});

test('a film that cannot be played is told, and the poster stands in', async ({ stage }) => {
  const asked = await open(stage, `film="/films/absent.webm" poster="${POSTER}"`);
  await expect.poll(() => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.map((d) => d.code))).toContain('film-missing');
  await stage.play();
  await stage.until(0.3);
  expect(await colour(stage)).toBe('lime');
  expect(new Set(asked).size).toBe(1);
});

test('where a picture is drawn no film is fetched', { tag: '@draws' }, async ({ stage, page }) => {
  const asked: string[] = [];
  page.on('request', (request) => request.url().includes('/films/') && asked.push(request.url()));
  await stage.load('hello-world', 'film="/films/film.webm" quality="lowest"');
  await stage.play();
  await stage.until(0.5);
  expect(asked).toEqual([]);
});
