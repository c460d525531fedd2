/** Texts of animations: fetched by name, each once for all players of a page. */

import type { Engine, Story } from './types.js';

/** Beyond this an animation is not read; the library's largest has 14 KB, files of avatars some megabytes. */
const MOST_BYTES = 32e6;

/** Texts by address; an empty one could not be had. */
const texts = new Map<string, string>();
const coming = new Map<string, Promise<void>>();

/** Where an animation is: a bare name in the library, a path in the story's folder; undefined for what reaches out of it. `FILE.glb#NAME` is one animation of several. */
export function addressOf(name: string, library: URL, story: URL): URL | undefined {
  if (/^[\w-]+$/.test(name)) return new URL(`animations/${name}.json`, library);
  const folder = new URL('./', story);
  const url = URL.canParse(name, folder.href) ? new URL(name, folder) : undefined;
  return url?.href.startsWith(folder.href) ? url : undefined;
}

async function fetchText(url: URL): Promise<void> {
  let text = '';
  try {
    const response = await fetch(url);
    const fits = response.ok && Number(response.headers.get('content-length') ?? 0) <= MOST_BYTES;
    if (fits) text = url.pathname.endsWith('.json') ? await response.text() : await converted(url, response);
  } catch {
    // The engine reports it as missing.
  }
  texts.set(url.href, text.length <= MOST_BYTES ? text : '');
  coming.delete(url.href);
}

/** An animation of a glTF, GLB or VRM file as the text of a clip. */
async function converted(url: URL, response: Response): Promise<string> {
  const { convertAnimation } = await import('./avatar.js');
  return await convertAnimation(decodeURIComponent(url.hash.slice(1)), new Uint8Array(await response.arrayBuffer()));
}

/** The animations that an engine wants, as far as they have come. */
export class Animations {
  /** Names of those that were handed over last. */
  provided: readonly string[] = [];

  constructor(
    readonly library: URL,
    readonly story: URL,
  ) {}

  /** Hands over what has come; undefined when that is nothing. */
  provide(engine: Engine, eml: string): Story | undefined {
    const text = (name: string) => texts.get(addressOf(name, this.library, this.story)?.href ?? '');
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

  /** Fetches what has not come; undefined when that is nothing. */
  fetch(engine: Engine): Promise<unknown> | undefined {
    const urls = engine.wantedAnimations().flatMap((name) => addressOf(name, this.library, this.story) ?? []);
    const missing = urls.filter((url) => !texts.has(url.href));
    if (missing.length === 0) return undefined;
    for (const url of missing) if (!coming.has(url.href)) coming.set(url.href, fetchText(url));
    return Promise.all(missing.map((url) => coming.get(url.href)));
  }
}
