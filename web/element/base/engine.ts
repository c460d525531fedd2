/** Interface of the wasm builds. */

import type { FaceLook, NaturalHair, SpotKind } from './face-types.js';
import type { Cue, InterruptionOutcome, Performance } from './performance.js';
import type { EnvironmentExpression, Light, PictureStatistics, Piece, Quality, Story } from './types.js';

/** Result of a tick; the numbers are `TickStatus` in `crate/web`. */
export const TickStatus = {
  /** A frame was shown. */
  Shown: 0,
  /** No frame was rendered: there is no size yet, or the surface was busy. */
  Skipped: 1,
  /** The rendering context is lost; a new engine with a new canvas can restore it. */
  Lost: 2,
  /** Error code of an engine that was created without a canvas. */
  NoPicture: 3,
} as const;

/** Storyteller: the class `Player` of `crate/web`. */
export interface Engine {
  /**
   * Reads a story; `bundle` is the text of `speech.json`, `glb` the figure, `motion` the amount of
   * idle life from 0 to 1. Throws a readable `Error` when the figure cannot be read.
   */
  load(eml: string, bundle: Uint8Array | undefined, figure: string, glb: Uint8Array, motion: number): Story;
  /** Lets the figure that `load` put on stage perform another story, like `load`; returns undefined before a `load`. */
  replaceStory(eml: string, bundle: Uint8Array | undefined, motion: number): Story | undefined;
  /** Lets the figure that `load` put on stage read another text, with or without room for every place of a hand; returns undefined before a `load`. */
  rehearse(eml: string, bundle: Uint8Array | undefined, motion: number, roomy: boolean): Story | undefined;
  /** Names of animations that are played and have not been provided. */
  wantedAnimations(): string[];
  /** Takes animations by name; an empty text means not found. Returns the story `eml` with its new times, and the problems of these animations. */
  provideAnimations(eml: string, names: string[], texts: string[]): Story | undefined;
  /** Sets the dominant hand, `left` or `right`, for texts that are read later; any other name restores the choice of story and figure. */
  setHandedness(hand: string): void;
  /** Sets the default language of lip animation, for texts read later whose language neither they nor a voice specify: a BCP 47 tag. */
  setLanguage(tag: string): void;
  /** Sets a face of a face model on the figure on stage; playback continues. Without factors it keeps its colours. */
  setFace(skin: Float64Array, organs: Float64Array, factors: Float64Array, look: FaceLook | undefined, moves: boolean): void;
  /** Returns true if hair of this name is loaded. */
  hasDonor(name: string): boolean;
  /** Adds hair, on the skin that it grew on, for faces of a number of vertices. */
  addDonor(name: string, glb: Uint8Array, vertices: number): void;
  /** Returns the natural colours of hair, from dark to pale. */
  naturalHair(): NaturalHair[];
  /** Returns the visible point of the skin at an image position, −1 to 1 from the left and from the bottom: three vertices and their weights. */
  pickFace(x: number, y: number): Float64Array | undefined;
  /** Returns the texture coordinates of such a point on the skin texture, and their change per metre to the right and upwards. */
  faceChart(spot: Float64Array): Float64Array | undefined;
  /**
   * Returns the data for painting the skin texture for other hair: linear red, green and blue, the position of skin like a bare scalp, the number of triangle
   * corners under hair, then their texture coordinates, and those of bare corners.
   */
  scalp(): Float32Array | undefined;
  /** Returns spots of a kind at the positions of a seed, in random order: for each the result of `faceChart` for its position, then its strength, 0 to 1. */
  speckles(kind: SpotKind, seed: number): Float32Array | undefined;
  /** Returns the index of the figure's image with the colour of its skin. */
  skinImage(): number | undefined;
  /** Lights the stage, the lamps turned about the figure, radians. */
  setLight(name: Light, turn: number): void;
  /** Keeps hands and feet above captions that take this share of the image height at its lower edge. */
  setCaptions(share: number): void;
  /** Shows the whole figure from another side, in this text and those rehearsed later. Radians and metres. */
  setView(turn: number, tilt: number, zoom: number, right: number, up: number): void;
  /** Returns the last displayed pose as numbers, in the order that `pose.ts` reads; empty before a `load`. */
  pose(): Float32Array;
  /** Returns the names of the items in `pose`: joints, then manipulators. */
  poseNames(): string[];
  /** Returns the controls of the face at `count` times, as numbers that `course.ts` decodes. */
  faceCurves(from: number, to: number, count: number): Float32Array;
  /** Returns the segments of speech that drive the mouth, and the names of its phones; `course.ts` reads them. */
  segments(): Float32Array;
  segmentNames(): string[];
  /** Shows the frame at `timeSecs`; returns a `TickStatus`. Cues passed since the last tick or seek are kept for `drainEvents`. */
  tick(timeSecs: number): number;
  /** Shows the figure that has waited a number of seconds for playback; returns a `TickStatus`. The next `tick` continues from there. */
  evaluateIdle(waitedSecs: number): number;
  /** Shows the figure that has waited a number of seconds for an answer, looking at a bone, or at the viewer; returns a `TickStatus`. */
  evaluateWaiting(timeSecs: number, waitedSecs: number, lookedAt: string): number;
  /** Seeks without delivering the cues between. */
  seek(timeSecs: number): void;
  /** Seeks like `seek`, but fades from the waiting behaviour into the story. */
  seekWithFade(timeSecs: number): void;
  /** Sets the size of the canvas in CSS pixels, and the number of device pixels per CSS pixel. */
  resize(width: number, height: number, dpr: number): void;
  /** Returns the music of the story and of live additions. */
  music(): Piece[];
  /** Returns the environment's expression of emotions at a story time; undefined before a load. */
  environmentExpression(timeSecs: number): EnvironmentExpression | undefined;
  /** Returns the cues passed since the last call. */
  drainEvents(): Cue[];
  /** Takes the speech of coming fragments: a bundle that begins with the known one. Returns false if it does not. */
  updateBundle(bundle: Uint8Array): boolean;
  /** Performs a fragment of EML; plain times count from `nowSecs`. `mind` identifies the sender. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined;
  /** Ends the actions of fragments; returns undefined if there is nothing to end. */
  interrupt(nowSecs: number): InterruptionOutcome | undefined;
  /** Sets whether the clock may pass the end of the story, because more may arrive. */
  setOpenEnded(openEnded: boolean): void;
  /** Returns the number of images of the loaded figure; `imageType` and `imageBytes` give their MIME types and bytes, as in its file. */
  imageCount(): number;
  imageType(index: number): string;
  imageBytes(index: number): Uint8Array;
  /** Sets a decoded image: straight RGBA, rows from the top. Without it the surface has its plain colour. */
  setImage(index: number, width: number, height: number, rgba: Uint8ClampedArray): void;
  /** Sets the rendering quality; `auto` follows the times given to `reportFrame`. */
  setQuality(quality: Quality): void;
  /** Sets whether the image is static; a static image is rendered at full size, however slow that is. */
  setResting(resting: boolean): void;
  /** Takes the time between two displayed frames, milliseconds. */
  reportFrame(ms: number): void;
  /** Returns statistics of the last image; undefined without a canvas. */
  statistics(): PictureStatistics | undefined;
  free(): void;
}
