/** Entry module for pages that embed the composite editor: registers `<raconteur-composite>` and `<raconteur-player>`. */

import { register } from './register.js';

export { RaconteurPlayer } from '../element/element.js';
export type { Faces } from '../element/face/faces.js';
export { RaconteurComposite, type CompositeEventMap } from './element.js';
export type { Saved, SavedHistory } from './history.js';

// The library is next to the script, like that of the player. No other module may import this file,
// because it would then be bundled into a script in another folder.
const script = import.meta.url;
register(new URL('assets/', script).href);
