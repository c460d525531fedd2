/** What the wasm builds offer. */

import type { FaceLook, NaturalHair, SpotKind } from './face-types.js';
import type { Cue, InterruptionOutcome, Performance } from './performance.js';
import type { EnvironmentExpression, Light, PictureStatistics, Piece, Quality, Story } from './types.js';

/** What became of a tick; the numbers are `TickStatus` in `crate/web`. */
export const TickStatus = {
  /** A picture was shown. */
  Shown: 0,
  /** Nothing was drawn this time: no size yet, or the surface was busy. */
  Skipped: 1,
  /** The picture is lost; a fresh engine with a fresh canvas can bring it back. */
  Lost: 2,
  /** This engine was made without a canvas. */
  NoPicture: 3,
} as const;

/** One storyteller: the class `Player` of `crate/web`. */
export interface Engine {
  /**
   * Reads a story; `bundle` is the text of `speech.json`, `glb` the figure, `motion` the amount of
   * idle life from 0 to 1. Throws a readable `Error` when the figure cannot be read.
   */
  load(eml: string, bundle: Uint8Array | undefined, figure: string, glb: Uint8Array, motion: number): Story;
  /** Has the figure that `load` put on stage tell another story, as `load` would; undefined before a `load`. */
  replaceStory(eml: string, bundle: Uint8Array | undefined, motion: number): Story | undefined;
  /** Has the figure that `load` put on stage read another text, with room for every place of a hand or not; undefined before a `load`. */
  rehearse(eml: string, bundle: Uint8Array | undefined, motion: number, roomy: boolean): Story | undefined;
  /** Names of animations that are played and have not been provided. */
  wantedAnimations(): string[];
  /** Takes animations by name, an empty text for what was not found; the story `eml` with its new times, and what is wrong with these animations. */
  provideAnimations(eml: string, names: string[], texts: string[]): Story | undefined;
  /** The dominant hand, `left` or `right`, in texts that are read later; by any other name, as story and figure have it. */
  setHandedness(hand: string): void;
  /** The language of lips in texts that are read later, where neither they nor a voice tell it: a tag of BCP 47. */
  setLanguage(tag: string): void;
  /** Gives the figure on stage a face of a face model; what is played goes on. Without factors it keeps its colours. */
  setFace(skin: Float64Array, organs: Float64Array, factors: Float64Array, look: FaceLook | undefined, moves: boolean): void;
  /** Whether hair of a name was taken already. */
  hasDonor(name: string): boolean;
  /** Takes hair, on the skin that it grew on, for faces of so many vertices. */
  addDonor(name: string, glb: Uint8Array, vertices: number): void;
  /** The natural colours of hair, from dark to pale. */
  naturalHair(): NaturalHair[];
  /** The place of the skin that is seen at a place of the picture, −1 to 1 from the left and from below: three vertices and their shares. */
  pickFace(x: number, y: number): Float64Array | undefined;
  /** Where such a place lies on the picture of the skin: its texture coordinates, and their change over a metre to the right and upwards. */
  faceChart(spot: Float64Array): Float64Array | undefined;
  /** What to paint on the picture of the skin for other hair: linear red, green and blue, the place of skin like a bare scalp, how many corners of triangles are under hair, then the texture coordinates of those, and of corners of what is bare. */
  scalp(): Float32Array | undefined;
  /** Spots of a kind at the places of a seed, in an order by chance: of each what `faceChart` tells of its place, then its strength, 0 to 1. */
  speckles(kind: SpotKind, seed: number): Float32Array | undefined;
  /** Which picture of the figure has the colour of its skin. */
  skinImage(): number | undefined;
  /** Lights the stage, the lamps turned about the figure, radians. */
  setLight(name: Light, turn: number): void;
  /** Keeps hands and feet above captions that take this share of the picture's height at its lower edge. */
  setCaptions(share: number): void;
  /** Shows the whole figure from another side, in this text and those rehearsed later. Radians and metres. */
  setView(turn: number, tilt: number, zoom: number, right: number, up: number): void;
  /** The moment shown last as numbers, in the order that `pose.ts` reads; empty before a `load`. */
  pose(): Float32Array;
  /** The names of what `pose` tells: joints, then manipulators. */
  poseNames(): string[];
  /** The controls of the face at `count` times, as numbers that `course.ts` decodes. */
  faceCurves(from: number, to: number, count: number): Float32Array;
  /** What the mouth goes through, and the names of its phones; `course.ts` reads them. */
  segments(): Float32Array;
  segmentNames(): string[];
  /** Shows the moment `timeSecs`; a `TickStatus`. Cues passed since the last tick or seek are kept for `drainEvents`. */
  tick(timeSecs: number): number;
  /** Shows the figure as it waits for the story to be played, for so many seconds already; a `TickStatus`. The next `tick` goes on from there. */
  evaluateIdle(waitedSecs: number): number;
  /** Shows the figure as it waits for an answer where the story rests, for so many seconds already, and looks at a bone, or at the viewer; a `TickStatus`. */
  evaluateWaiting(timeSecs: number, waitedSecs: number, lookedAt: string): number;
  /** Moves without passing what lies between. */
  seek(timeSecs: number): void;
  /** As `seek`, but what the figure does as it waits fades into what follows. */
  seekWithFade(timeSecs: number): void;
  /** Size of the canvas in CSS pixels, and device pixels for each of them. */
  resize(width: number, height: number, dpr: number): void;
  /** The music under the story and what joined it. */
  music(): Piece[];
  /** How the environment expresses what is felt at a story time; none before a load. */
  environmentExpression(timeSecs: number): EnvironmentExpression | undefined;
  /** The cues passed since the last call. */
  drainEvents(): Cue[];
  /** Takes the speech of fragments that will come: a bundle that begins with what is known. Whether it does. */
  updateBundle(bundle: Uint8Array): boolean;
  /** Performs a fragment of EML; plain times count from `nowSecs`. `mind` tells senders apart. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined;
  /** Ends what fragments say and do; undefined where there is nothing to end. */
  interrupt(nowSecs: number): InterruptionOutcome | undefined;
  /** The clock may pass the end of the story, because more may come. */
  setOpenEnded(openEnded: boolean): void;
  /** Pictures of the figure that was read, as they lie in its file: how many, their MIME types and bytes. */
  imageCount(): number;
  imageType(index: number): string;
  imageBytes(index: number): Uint8Array;
  /** A decoded picture: straight RGBA, rows from the top. Without it the surface has its plain colour. */
  setImage(index: number, width: number, height: number, rgba: Uint8ClampedArray): void;
  /** How much work goes into a picture; `auto` follows the times given to `reportFrame`. */
  setQuality(quality: Quality): void;
  /** A picture that stands still is drawn with every pixel, however slow that is. */
  setResting(resting: boolean): void;
  /** Milliseconds from one picture on screen to the next. */
  reportFrame(ms: number): void;
  /** What the last picture took; undefined without a canvas. */
  statistics(): PictureStatistics | undefined;
  free(): void;
}
