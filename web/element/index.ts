/** What a page imports: registers `<raconteur-player>` and hands on its types. */

import { RaconteurPlayer } from './element.js';

export { RaconteurPlayer };
export { PlayerError } from './types.js';
export type { AudioFile, Backend, Cue, Diagnostic, FaceCourse, Hand, Place, PlayerEventMap, Quality, Statistics, Story, Utterance, View, Word } from './types.js';

if (customElements.get('raconteur-player') === undefined) customElements.define('raconteur-player', RaconteurPlayer);
