/** What the element, the engine and a page tell each other. All times are seconds. */

import type { Question, FlowEntry } from './questions.js';

/** Something wrong with a story, its voice or its figure. The rest of the story plays. */
export interface Diagnostic {
  /** A stable short name, for example `unknown-hand-shape`. */
  readonly code: string;
  readonly severity: 'error' | 'warning';
  readonly message: string;
  /** What to do about it, each a sentence. */
  readonly hints: readonly string[];
  /** Where in the story; absent when it is not about the story's text. */
  readonly start?: Place;
  /** The end of the span, exclusive. */
  readonly end?: Place;
}

/** A place in the story's text. */
export interface Place {
  /** From 1. */
  readonly line: number;
  /** From 1, in characters, as people count. */
  readonly column: number;
  /** From 1, in UTF-16 units, as JavaScript and editors count. */
  readonly columnUtf16: number;
}

/** One spoken word; times are of the story. */
export interface Word {
  /** As written, punctuation attached. */
  readonly text: string;
  readonly startSecs: number;
  readonly endSecs: number;
  /** The story emphasises it. */
  readonly emphasized: boolean;
}

/** One encoding of an utterance's sound. */
export interface AudioFile {
  /** Plain name in the story's `voice` folder. */
  readonly file: string;
  /** MIME type with codecs. */
  readonly mime: string;
}

/** Something said, at its place in the story. */
export interface Utterance {
  readonly startSecs: number;
  readonly durationSecs: number;
  /** In order of preference; empty when there is no recording. */
  readonly audio: readonly AudioFile[];
  readonly words: readonly Word[];
  /** The times were guessed because no recording was found. */
  readonly estimated: boolean;
  /** It was interrupted: it ends before its recording does. */
  readonly cut?: boolean;
  /** BCP 47 tag, where the bundle or the story's markup tells it. */
  readonly language?: string;
  /** Name of the voice that the story asks for here; absent where it is the story's own. */
  readonly voice?: string;
}

/** Whom a story chooses to perform it. */
export interface Performer {
  /** A name of the library, or a file in the story's folder. */
  readonly figure?: string;
  /** Name of a voice, of the browser or of those who bake. */
  readonly voice?: string;
  /** BCP 47 tag. */
  readonly language?: string;
}

/** A story that was read. */
export interface Story {
  readonly performer: Performer;
  readonly questions: readonly Question[];
  readonly ways: readonly FlowEntry[];
  readonly durationSecs: number;
  readonly utterances: readonly Utterance[];
  readonly diagnostics: readonly Diagnostic[];
}

/** How camera, light and music express what is felt. */
export interface EnvironmentExpression {
  /** The strongest emotion; `neutral` where nothing is felt. */
  readonly emotion: string;
  /** How strong the events are that elicit it, 0 to 10. */
  readonly potential: number;
  /** How strong it is just now, 0 to 10. */
  readonly intensity: number;
  readonly shot: 'extremeCloseUp' | 'closeUp' | 'medium' | 'storyteller' | 'full' | 'long';
  readonly angle: 'eye' | 'high' | 'low';
  /** The colour of the key light that the emotion asks for, sRGB, 0 to 255. */
  readonly color: readonly [number, number, number];
  /** What the key light loses by the emotion, 0 to 1. */
  readonly attenuation: number;
  /** How bright the key light is against the stage's own. */
  readonly brightness: number;
  /** How good the mood is, usually -10 to 10. */
  readonly valence: number;
  /** How active, likewise. */
  readonly arousal: number;
  /** The files of the music that is heard. */
  readonly music: readonly string[];
}

/** A piece of music at its place in the story. */
export interface Piece {
  readonly startSecs: number;
  /** When it has become silent; may be infinite. */
  readonly endSecs: number;
  /** Path from the story's folder, or from `music/` of the asset library. An `.opus` may have an `.mp3` beside it. */
  readonly file: string;
  readonly library: boolean;
  /** It begins again when it is over. */
  readonly loops: boolean;
  /** How loud it is at story times; straight between them. */
  readonly level: readonly (readonly [atSecs: number, level: number])[];
}

/** Plain text, at once or in pieces. */
export type Words = string | AsyncIterable<string> | ReadableStream<string>;

/** A text that is being told. */
export interface NarrationHandle {
  /** Everything has been said, or it was interrupted; rejects with the error of the words' source, when what came before it has been said. */
  readonly done: Promise<void>;
  /** Says no more, as `interrupt()` of the player. */
  interrupt(): void;
}

/** Whether a mind listens. */
export type MindState = 'connecting' | 'open' | 'closed';

/** From where a page looks that looks behind the scenes: at the whole figure, unless it comes nearer. */
export interface View {
  /** How far around the figure, radians; positive to its left. */
  readonly turn: number;
  /** From how far above, radians. */
  readonly tilt: number;
  /** How many times nearer. */
  readonly zoom: number;
  /** How far the middle of the picture is moved to the right, metres. */
  readonly right: number;
  /** How far it is moved up, metres. */
  readonly up: number;
}

/** Joints, targets and camera of the moment shown last, as numbers; `readPose` of `pose.ts` decodes them. */
export interface PoseNumbers {
  /** Of the joints, then of the manipulators. */
  readonly names: readonly string[];
  readonly numbers: Float32Array;
}

/** A hand of the character. */
export type Hand = 'left' | 'right';

/** How much work goes into a picture. */
export type Quality = 'auto' | 'lowest' | 'low' | 'medium' | 'high';

/** What one picture took. */
export interface PictureStatistics {
  /** The graphics adapter's own name, where the browser tells it. */
  readonly adapter: string;
  /** The tier in force. */
  readonly quality: string;
  readonly drawCalls: number;
  /** Those of the figure, its shadows included. */
  readonly figureDrawCalls: number;
  /** Drawn, all passes. */
  readonly triangles: number;
}

/** Figures about a player, for people who measure. */
export interface Statistics extends PictureStatistics {
  /** From the beginning of loading to the first picture. */
  readonly firstFrameMs: number;
  /** The files of story and figure, as they are after transport. */
  readonly bytes: { readonly story: number; readonly voice: number; readonly figure: number };
}

/** The two builds. */
export type Backend = 'webgpu' | 'webgl';

/** Why a story cannot be played, as one sentence for people; codes are those of `MediaError`. */
export class PlayerError extends Error {
  override readonly name = 'PlayerError';
  /** What is not there or cannot be read is, for a media element, not supported. */
  readonly code = 4;
  readonly MEDIA_ERR_ABORTED = 1;
  readonly MEDIA_ERR_NETWORK = 2;
  readonly MEDIA_ERR_DECODE = 3;
  readonly MEDIA_ERR_SRC_NOT_SUPPORTED = 4;
}

/** Lights of the stage. */
export type Light = 'stage' | 'daylight' | 'evening' | 'studio';

/** Where a learner is and what they have answered. */
export interface PlayerState {
  readonly placeSecs: number;
  /** What was answered. It and what follows may have gone through other hands since `state` told them. */
  readonly answered: unknown;
  /** The variables of the story. */
  readonly values?: unknown;
  /** What was set and is not set again. */
  readonly done?: unknown;
  /** What is by chance for the learner: the order of options, and what is drawn of pools. */
  readonly seed?: unknown;
  /** How far the learner has come, seconds. */
  readonly furthestSecs?: unknown;
  /** What gotos have led over. */
  readonly skipped?: unknown;
}

/** @deprecated Use `EnvironmentExpression`. */
export type Expressed = EnvironmentExpression;

/** @deprecated Use `NarrationHandle`. */
export type Telling = NarrationHandle;
