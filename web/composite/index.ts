/** Entry module for pages that embed the composite editor: registers `<raconteur-composite>` and `<raconteur-player>`. */

import { register } from './register.js';

export { RaconteurPlayer } from '../element/element.js';
export type { Faces } from '../element/face/faces.js';
export { RaconteurComposite, type CompositeEventMap } from './element.js';
export type { Saved, SavedHistory } from './history.js';

// The library lies beside the script, as that of the player's does, and nothing else may import this file for the same reason.
const script = import.meta.url;
register(new URL('assets/', script).href);
