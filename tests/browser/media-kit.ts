/** Questions evaluated in the page, identically for a media element of the browser and for the player. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { story, voiceFiles } from './fixture.js';
import type { Stage } from './stage.js';

/** The common interface. */
export type Media = HTMLMediaElement | RaconteurPlayer;

export type Tag = 'audio' | 'video' | 'raconteur-player';

/** Environment of a question. */
export interface Kit<M = Media> {
  readonly media: M;
  readonly tag: Tag;
  /** Two playable sources, of one and a half seconds, and a missing one. */
  readonly good: string;
  readonly other: string;
  readonly absent: string;
  /** A MIME type that it can play. */
  readonly type: string;
  /** A speed out of range. */
  readonly fast: number;
  /** Creates another element of the kind, outside any document. */
  make(): M;
  /** Gives `media` a source and waits until it can play through. */
  loaded(): Promise<void>;
  /** Returns the outcome of a promise: nothing or the error's name. */
  settle(promise: Promise<unknown> | undefined): Promise<string>;
  /** Returns the name of the exception that `work` throws. */
  thrown(work: () => void): string;
  event(type: string): Promise<unknown>;
  /** Returns the names of the events since the last call, without the periodic ones. */
  events(): string[];
  /** Returns a list that collects the names of all events of some types from now on. */
  follow(...types: string[]): string[];
  wait(ms: number): Promise<void>;
  /** Waits until a condition is true, three seconds at most; returns its value. */
  until(isSo: () => boolean): Promise<boolean>;
}

/** A question; it runs in the page, without access to the test's file. */
export type Question = (kit: never, given: never) => unknown;

declare global {
  interface Window {
    makeKit(tag: Tag, backend: string): Kit;
    /** Address of the source of a `<video>`, if it must have an image. */
    film?: string;
    questions: { [name: string]: (kit: Kit, given: unknown) => unknown };
  }
}

/** Runs in the page, and so has all it needs inside. */
function makeKit(tag: Tag, backend: string): Kit {
  const ours = tag === 'raconteur-player';
  const make = (): Media => {
    const media = document.createElement(tag) as Media;
    const attributes = ours ? { backend, loading: 'eager', assets: '/assets/', quality: 'lowest' } : {};
    for (const [name, value] of Object.entries(attributes)) media.setAttribute(name, value);
    return media;
  };
  const media = make();
  if (!ours) media.preload = 'auto';
  const told: string[] = [];
  const loads = ['loadstart', 'loadedmetadata', 'loadeddata', 'canplay', 'canplaythrough', 'emptied', 'abort', 'error'];
  for (const type of [...loads, 'play', 'playing', 'pause', 'ended', 'seeking', 'seeked', 'ratechange']) {
    // A browser fires `canplay` after each seek.
    media.addEventListener(type, () => told.push(type), { once: type.startsWith('canplay') });
  }
  const event = (type: string) => new Promise((done) => media.addEventListener(type, done, { once: true }));
  const wait = (ms: number) => new Promise<void>((done) => setTimeout(done, ms));
  const [file, absent] = ours ? ['story.eml', 'absent/story.eml'] : ['voice/u0.wav', 'absent.wav'];
  const good = (tag === 'video' && window.film) || `good/${file}`;
  return {
    media,
    tag,
    good,
    other: `other/${file}`,
    absent,
    type: ours ? 'application/eml+xml' : 'audio/wav',
    fast: ours ? 9 : 99,
    make,
    loaded: async () => {
      const there = event('canplaythrough');
      media.src = good;
      await there;
    },
    settle: async (promise) =>
      await Promise.resolve(promise).then(
        () => 'kept',
        (error: Error) => error.name,
      ),
    thrown: (work) => {
      try {
        work();
        return 'nothing';
      } catch (error) {
        return (error as Error).name;
      }
    },
    event,
    events: () => told.splice(0),
    follow: (...types) => {
      const seen: string[] = [];
      for (const type of types) media.addEventListener(type, () => seen.push(type));
      return seen;
    },
    wait,
    until: async (isSo) => {
      for (let i = 0; i < 150 && !isSo(); i++) await wait(20);
      return isSo();
    },
  };
}

/** Opens a page with the questions, and with sources for both kinds; it is faster without rendering. `isStrict`: with the policy of the production page. */
export async function openKit(
  stage: Stage,
  questions: { readonly [name: string]: Question },
  { hasPicture, isStrict = true }: { hasPicture: boolean; isStrict?: boolean },
): Promise<void> {
  const { page } = stage;
  const made = [{ text: 'One two three', msec: 1500, samples: new Float32Array(66_150) }];
  const files = { ...voiceFiles(made), 'story.eml': story("<voice-text time='0'>One two three</voice-text>") };
  const both = ['good', 'other'].flatMap((folder) => Object.entries(files).map(([path, file]) => [`${folder}/${path}`, file] as const));
  if (!hasPicture) await page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
  const written = Object.entries(questions).map(([name, question]) => `${JSON.stringify(name)}: ${question}`);
  await page.addInitScript({ content: `window.makeKit = ${makeKit}; window.questions = {${written.join(',\n')}};` });
  await stage.open('<main></main>', { 'test.css': 'main * { width: 48px; height: 48px; aspect-ratio: auto }', ...Object.fromEntries(both) }, '', isStrict);
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  // A click allows sound.
  await page.mouse.click(300, 300);
}

/** Asks a question of one kind of element; reports an answer that does not arrive in time. */
export async function ask(
  page: Page,
  tag: Tag,
  { name, backend, given, limitMs = 100_000 }: { name: string; backend: string; given?: unknown; limitMs?: number },
): Promise<unknown> {
  return await page.evaluate(
    async ([tag, backend, name, given, limitMs]) => {
      const main = document.querySelector('main');
      const kit = window.makeKit(tag, backend);
      main?.replaceChildren(kit.media);
      // A media element exists immediately; the player renders once first.
      await (kit.media as RaconteurPlayer).updateComplete;
      const late = new Promise((done) => setTimeout(done, limitMs, `no answer in ${limitMs} ms`));
      const asked = (async () => await window.questions[name]?.(kit, given))().catch((error: Error) => `${error.name}: ${error.message}`);
      const answer = await Promise.race([asked, late]);
      kit.media.pause();
      main?.replaceChildren();
      if (document.pictureInPictureElement !== null) await document.exitPictureInPicture();
      return JSON.parse(JSON.stringify(answer ?? null, (_, value: unknown) => (value instanceof Node ? value.nodeName : value))) as unknown;
    },
    [tag, backend, name, given ?? null, limitMs] as const,
  );
}

/** Records one second of image and audio for the page's `<video>` elements, since no file of the tests has both. */
export async function makeFilm(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 48 });
    const paint = canvas.getContext('2d');
    const audio = new AudioContext();
    const sound = audio.createMediaStreamDestination();
    audio.createOscillator().connect(sound);
    await audio.resume();
    const stream = canvas.captureStream(25);
    for (const track of sound.stream.getAudioTracks()) stream.addTrack(track);
    const recorder = new MediaRecorder(stream, { mimeType: 'video/webm' });
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const over = new Promise((done) => (recorder.onstop = done));
    recorder.start();
    for (let i = 0; i < 40; i++) {
      paint?.fillRect(i, i, 8, 8);
      await new Promise((done) => setTimeout(done, 40));
    }
    recorder.stop();
    await over;
    await audio.close();
    window.film = URL.createObjectURL(new Blob(parts, { type: 'video/webm' }));
  });
}
