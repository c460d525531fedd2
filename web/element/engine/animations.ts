/** Texts of animations: fetched by name, each once for all players of a page. */

import { fetchBytes, type Credentials, type Fetching } from '../base/fetching.js';
import { SharedTasks } from '../base/shared.js';
import type { Engine } from '../base/engine.js';
import type { Story } from '../base/types.js';

/** Beyond this an animation is not read; the library's largest has 14 KB, files of avatars some megabytes. */
const MAX_BYTES = 32e6;
/** A story waits so long for its animations; then it begins, and takes them as they come. */
const PATIENCE_MS = 4000;
/** What comes within so long of another is taken with it: taking one reads the story again. */
const TOGETHER_MS = 500;

/** Texts by address. */
const shared = new SharedTasks<string>();

/** Where an animation is: a bare name in the library, a path in the story's folder; undefined for what reaches out of it. `FILE.glb#NAME` is one animation of several. */
export function addressOf(name: string, library: URL, story: URL): URL | undefined {
  if (/^[\w-]+$/.test(name)) return new URL(`animations/${name}.json`, library);
  const folder = new URL('./', story);
  const url = URL.canParse(name, folder.href) ? new URL(name, folder) : undefined;
  return url?.href.startsWith(folder.href) ? url : undefined;
}

/** The text of a clip; an animation of a glTF, GLB or VRM file is converted to one. */
async function fetchClip(url: URL, signal: AbortSignal, credentials: Credentials): Promise<string> {
  const fetching: Fetching = { what: 'The animation', most: MAX_BYTES, signal, credentials };
  const bytes = await fetchBytes(url, fetching);
  if (url.pathname.endsWith('.json')) return new TextDecoder().decode(bytes);
  const { convertAnimation } = await import('../face/avatar.js');
  const text = await convertAnimation(decodeURIComponent(url.hash.slice(1)), bytes);
  return text.length <= MAX_BYTES ? text : '';
}

const after = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

/** The animations that an engine wants, as far as they have come; of one story, until that is not wanted any more. */
export class Animations {
  /** Names of those that were handed over last. */
  provided: readonly string[] = [];
  /** What has come, by address; empty where it cannot be had, which the engine reports. The next story asks again. */
  readonly #texts = new Map<string, string>();
  readonly #coming = new Map<string, Promise<void>>();

  constructor(
    readonly library: URL,
    readonly story: URL,
    readonly signal: AbortSignal,
    readonly credentials: Credentials = 'same-origin',
  ) {}

  /** Hands over what has come; undefined when that is nothing. */
  provide(engine: Engine, eml: string): Story | undefined {
    const text = (name: string) => this.#texts.get(addressOf(name, this.library, this.story)?.href ?? '');
    const names = engine.wantedAnimations().filter((name) => text(name) !== undefined || addressOf(name, this.library, this.story) === undefined);
    this.provided = names;
    return names.length === 0
      ? undefined
      : engine.provideAnimations(
          eml,
          names,
          names.map((name) => text(name) ?? ''),
        );
  }

  /** Fetches what has not come; undefined when that is nothing. Settles when all has come, when the story is not wanted any more, or after a while: a story goes on without what does not come. */
  fetch(engine: Engine): Promise<unknown> | undefined {
    const missing = this.#missing(engine);
    return missing && Promise.race([Promise.all(missing), after(PATIENCE_MS)]);
  }

  /** As `fetch`; settles as soon as something has come, with what comes just then. */
  next(engine: Engine): Promise<unknown> | undefined {
    const missing = this.#missing(engine);
    return missing && Promise.race(missing).then(() => Promise.race([Promise.all(missing), after(TOGETHER_MS)]));
  }

  #missing(engine: Engine): readonly Promise<void>[] | undefined {
    if (this.signal.aborted) return undefined;
    const urls = engine.wantedAnimations().flatMap((name) => addressOf(name, this.library, this.story) ?? []);
    const missing = urls.filter((url) => !this.#texts.has(url.href));
    return missing.length === 0 ? undefined : missing.map((url) => this.#coming.get(url.href) ?? this.#begin(url));
  }

  #begin({ href }: URL): Promise<void> {
    const coming = shared
      .get(href, this.signal, (signal) => fetchClip(new URL(href), signal, this.credentials))
      .then(
        (text) => void this.#texts.set(href, text),
        () => void (this.signal.aborted || this.#texts.set(href, '')),
      )
      .then(() => void this.#coming.delete(href));
    this.#coming.set(href, coming);
    return coming;
  }
}
