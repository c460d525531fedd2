/** The way to a face model, for pages that want one. */

import type { Progress } from '../base/fetching.js';
import type { Faces } from './faces.js';
import { PlayerError } from '../base/types.js';

/** Fetches what edits faces, a pack's shapes, and its textures where they are named. */
export async function openFaces(shapes: string | URL, textures?: string | URL, options?: { readonly signal?: AbortSignal; readonly progress?: Progress }): Promise<Faces> {
  const part = await import('./faces.js').catch((error: unknown) => {
    throw new PlayerError('The part that edits faces could not be fetched: is the network available?', { cause: error });
  });
  const url = (address: string | URL): URL => new URL(address, document.baseURI);
  return await part.Faces.open(url(shapes), textures === undefined ? undefined : url(textures), options);
}
