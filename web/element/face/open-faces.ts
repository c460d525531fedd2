/** Entry point to face models, for pages that use them. */

import type { Progress } from '../base/fetching.js';
import type { Faces } from './faces.js';
import { PlayerError } from '../base/types.js';

/** Fetches the face editor, a pack's shapes, and its textures if given. */
export async function openFaces(shapes: string | URL, textures?: string | URL, options?: { readonly signal?: AbortSignal; readonly progress?: Progress }): Promise<Faces> {
  const part = await import('./faces.js').catch((error: unknown) => {
    throw new PlayerError('The part that edits faces could not be fetched: is the network available?', { cause: error });
  });
  const url = (address: string | URL): URL => new URL(address, document.baseURI);
  return await part.Faces.open(url(shapes), textures === undefined ? undefined : url(textures), options);
}
