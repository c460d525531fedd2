/** Fetches what a story needs, with errors that say in a sentence what is wrong. */

import { Animations } from './animations.js';
import { prepareFigure, type FigureFile } from './figure.js';
import { PlayerError } from './types.js';

/** Beyond this a story is not a story, and the page would freeze; the white rabbit has 20 KB. */
const MOST_STORY_BYTES = 16e6;
/** What a story has in which something is said, or in which a figure waits for lines. */
const SPEAKS = /<([\w.-]+:)?(voice-(text|say)\b|body\s*(\/>|>\s*<\/))/;
/** Figures have a budget of 3 MB; a user's own avatar may be larger. */
const MOST_FIGURE_BYTES = 100e6;

/** Everything that a story needs, as it came. */
export interface StoryFiles {
  readonly eml: string;
  /** Where the text is; the page, when it has no file. */
  readonly story: URL;
  /** The text of `voice/speech.json`; undefined when the story has no recorded voice. */
  readonly bundle: Uint8Array | undefined;
  readonly figure: FigureFile;
  /** Where the recordings lie. */
  readonly voiceFolder: URL;
  readonly animations: Animations;
  /** The text is not that of the file any more. */
  readonly edited?: boolean;
}

/** Receives how much of the work is done, 0 to 1. */
export type Progress = (share: number) => void;

/** Which story is to be fetched. */
export interface StoryWish {
  readonly src: string | undefined;
  /** Takes the file's place. */
  readonly text: string | undefined;
  /** Lines may come that the story's own text does not have. */
  readonly expectsLines: boolean;
}

/** A story's folder is where its file is; its voice lies in `voice/` beside it. Without a file it has no voice. */
export async function fetchStory(
  { src, text, expectsLines }: StoryWish,
  library: URL,
  figure: (eml: Promise<string>, progress: Progress) => Promise<FigureFile>,
  signal: AbortSignal,
  progress: Progress,
): Promise<StoryFiles> {
  const story = new URL(src ?? '', document.baseURI);
  const voiceFolder = new URL('voice/', story);
  const shares = [text === undefined ? 0 : 1, src ? 0 : 1, 0];
  const weights = [0.1, 0.15, 0.75];
  const part = (i: number) => (share: number) => {
    shares[i] = share;
    progress(shares.reduce((sum, s, k) => sum + s * (weights[k] ?? 0), 0));
  };
  const told = text === undefined ? fetchBytes(story, 'The story', MOST_STORY_BYTES, signal, part(0)).then((bytes) => new TextDecoder().decode(bytes)) : Promise.resolve(text);
  const voice = async (): Promise<Uint8Array | undefined> => {
    // A story without speech has no recordings.
    if (!src || (!expectsLines && !SPEAKS.test(await told))) {
      part(1)(1);
      return undefined;
    }
    return await fetchBytes(new URL('speech.json', voiceFolder), 'The voice', MOST_STORY_BYTES, signal, part(1)).catch((error: unknown) => {
      // A story without a recorded voice plays with captions.
      if (error instanceof PlayerError) return undefined;
      throw error;
    });
  };
  const [eml, bundle, who] = await Promise.all([told, voice(), figure(told, part(2))]);
  signal.throwIfAborted();
  return { eml, story, bundle, figure: who, voiceFolder, animations: new Animations(library, story), edited: text !== undefined };
}

/** A bare name is a figure of the library; anything else is an address. */
function urlOfFigure(figure: string, library: URL): URL {
  return /^[\w-]+$/.test(figure) ? new URL(`figures/${figure}.glb`, library) : new URL(figure, document.baseURI);
}

/** Figures are the largest files and are shared by the players of a page. */
const figures = new Map<string, Promise<Uint8Array>>();

/** A figure by its name in the library or its address, or where it lies for certain. */
export async function fetchFigure(figure: string, library: URL, progress: Progress, url = urlOfFigure(figure, library)): Promise<FigureFile> {
  return await prepareFigure(figure, shown(url), await fetchShared(url, progress));
}

/** A file of the user's own. */
export async function readFigure(file: File): Promise<FigureFile> {
  if (file.size > MOST_FIGURE_BYTES) throw tooLarge('The figure', MOST_FIGURE_BYTES);
  return await prepareFigure(file.name, file.name, new Uint8Array(await file.arrayBuffer()));
}

function fetchShared(url: URL, progress: Progress): Promise<Uint8Array> {
  let bytes = figures.get(url.href);
  if (bytes === undefined) {
    // Not tied to one player's signal: another may be waiting for it.
    bytes = fetchBytes(url, 'The figure', MOST_FIGURE_BYTES, undefined, progress);
    figures.set(url.href, bytes);
    bytes.catch(() => figures.delete(url.href));
  }
  return bytes.then((done) => {
    progress(1);
    return done;
  });
}

const shown = (url: URL): string => (url.origin === location.origin ? url.pathname : url.href);
const tooLarge = (what: string, most: number) => new PlayerError(`${what} is larger than ${Math.round(most / 1e6)} MB and was not read.`);

async function fetchBytes(url: URL, what: string, most: number, signal: AbortSignal | undefined, progress: Progress): Promise<Uint8Array> {
  const where = shown(url);
  let response: Response;
  try {
    response = await fetch(url, signal ? { signal } : {});
  } catch (error) {
    signal?.throwIfAborted();
    throw new PlayerError(`${what} could not be fetched from ${where}: is the network there?`, { cause: error });
  }
  if (response.status === 404) throw new PlayerError(`${what} was not found at ${where}.`);
  if (!response.ok) throw new PlayerError(`${what} could not be fetched from ${where}: the server answered ${response.status}.`);
  return await readAll(response, what, most, progress);
}

async function readAll(response: Response, what: string, most: number, progress: Progress): Promise<Uint8Array> {
  const expected = Number(response.headers.get('content-length')) || 0;
  if (expected > most) throw tooLarge(what, most);
  if (response.body === null) return new Uint8Array(await response.arrayBuffer());
  const chunks: Uint8Array[] = [];
  let length = 0;
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    chunks.push(value);
    length += value.length;
    if (length > most) {
      void reader.cancel();
      throw tooLarge(what, most);
    }
    // The length counts compressed bytes, so it may be passed.
    if (expected > 0) progress(Math.min(1, length / expected));
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const chunk of chunks) {
    all.set(chunk, at);
    at += chunk.length;
  }
  progress(1);
  return all;
}
