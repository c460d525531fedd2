/** Transcriptions as plain data, as `crate/annotate/src/plain` and `bindings.rs` have them. Times are seconds of the recording. */

import type { Diagnostic } from '../../element/base/types.js';

/** Annotation with times of its own. */
export interface Timed {
  start: number;
  end: number;
}

/** Annotation over a run of others: indices of the first and the last. */
export interface Run {
  first: number;
  last: number;
}

export interface Word extends Timed {
  token: string;
}

export interface Utterance extends Run {
  text: string;
}

export interface Level extends Run {
  level: string;
}

export interface Gesture extends Timed {
  class: string;
  confidence?: number | undefined;
  animation?: string | undefined;
}

export interface Phase extends Timed {
  kind: string;
  source?: string | undefined;
  target?: string | undefined;
  motion?: string | undefined;
  handShapes?: string | undefined;
  palmOrientations?: string | undefined;
  bodyShape?: string | undefined;
}

export interface Phrase extends Run {
  dimension?: string | undefined;
  handedness?: string | undefined;
  symmetry?: boolean | undefined;
  speakerFramePosition?: string | undefined;
  confidence?: number | undefined;
  contribution?: string | undefined;
  iconicBody?: string | undefined;
  iconicMotion?: string | undefined;
  iconicViewpoint?: string | undefined;
  metaphoricBase?: string | undefined;
  metaphoricReferent?: string | undefined;
  metaphoricMotion?: string | undefined;
  deicticGeographicTarget?: string | undefined;
  deicticNarrationTarget?: string | undefined;
}

export interface Layer {
  name: string;
  phases: Phase[];
  phrases: Phrase[];
}

export interface Transcription {
  media: string[];
  coder?: string | undefined;
  words: Word[];
  utterances: Utterance[];
  levels: Level[];
  gestures: Gesture[];
  /** Prosody, events on stage and settings are kept as they are: the page does not show them. */
  prosody?: unknown;
  staging?: unknown;
  settings?: unknown;
  layers: Layer[];
}

/** Annotation, by its track (`words`, `phases.0` and so on) and its number in it. */
export interface Item {
  readonly track: string;
  readonly index: number;
}

/** Problem of a file or of an annotation. */
export interface Problem extends Diagnostic {
  readonly item?: Item;
  /** Field of the annotation. */
  readonly field?: string;
  /** Range in the text of the field, UTF-8 bytes. */
  readonly range?: readonly [from: number, to: number];
}

export interface Opened {
  readonly text: string;
  readonly transcription: Transcription;
  readonly diagnostics: readonly Problem[];
}

export interface Script {
  readonly eml: string;
  /** Start of the first gesture; absent if there is none, or if its time depends on a word. */
  readonly firstGestureSecs?: number;
  readonly diagnostics: readonly Problem[];
}

/** Some of the counts of `Statistics` in `crate/annotate/src/gestura/statistics.rs`. */
export interface Statistics {
  readonly lengthSecs: number;
  readonly words: number;
  readonly utterances: number;
  readonly gestures: number;
  readonly strokeLeadSecs?: number;
}

/** Words of the closed lists. */
export interface Lists {
  readonly levels: readonly string[];
  readonly classes: readonly string[];
  readonly phases: readonly string[];
  readonly dimensions: readonly string[];
  readonly hands: readonly string[];
  readonly viewpoints: readonly string[];
}

/** Reference of the times of gestures in a script. */
export type Anchoring = 'words' | 'seconds';

export const isSame = (a: Item | undefined, b: Item | undefined): boolean => a?.track === b?.track && a?.index === b?.index;
