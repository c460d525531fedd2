/** Types shared by the element, the engine and a page. All times are seconds. */

import type { Question, FlowEntry } from './questions.js';

/** Problem of a story, its voice or its figure. The rest of the story plays. */
export interface Diagnostic {
  /** A stable short name, for example `unknown-hand-shape`. */
  readonly code: string;
  readonly severity: 'error' | 'warning';
  readonly message: string;
  /** Hints for a fix, each a sentence. */
  readonly hints: readonly string[];
  /** Location in the story; absent if it is not about the story's text. */
  readonly start?: Place;
  /** The end of the span, exclusive. */
  readonly end?: Place;
}

/** Location in the story's text. */
export interface Place {
  /** Line number, from 1. */
  readonly line: number;
  /** Column number, from 1, in characters, as people count. */
  readonly column: number;
  /** Column number, from 1, in UTF-16 units, as JavaScript and editors count. */
  readonly columnUtf16: number;
}

/** A spoken word; times are of the story. */
export interface Word {
  /** Word as written, with attached punctuation. */
  readonly text: string;
  readonly startSecs: number;
  readonly endSecs: number;
  /** The story emphasises it. */
  readonly emphasized: boolean;
}

/** One encoding of an utterance's audio. */
export interface AudioFile {
  /** Plain name in the story's `voice` folder. */
  readonly file: string;
  /** MIME type with codecs. */
  readonly mime: string;
}

/** An utterance with its time in the story. */
export interface Utterance {
  readonly startSecs: number;
  readonly durationSecs: number;
  /** Audio files in order of preference; empty if there is no recording. */
  readonly audio: readonly AudioFile[];
  readonly words: readonly Word[];
  /** The times were guessed because no recording was found. */
  readonly estimated: boolean;
  /** True if it was interrupted: it ends before its recording does. */
  readonly cut?: boolean;
  /** BCP 47 tag, if the bundle or the story's markup specifies it. */
  readonly language?: string;
  /** Name of the voice that the story requests for it; absent for the story's own. */
  readonly voice?: string;
}

/** Performer chosen by a story. */
export interface Performer {
  /** A name of the library, or a file in the story's folder. */
  readonly figure?: string;
  /** Name of a voice, of the browser or of the baker. */
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

/** Expression of emotions by camera, light and music. */
export interface EnvironmentExpression {
  /** Strongest emotion; `neutral` if there is none. */
  readonly emotion: string;
  /** Strength of the eliciting events, 0 to 10. */
  readonly potential: number;
  /** Current intensity, 0 to 10. */
  readonly intensity: number;
  readonly shot: 'extremeCloseUp' | 'closeUp' | 'medium' | 'storyteller' | 'full' | 'long';
  readonly angle: 'eye' | 'high' | 'low';
  /** Colour that the emotion gives to the key light, sRGB, 0 to 255. */
  readonly color: readonly [number, number, number];
  /** Attenuation of the key light by the emotion, 0 to 1. */
  readonly attenuation: number;
  /** Brightness of the key light relative to the stage's own. */
  readonly brightness: number;
  /** Valence of the mood, usually -10 to 10. */
  readonly valence: number;
  /** Arousal of the mood, likewise. */
  readonly arousal: number;
  /** Files of the audible music. */
  readonly music: readonly string[];
}

/** A piece of music with its time in the story. */
export interface Piece {
  readonly startSecs: number;
  /** Time at which it is silent; may be infinite. */
  readonly endSecs: number;
  /** Path from the story's folder, or from `music/` of the asset library. An `.opus` may be accompanied by an `.mp3`. */
  readonly file: string;
  readonly library: boolean;
  /** True if the piece restarts at its end. */
  readonly loops: boolean;
  /** Volume at story times; linear between them. */
  readonly level: readonly (readonly [atSecs: number, level: number])[];
}

/** Plain text, complete or in pieces. */
export type Words = string | AsyncIterable<string> | ReadableStream<string>;

/** A text that is being spoken. */
export interface NarrationHandle {
  /**
   * Promise that resolves when everything has been spoken, or after an interruption; rejects with the error of the text source, once the text before it has
   * been spoken.
   */
  readonly done: Promise<void>;
  /** Stops speaking, like `interrupt()` of the player. */
  interrupt(): void;
}

/** Connection state of a mind. */
export type MindState = 'connecting' | 'open' | 'closed';

/** View of a page for inspection: of the whole figure, unless zoomed in. */
export interface View {
  /** Azimuth around the figure, radians; positive to its left. */
  readonly turn: number;
  /** Elevation, radians. */
  readonly tilt: number;
  /** Zoom factor. */
  readonly zoom: number;
  /** Offset of the image centre to the right, metres. */
  readonly right: number;
  /** Upward offset, metres. */
  readonly up: number;
}

/** Joints, targets and camera of the last displayed frame, as numbers; `readPose` of `pose.ts` decodes them. */
export interface PoseNumbers {
  /** Names of the joints, then of the manipulators. */
  readonly names: readonly string[];
  readonly numbers: Float32Array;
}

/** A hand of the character. */
export type Hand = 'left' | 'right';

/** Rendering quality. */
export type Quality = 'auto' | 'lowest' | 'low' | 'medium' | 'high';

/** Statistics of one image. */
export interface PictureStatistics {
  /** Name of the graphics adapter, if the browser reports it. */
  readonly adapter: string;
  /** The tier in force. */
  readonly quality: string;
  readonly drawCalls: number;
  /** Number of draw calls of the figure, including its shadows. */
  readonly figureDrawCalls: number;
  /** Number of triangles drawn, all passes. */
  readonly triangles: number;
}

/** Performance statistics of a player. */
export interface Statistics extends PictureStatistics {
  /** Time from the start of loading to the first image, milliseconds. */
  readonly firstFrameMs: number;
  /** The files of story and figure, as they are after transport. */
  readonly bytes: { readonly story: number; readonly voice: number; readonly figure: number };
}

/** The two builds. */
export type Backend = 'webgpu' | 'webgl';

/** Error returned when a story cannot be played, with a one-sentence message for users; codes are those of `MediaError`. */
export class PlayerError extends Error {
  override readonly name = 'PlayerError';
  /** Code of `MediaError` for an unsupported source, which in a media element includes missing and unreadable ones. */
  readonly code = 4;
  readonly MEDIA_ERR_ABORTED = 1;
  readonly MEDIA_ERR_NETWORK = 2;
  readonly MEDIA_ERR_DECODE = 3;
  readonly MEDIA_ERR_SRC_NOT_SUPPORTED = 4;
}

/** Lights of the stage. */
export type Light = 'stage' | 'daylight' | 'evening' | 'studio';

/** Position and answers of a learner. */
export interface PlayerState {
  readonly placeSecs: number;
  /** Given answers. This member and the following ones may have been altered since `state` returned them. */
  readonly answered: unknown;
  /** The variables of the story. */
  readonly values?: unknown;
  /** Assignments already made, which are not repeated. */
  readonly done?: unknown;
  /** Random seed of the learner: order of options, and draws from pools. */
  readonly seed?: unknown;
  /** Furthest position of the learner, seconds. */
  readonly furthestSecs?: unknown;
  /** Spans skipped by gotos. */
  readonly skipped?: unknown;
}

/** @deprecated Use `EnvironmentExpression`. */
export type Expressed = EnvironmentExpression;

/** @deprecated Use `NarrationHandle`. */
export type Telling = NarrationHandle;
