/** Fetches the files of a story, with one-sentence error messages. */

import { Animations } from './animations.js';
import type { Script } from './backend.js';
import { fetchBytes, shown, tooLarge, type Credentials, type Progress } from '../base/fetching.js';
import { prepareFigure, type FigureFile } from './figure.js';
import { SharedTasks } from '../base/shared.js';
import { PlayerError, type Diagnostic } from '../base/types.js';

/** Beyond this a story is not a story, and the page would freeze; the white rabbit has 20 KB. */
const MAX_STORY_BYTES = 16e6;
/** Pattern of a story that contains speech, or whose figure waits for lines. */
const SPEAKS = /<([\w.-]+:)?(voice-(text|say)\b|body\s*(\/>|>\s*<\/))/;
/** Figures have a budget of 3 MB; a user's own avatar may be larger. */
const MAX_FIGURE_BYTES = 100e6;

/** All fetched files of a story. */
export interface StoryFiles {
  readonly eml: string;
  /** Encoding problem of its file. */
  readonly problem?: Diagnostic | undefined;
  /** Default language: that of the page, a BCP 47 tag. */
  readonly language: string;
  /** Address of the text; the page, if it has no file. */
  readonly story: URL;
  /** The text of `voice/speech.json`; undefined when the story has no recorded voice. */
  readonly bundle: Uint8Array | undefined;
  readonly figure: FigureFile;
  /** Folder of the recordings. */
  readonly voiceFolder: URL;
  readonly animations: Animations;
  /** The text is not that of the file any more. */
  readonly edited?: boolean;
}

/** Abort signal and progress listener of a request. */
export interface RequestedFiles {
  readonly signal: AbortSignal;
  readonly progress: Progress;
  readonly credentials?: Credentials;
}

/** Story to fetch. */
export interface StoryRequest {
  readonly src: string | undefined;
  /** Text that replaces the file. */
  readonly text: string | undefined;
  /** True if it is being edited, and differs from the page's original. */
  readonly edited: boolean;
  readonly language: string;
  /** True if lines may be added that the story's own text does not contain. */
  readonly expectsLines: boolean;
  readonly credentials: Credentials;
}

/** Fetches a story. Its folder is that of its file; its voice is in `voice/` next to it. Without a file it has no voice. */
export async function fetchStory(
  { src, text, edited, language, expectsLines, credentials }: StoryRequest,
  library: URL,
  decode: (bytes: Uint8Array) => Promise<Script>,
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
  const script =
    text === undefined ? fetchBytes(story, { what: 'The story', most: MAX_STORY_BYTES, signal, credentials, progress: part(0) }).then(decode) : Promise.resolve<Script>({ text });
  const told = script.then((script) => script.text);
  const voice = async (): Promise<Uint8Array | undefined> => {
    // A story without speech has no recordings.
    if (!src || (!expectsLines && !SPEAKS.test(await told))) {
      part(1)(1);
      return undefined;
    }
    return await fetchBytes(new URL('speech.json', voiceFolder), { what: 'The voice', most: MAX_STORY_BYTES, signal, credentials, progress: part(1) }).catch((error: unknown) => {
      // A story without a recorded voice plays with captions.
      if (error instanceof PlayerError) return undefined;
      throw error;
    });
  };
  const [{ text: eml, problem }, bundle, who] = await Promise.all([script, voice(), figure(told, part(2))]);
  signal.throwIfAborted();
  return { eml, problem, language, story, bundle, figure: who, voiceFolder, animations: new Animations(library, story, signal, credentials), edited };
}

/** Returns the address of a figure: a bare name is a figure of the library; anything else is an address. */
function urlOfFigure(figure: string, library: URL): URL {
  return /^[\w-]+$/.test(figure) ? new URL(`figures/${figure}.glb`, library) : new URL(figure, document.baseURI);
}

/** Figures are the largest files and are shared by the players of a page. */
const figures = new SharedTasks<Uint8Array>();

/** Fetches a figure by its name in the library or its address, or from a known location. */
export async function fetchFigure(figure: string, library: URL, wanted: RequestedFiles, url = urlOfFigure(figure, library)): Promise<FigureFile> {
  const { signal, progress, credentials } = wanted;
  const bytes = await figures.get(url.href, signal, (signal) => fetchBytes(url, { what: 'The figure', most: MAX_FIGURE_BYTES, signal, credentials, progress }));
  progress(1);
  return await prepareFigure(figure, shown(url), bytes);
}

/** Reads a figure from a file of the user's own. */
export async function readFigure(file: File): Promise<FigureFile> {
  if (file.size > MAX_FIGURE_BYTES) throw tooLarge('The figure', MAX_FIGURE_BYTES);
  return await prepareFigure(file.name, file.name, new Uint8Array(await file.arrayBuffer()));
}
