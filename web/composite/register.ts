/** Makes `<raconteur-composite>` an element of the page, with the player that it uses. */

import { register as registerPlayer } from '../element/register.js';
import { RaconteurComposite } from './element.js';

/** Makes elements of this name editors. `library`: where the asset library is for those that do not say. */
export function register(library?: string): void {
  registerPlayer(library);
  // Elements that stand in the page become editors at once, so what they need is said before.
  if (library !== undefined) RaconteurComposite.library = library;
  if (customElements.get('raconteur-composite') === undefined) customElements.define('raconteur-composite', RaconteurComposite);
}
