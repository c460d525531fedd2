/** A bare page with players for the tests, and eyes and ears to check them with. */

import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { test as base, expect, type BrowserContext, type Locator, type Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { decodePose, type PoseNow } from '../../web/element/engine/pose.js';
import { visitedAt, visits } from '../../web/tools/graph.mjs';

export { expect };

/** Words and their times; times from the start of the utterance. */
export interface Span {
  text: string;
  start_secs: number;
  end_secs: number;
}

/** The words and phones of a story as its speech bundle has them. */
export interface BundleUtterance {
  text: string;
  duration_secs: number;
  audio: { file: string; mime: string }[];
  words: Span[];
  phones: Span[];
}

/** Returns the speech bundle of a story of the library. */
export function bundle(story: string): BundleUtterance[] {
  const path = join(import.meta.dirname, '../../assets/stories', story, 'voice/speech.json');
  const { utterances } = JSON.parse(readFileSync(path, 'utf8')) as { utterances: Written[] };
  return utterances.map(readUtterance);
}

/** An utterance as it is written: phones with their lengths, words as text and phones. */
interface Written {
  text: string;
  audio: { file: string; mime: string }[];
  phones: string;
  msecs: number[];
  words: [start: number, bytes: number, firstPhone: number, phones: number][];
}

function readUtterance({ text, audio, phones, msecs, words }: Written): BundleUtterance {
  let end = 0;
  const spans = phones.split(' ').map((symbol, i) => {
    const start = end;
    end += msecs[i] ?? 0;
    return { text: symbol, start_secs: start / 1000, end_secs: end / 1000 };
  });
  const bytes = Buffer.from(text);
  const spoken = words.map(([start, length, first, count]) => ({
    text: bytes.subarray(start, start + length).toString(),
    start_secs: spans[first]?.start_secs ?? 0,
    end_secs: spans[first + count - 1]?.end_secs ?? 0,
  }));
  return { text, audio, duration_secs: end / 1000, words: spoken, phones: spans };
}

/** Data that the page records for the tests. */
interface Record {
  contexts: AudioContext[];
  /** Starts of sounds: source time, offset in the sound, and length. */
  starts: { when: number; offset: number; secs: number }[];
  violations: string[];
  devices: { destroy(): void }[];
  events: { type: string; at: number; detail: unknown }[];
}

declare global {
  interface Window {
    record: Record;
  }
}

/** Runs before the page's own scripts: records calls of Web Audio and refusals of the policy. */
function listen(): void {
  const record: Record = { contexts: [], starts: [], violations: [], devices: [], events: [] };
  window.record = record;
  const Context = window.AudioContext;
  window.AudioContext = class extends Context {
    constructor(options?: AudioContextOptions) {
      super(options);
      record.contexts.push(this);
    }
  };
  const start = AudioBufferSourceNode.prototype.start;
  AudioBufferSourceNode.prototype.start = function (when = 0, offset = 0, ...rest: []) {
    record.starts.push({ when, offset, secs: this.buffer?.duration ?? 0 });
    start.call(this, when, offset, ...rest);
  };
  document.addEventListener('securitypolicyviolation', (event) => {
    record.violations.push(`${event.violatedDirective} ${event.blockedURI}`);
  });
  const adapter = (window as { GPUAdapter?: { prototype: { requestDevice(...args: unknown[]): Promise<{ destroy(): void }> } } }).GPUAdapter;
  if (adapter !== undefined) {
    const request = adapter.prototype.requestDevice;
    adapter.prototype.requestDevice = async function (...args) {
      const device = await request.apply(this, args);
      record.devices.push(device);
      return device;
    };
  }
  const types = [
    'play',
    'playing',
    'pause',
    'waiting',
    'seeking',
    'seeked',
    'ended',
    'error',
    'ratechange',
    'volumechange',
    'timeupdate',
    'loadedmetadata',
    'word',
    'phone',
    'utterance',
    'clause',
    'storyevent',
    'diagnostic',
  ];
  for (const type of types) {
    document.addEventListener(
      type,
      (event) => {
        const player = event.target;
        if (!(player instanceof HTMLElement) || player.localName !== 'raconteur-player') return;
        record.events.push({ type, at: (player as RaconteurPlayer).currentTime, detail: (event as CustomEvent).detail });
      },
      // Media events do not bubble, but they are captured.
      true,
    );
  }
}

/** Files that exist for one test only, by path. */
type Files = { [path: string]: string | Buffer };

/** Waits until a player is loaded. */
export async function ready(player: Locator): Promise<void> {
  await expect.poll(() => player.evaluate((p: RaconteurPlayer) => p.error?.message ?? p.readyState), { timeout: 60_000 }).toBe(4);
}

/** Performs an action that moves the camera, and waits until the displayed image is seen from there. */
export async function moved(player: Locator, act: () => Promise<unknown>): Promise<void> {
  const camera = async () => JSON.stringify((await poseOf(player))?.camera);
  const before = await camera();
  await act();
  await expect.poll(camera, { timeout: 60_000 }).not.toBe(before);
}

/** Returns the pose that a player shows. */
export async function poseOf(player: Locator): Promise<PoseNow | undefined> {
  const told = await player.evaluate((p: RaconteurPlayer) => {
    const { names, numbers } = p.pose() ?? { names: [], numbers: [] };
    return { names: [...names], numbers: [...numbers] };
  });
  return decodePose(told);
}

export class Stage {
  constructor(
    readonly page: Page,
    readonly backend: string,
  ) {}

  get player(): Locator {
    return this.page.locator('raconteur-player').first();
  }

  get captionWord(): Locator {
    return this.player.locator('mark');
  }

  /** Opens a page whose body is `body`, with the policy of the real one unless `isStrict` is false; it may connect to `peer`, too. */
  async open(body: string, files: Files = {}, peer = '', isStrict = true): Promise<void> {
    const strict = (await this.page.request.get('/')).headers()['content-security-policy'] ?? '';
    const policy = strict.replace("connect-src 'self'", `connect-src 'self' ${peer}`.trim());
    // Tests do not speak in the page unless they test speech.
    const speech = body.includes('speech=') ? '' : ' speech="browser"';
    const html = `<!doctype html><html lang="en"><meta charset="utf-8"><title>Test</title>
      <link rel="stylesheet" href="test.css"><script type="module" src="/raconteur-player.js"></script>
      <body>${body.replaceAll('<raconteur-player', `<raconteur-player backend="${this.backend}" assets="/assets/"${speech}`)}</body></html>`;
    const all: Files = { 'test.css': 'raconteur-player { width: 320px; height: 240px; aspect-ratio: auto } body { margin: 0 }', ...files };
    await this.page.route('**/test/**', (route) => {
      const path = new URL(route.request().url()).pathname.replace(/^\/test\//, '');
      if (path === '') return route.fulfill({ body: html, contentType: 'text/html', headers: isStrict ? { 'Content-Security-Policy': policy } : {} });
      const file = all[path];
      if (file === undefined) return route.fulfill({ status: 404, body: 'not here' });
      // Browsers seek in a sound by asking for its parts.
      const [, from, to] = /^bytes=(\d+)-(\d*)$/.exec(route.request().headers()['range'] ?? '') ?? [];
      if (from !== undefined && Buffer.isBuffer(file)) {
        const end = to ? Number(to) + 1 : file.length;
        return route.fulfill({
          status: 206,
          body: file.subarray(Number(from), end),
          headers: { 'Content-Range': `bytes ${from}-${end - 1}/${file.length}`, 'Content-Type': 'audio/wav' },
        });
      }
      return route.fulfill({ body: file, contentType: path.endsWith('.css') ? 'text/css' : 'application/octet-stream' });
    });
    // Files of a test have no network address, so Chromium asks for permission before they reach a
    // server on this machine.
    if (peer !== '') await this.page.context().grantPermissions(['local-network-access']);
    await this.page.goto('/test/');
  }

  /** Opens one player on a story of the library and waits until it is loaded. */
  async load(story: string, attributes = 'controls captions'): Promise<void> {
    await this.open(`<raconteur-player src="/assets/stories/${story}/story.eml" ${attributes}></raconteur-player>`);
    await this.ready();
  }

  async ready(player = this.player): Promise<void> {
    await ready(player);
  }

  play(player = this.player): Promise<void> {
    return player.evaluate((p: RaconteurPlayer) => p.play());
  }

  pause(player = this.player): Promise<void> {
    return player.evaluate((p: RaconteurPlayer) => p.pause());
  }

  seek(secs: number, player = this.player): Promise<void> {
    return player.evaluate((p: RaconteurPlayer, t) => void (p.currentTime = t), secs);
  }

  time(player = this.player): Promise<number> {
    return player.evaluate((p: RaconteurPlayer) => p.currentTime);
  }

  /** Waits until the story has reached a time. */
  async until(secs: number, player = this.player): Promise<void> {
    await expect.poll(() => this.time(player), { timeout: 60_000 }).toBeGreaterThanOrEqual(secs);
  }

  /** Names of the recorded events, each once in a row. */
  async events(): Promise<string[]> {
    return await this.page.evaluate(() => window.record.events.map((e) => e.type).filter((t, i, all) => t !== all[i - 1]));
  }

  /** Returns the image without overlays: mean and spread of brightness, and the bytes for comparison. */
  async picture(player = this.player): Promise<{ spread: number; png: Buffer }> {
    // The fade-in of a new frame would look like movement.
    await this.page.waitForTimeout(700);
    const png = await player.locator('canvas').screenshot({ animations: 'disabled' });
    const spread = await difference(this.page, png, undefined);
    return { spread, png };
  }

  /** Returns the mean absolute difference of two images, 0 to 255. */
  difference(a: Buffer, b: Buffer): Promise<number> {
    return difference(this.page, a, b);
  }
}

/** Returns the mean absolute difference of an image from another, or from its own mean. */
async function difference(page: Page, a: Buffer, b: Buffer | undefined): Promise<number> {
  const urls = [a, ...(b ? [b] : [])].map((png) => `data:image/png;base64,${png.toString('base64')}`);
  return await page.evaluate(async (sources) => {
    const grey = await Promise.all(
      sources.map(async (src) => {
        const image = new Image();
        image.src = src;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext('2d');
        if (context === null) throw new Error('no 2d context');
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, image.width, image.height);
        return Float64Array.from({ length: data.length / 4 }, (_, i) => ((data[4 * i] ?? 0) + (data[4 * i + 1] ?? 0) + (data[4 * i + 2] ?? 0)) / 3);
      }),
    );
    const [first, second] = grey;
    if (first === undefined) throw new Error('no picture');
    const mean = first.reduce((s, x) => s + x, 0) / first.length;
    return first.reduce((s, x, i) => s + Math.abs(x - (second?.[i] ?? mean)), 0) / first.length;
  }, urls);
}

/** Option of a project: the rendering back end, or `page` for the pages, which choose their own. */
export interface BackendOption {
  backend: string;
}

/** Records the parts of the site that a spec visits in a context; the returned function checks that all of them are declared. */
export function watched(context: BrowserContext, file: string): () => void {
  const seen = new Set<string | undefined>();
  context.on('request', (request) => {
    const { hostname, pathname } = new URL(request.url());
    if (hostname === 'localhost' && ['document', 'script'].includes(request.resourceType())) seen.add(visitedAt(pathname));
  });
  return () => {
    const declared = visits()[basename(file)] ?? [];
    expect(
      [...seen].filter((name) => name !== undefined && !declared.includes(name)),
      'visited, and not declared in visits.json',
    ).toEqual([]);
  };
}

/** A test with a stage on the project's back end. */
export const test = base.extend<{ stage: Stage; visiting: undefined } & BackendOption>({
  // `npm test -- --changed` runs the specs that visit changed files: a spec may only visit what it
  // declares.
  visiting: [
    async ({ context }, use, { file }) => {
      const expectDeclared = watched(context, file);
      await use(undefined);
      expectDeclared();
    },
    { auto: true },
  ],
  backend: ['webgl', { option: true }],
  stage: async ({ page, backend }, use) => {
    await page.addInitScript(listen);
    const problems: string[] = [];
    page.on('pageerror', (error) => problems.push(error.message));
    await use(new Stage(page, backend));
    expect(problems).toEqual([]);
    expect(await page.evaluate(() => window.record.violations)).toEqual([]);
  },
});
