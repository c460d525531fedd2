/** Makes `<raconteur-player>` an element of the page. */

import { RaconteurPlayer } from './element.js';

/** Registers elements of this name as players. `library`: the default location of the asset library. */
export function register(library?: string): void {
  // Elements that stand in the page become players at once, so what they need is said before.
  if (library !== undefined) RaconteurPlayer.library = library;
  // Where pages are made ahead there are no elements yet.
  if (typeof customElements === 'undefined') return;
  if (customElements.get('raconteur-player') === undefined) customElements.define('raconteur-player', RaconteurPlayer);
}
