/** Entry point for pages: registers `<raconteur-player>` and re-exports its types. */

import { register } from './register.js';

export { addSpeechSource, speechServer } from '../speech/added.js';
export { naturalVoice } from '../speech/natural.js';
export type { ServerVoice, SpeechServer } from '../speech/server.js';
export type { Said, Saying, SpeechReceiver, SpeechRequest, SpeechSource, SpokenAudio } from '../speech/source.js';
export { RaconteurPlayer } from './element.js';
export type { Answered, Score } from './base/answers.js';
export type { LessonState } from './lesson/lesson.js';
export type { ElementEventMap, MediaEventMap, PlayerEventMap } from './base/events.js';
export type { Part } from './media/text-tracks.js';
export { openFaces } from './face/open-faces.js';
export type { FaceConstraint, FacePack, FacePart, FaceRegion, Faces } from './face/faces.js';
export { PlayerError } from './base/types.js';
export type { FaceCourse, FigureFace } from './base/face-types.js';
export type { Cue } from './base/performance.js';
export type { FlowEntry, Question, QuestionKind, QuestionOption, Way } from './base/questions.js';
export type { AudioFile, Backend, Diagnostic, Hand, Place, Quality, Statistics, Story, Utterance, View, Word } from './base/types.js';

// The library is next to the script. The URL is in a variable, so that the build leaves the folder
// alone. No other module may import this file, because it would then be bundled into a script in
// another folder.
const script = import.meta.url;
register(new URL('assets/', script).href);
