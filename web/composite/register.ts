/** Makes `<raconteur-composite>` an element of the page, with the player that it uses. */

import { register as registerPlayer } from '../element/register.js';
import { RaconteurComposite } from './element.js';

/** Registers the editor element under this name. `library`: default location of the asset library. */
export function register(library?: string): void {
  registerPlayer(library);
  // Elements already in the page are upgraded immediately, so their settings come first.
  if (library !== undefined) RaconteurComposite.library = library;
  if (customElements.get('raconteur-composite') === undefined) customElements.define('raconteur-composite', RaconteurComposite);
}
