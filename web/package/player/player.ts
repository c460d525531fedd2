/** Entry point of `@raconteur/player`: importing it registers `<raconteur-player>`, in environments with custom elements. */

import { register } from '../../element/register.js';

export { addSpeechSource, speechServer } from '../../speech/added.js';
export type { ServerVoice, SpeechServer } from '../../speech/server.js';
export type { Said, Saying, SpeechReceiver, SpeechRequest, SpeechSource, SpokenAudio } from '../../speech/source.js';
export { RaconteurPlayer } from '../../element/element.js';
export type { ElementEventMap, MediaEventMap, PlayerEventMap } from '../../element/base/events.js';
export type { FaceConstraint, FacePack, FacePart, FaceRegion, Faces } from '../../element/face/faces.js';
export { openFaces } from '../../element/face/open-faces.js';
export * from '../../element/base/types.js';

// A page specifies the location of the library with the attribute `assets`.
register();
