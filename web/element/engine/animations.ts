/** Texts of animations: fetched by name, each once for all players of a page. */

import { fetchBytes, type Credentials, type Fetching } from '../base/fetching.js';
import { SharedTasks } from '../base/shared.js';
import type { Engine } from '../base/engine.js';
import type { Story } from '../base/types.js';

/** Beyond this an animation is not read; the library's largest has 14 KB, files of avatars some megabytes. */
const MAX_BYTES = 32e6;
/** Maximum time that a story waits for its animations, milliseconds; then it starts, and takes them as they arrive. */
const PATIENCE_MS = 4000;
/** Time within which arriving animations are handed over together, milliseconds, since each hand-over reads the story again. */
const TOGETHER_MS = 500;

/** Texts by address. */
const shared = new SharedTasks<string>();

/**
 * Returns the address of an animation: a bare name in the library, a path in the story's folder; undefined for a path outside it. `FILE.glb#NAME` is one
 * animation of several.
 */
export function addressOf(name: string, library: URL, story: URL): URL | undefined {
  if (/^[\w-]+$/.test(name)) return new URL(`animations/${name}.json`, library);
  const folder = new URL('./', story);
  const url = URL.canParse(name, folder.href) ? new URL(name, folder) : undefined;
  return url?.href.startsWith(folder.href) ? url : undefined;
}

/** Fetches the text of a clip; converts an animation of a glTF, GLB or VRM file to one. */
async function fetchClip(url: URL, signal: AbortSignal, credentials: Credentials): Promise<string> {
  const fetching: Fetching = { what: 'The animation', most: MAX_BYTES, signal, credentials };
  const bytes = await fetchBytes(url, fetching);
  if (url.pathname.endsWith('.json')) return new TextDecoder().decode(bytes);
  const { convertAnimation } = await import('../face/avatar.js');
  const text = await convertAnimation(decodeURIComponent(url.hash.slice(1)), bytes);
  return text.length <= MAX_BYTES ? text : '';
}

const after = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

/** Animations that an engine needs, as far as loaded; of one story, until it is no longer needed. */
export class Animations {
  /** Names of those that were handed over last. */
  provided: readonly string[] = [];
  /** Loaded texts, by address; empty if unavailable, which the engine reports. The next story requests them again. */
  readonly #texts = new Map<string, string>();
  readonly #coming = new Map<string, Promise<void>>();

  constructor(
    readonly library: URL,
    readonly story: URL,
    readonly signal: AbortSignal,
    readonly credentials: Credentials = 'same-origin',
  ) {}

  /** Hands over the loaded animations; returns undefined if there are none. */
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

  /**
   * Fetches the missing animations; returns undefined if there are none. Settles when all have arrived, when the story is no longer needed, or after a time
   * limit: a story continues without missing ones.
   */
  fetch(engine: Engine): Promise<unknown> | undefined {
    const missing = this.#missing(engine);
    return missing && Promise.race([Promise.all(missing), after(PATIENCE_MS)]);
  }

  /** Fetches like `fetch`; settles as soon as one has arrived, together with others that arrive shortly after. */
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
