/** Fetches animations that a story plays: of the library by name, of its own folder by path. */

import { PlayerError } from './types.js';

/** Sampled animations of some minutes. */
const MOST_BYTES = 32e6;

/** The text of an animation; undefined where it cannot be had. */
export type AnimationSource = (name: string) => Promise<string | undefined>;

/** Shared by the players of a page. */
const texts = new Map<string, Promise<string | undefined>>();

/** A bare name is a file of the library; anything else is a path in the story's folder, which it does not leave. `FILE.glb#NAME` is one animation of several. */
export function urlOfAnimation(name: string, library: URL, folder: URL): URL | undefined {
  if (/^[\w-]+$/.test(name)) return new URL(`animations/${name}.json`, library);
  try {
    const url = new URL(name, folder);
    return url.href.startsWith(folder.href) ? url : undefined;
  } catch {
    return undefined;
  }
}

/** Where the animations of a story in `folder` come from; both addresses end in a slash. */
export function animationSource(library: URL, folder: URL): AnimationSource {
  return async (name) => {
    const url = urlOfAnimation(name, library, folder);
    if (url === undefined) return undefined;
    let text = texts.get(url.href);
    if (text === undefined) {
      text = fetchText(url).catch(() => {
        // The network may come back.
        texts.delete(url.href);
        return undefined;
      });
      texts.set(url.href, text);
    }
    return await text;
  };
}

async function fetchText(url: URL): Promise<string | undefined> {
  const response = await fetch(url);
  if (!response.ok) return undefined;
  if (Number(response.headers.get('content-length')) > MOST_BYTES) throw new PlayerError('The animation is too large.');
  if (url.pathname.endsWith('.json')) return await response.text();
  const { convertAnimation } = await import('./avatar.js');
  return await convertAnimation(decodeURIComponent(url.hash.slice(1)), new Uint8Array(await response.arrayBuffer()));
}
