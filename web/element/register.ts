/** Makes `<raconteur-player>` an element of the page. */

import { RaconteurPlayer } from './element.js';

/** Registers elements of this name as players. `library`: the default location of the asset library. */
export function register(library?: string): void {
  // Elements already in the page are upgraded immediately, so their settings come first.
  if (library !== undefined) RaconteurPlayer.library = library;
  // On a server that renders pages there are no custom elements.
  if (typeof customElements === 'undefined') return;
  if (customElements.get('raconteur-player') === undefined) customElements.define('raconteur-player', RaconteurPlayer);
}
