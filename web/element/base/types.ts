/** What the element, the engine and a page tell each other. All times are seconds. */

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

/** The place of something among all that a story comes to, and that of the answer, condition or item of a pool around it. */
export interface Ordered {
  readonly order: number;
  readonly within?: number;
}

/** A question of a story, and where in it what follows from its answers lies. */
export interface Question extends Ordered {
  /** Where the story rests until it is answered. */
  readonly atSecs: number;
  /** Where it goes on after what follows. */
  readonly endSecs: number;
  /** Results are kept by it. */
  readonly name: string;
  readonly kind: QuestionKind;
  readonly prompt: string;
  readonly picture?: QuestionPicture;
  /** True where no answer is right or wrong: whatever is answered is taken, and counts no points. */
  readonly isUngraded?: boolean;
  readonly points: number;
  /** What is right of an answer counts by itself (`several`, `order`, `match`, `gap`). */
  readonly isPartial?: boolean;
  /** Options are shown in an order by chance. */
  readonly isShuffled?: boolean;
  readonly tries: number;
  /** Read after a wrong answer, while there are tries left. */
  readonly hint?: string;
  /** Read once it is answered for good, where the author says what: after any answer, and in its place after a right or a wrong one. */
  readonly feedback?: { readonly any?: string; readonly right?: string; readonly wrong?: string };
  /** How long one may think about it, seconds; the learner may ask for more. */
  readonly limitSecs?: number;
  readonly options: readonly QuestionOption[];
  /** `to`: `right`, `wrong`, `answered`, or the name of an option. */
  readonly answers: readonly { readonly order: number; readonly to: string; readonly startSecs: number; readonly endSecs: number }[];
}

/** A picture of a question or an option: a file of the story's folder, and what it shows. */
export interface QuestionPicture {
  readonly file: string;
  readonly alt: string;
}

/** Something on the way through a story. An item is a clause of the pool at a place, before what it is itself. */
export type Way = Ordered & { readonly atSecs: number; readonly endSecs: number } & (
    | { readonly kind: 'part'; readonly name: string; readonly title: string }
    | { readonly kind: 'if'; readonly name: string; readonly is?: string; readonly not?: string; readonly above?: number; readonly below?: number }
    | { readonly kind: 'set'; readonly name: string; readonly value?: string; readonly by?: number }
    | { readonly kind: 'pool'; readonly count: number }
    | { readonly kind: 'item'; readonly pool: number }
    | { readonly kind: 'goto'; readonly to: string }
  );

/**
 * How a question is answered, and what `given` of an answer holds: the name of one option (`choice`), those of all that are right
 * (`several`), those of all in order (`order`), for each option the name of the one whose partner it was given (`match`), for each
 * gap what was written (`gap`), a number as it was written (`number`), the name of what was pointed at (`point`), or a text (`text`).
 */
export type QuestionKind = 'choice' | 'several' | 'order' | 'match' | 'gap' | 'number' | 'point' | 'text';

/** What may be answered, or a rule for what may be: those that a kind does not know are left out. */
export interface QuestionOption {
  readonly name: string;
  /** Read; of `gap`, `number` and `text` it may be empty. */
  readonly text: string;
  readonly picture?: QuestionPicture;
  readonly isRight: boolean;
  /** Of `match`: its right partner. */
  readonly partner?: string;
  /** Of `gap` and `text`: what is taken. */
  readonly accepts?: readonly string[];
  /** Of `text`: what must not be there. */
  readonly rejects?: readonly string[];
  /** Of `number`: the least and the greatest number that are taken. */
  readonly least?: number;
  readonly most?: number;
  /** Of `point`: the part of the figure. */
  readonly at?: string;
}

/** A story that was read. */
export interface Story {
  readonly performer: Performer;
  readonly questions: readonly Question[];
  readonly ways: readonly Way[];
  readonly durationSecs: number;
  readonly utterances: readonly Utterance[];
  readonly diagnostics: readonly Diagnostic[];
}

/** How camera, light and music express what is felt. */
export interface Expressed {
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

/** Something that happens at a moment of the story. */
export type Cue = {
  readonly timeSecs: number;
  /** The live fragment that it belongs to; absent for the story's own. */
  readonly fragment?: number;
} & (
  | { readonly kind: 'word'; readonly utterance: number; readonly word: number; readonly text: string; readonly endSecs: number }
  /** A phone begins; `symbol` is of the phone set that `phoneSet` names. Only what was baked has phones. */
  | { readonly kind: 'phone'; readonly utterance: number; readonly symbol: string; readonly phoneSet: string; readonly endSecs: number }
  | { readonly kind: 'utterance'; readonly phase: 'start' | 'end'; readonly utterance: number; readonly text: string; readonly startSecs: number; readonly endSecs: number }
  /** A moment that the story names by `timeId` or `tm`. */
  | { readonly kind: 'mark'; readonly name: string }
  | ({ readonly kind: 'clause'; readonly phase: 'start' | 'end' } & ClauseRef)
  | { readonly kind: 'storyevent'; readonly type?: string; readonly payload: string }
  | Failure
);

/** Which clause of a story or fragment. */
interface ClauseRef {
  /** Its place, from 0. */
  readonly clause: number;
  /** The EML element, for example `gesture-key`. */
  readonly element: string;
  /** Its `timeId`. */
  readonly id?: string;
}

/** Something of a fragment is not performed, or not as meant. */
interface Failure {
  readonly kind: 'failed' | 'warning';
  readonly timeSecs: number;
  readonly fragment?: number;
  readonly code: string;
  readonly message: string;
  readonly hints?: readonly string[];
  /** Where in the fragment, from 1, in characters. */
  readonly line?: number;
  readonly column?: number;
}

/** The immediate answer to the sender of a fragment. */
export type Answer =
  | Failure
  | {
      readonly kind: 'accepted';
      readonly timeSecs: number;
      readonly fragment: number;
      /** The `name` of the fragment's `eml` element. */
      readonly name?: string;
      readonly clauses: readonly (ClauseRef & { readonly startSecs: number; readonly endSecs: number })[];
    };

/** What became of a fragment. */
export interface Performance {
  readonly events: readonly Answer[];
  readonly utterances: readonly Utterance[];
  /** The index of the first of them. */
  readonly firstUtterance: number;
  /** What it asks. */
  readonly questions: readonly Question[];
  /** When all that is known is over. */
  readonly endSecs: number;
  /** What it ended, where it was no fragment but `<interrupt/>`. */
  readonly cut?: Interruption;
}

/** What fragments say and do has ended. */
export interface Interruption {
  /** When. */
  readonly atSecs: number;
  /** When all that is known now is over. */
  readonly endSecs: number;
}

/** Plain text, at once or in pieces. */
export type Words = string | AsyncIterable<string> | ReadableStream<string>;

/** A text that is being told. */
export interface Telling {
  /** Everything has been said, or it was interrupted; rejects with the error of the words' source, when what came before it has been said. */
  readonly done: Promise<void>;
  /** Says no more, as `interrupt()` of the player. */
  interrupt(): void;
}

/** Whether a mind listens. */
export type MindState = 'connecting' | 'open' | 'closed';

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

/** How a face speaks, as numbers; `course.ts` decodes them. */
export interface FaceCourse {
  /** The controls of the face at even times. */
  readonly curves: Float32Array;
  /** What the mouth goes through. */
  readonly segments: Float32Array;
  /** The phones of the segments. */
  readonly names: readonly string[];
}

/** One storyteller: the class `Player` of `crate/web`. */
export interface Engine {
  /**
   * Reads a story; `bundle` is the text of `speech.json`, `glb` the figure, `motion` the amount of
   * idle life from 0 to 1. Throws a readable `Error` when the figure cannot be read.
   */
  load(eml: string, bundle: Uint8Array | undefined, figure: string, glb: Uint8Array, motion: number): Story;
  /** Has the figure that `load` put on stage tell another story, as `load` would; undefined before a `load`. */
  tell(eml: string, bundle: Uint8Array | undefined, motion: number): Story | undefined;
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
  lends(name: string): boolean;
  /** Takes hair, on the skin that it grew on, for faces of so many vertices. */
  lend(name: string, glb: Uint8Array, vertices: number): void;
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
  welcome(waitedSecs: number): number;
  /** Shows the figure as it waits for an answer where the story rests, for so many seconds already, and looks at a bone, or at the viewer; a `TickStatus`. */
  attend(timeSecs: number, waitedSecs: number, lookedAt: string): number;
  /** Moves without passing what lies between. */
  seek(timeSecs: number): void;
  /** As `seek`, but what the figure does as it waits fades into what follows. */
  leap(timeSecs: number): void;
  /** Size of the canvas in CSS pixels, and device pixels for each of them. */
  resize(width: number, height: number, dpr: number): void;
  /** The music under the story and what joined it. */
  music(): Piece[];
  /** How the environment expresses what is felt at a story time; none before a load. */
  expressed(timeSecs: number): Expressed | undefined;
  /** The cues passed since the last call. */
  drainEvents(): Cue[];
  /** Takes the speech of fragments that will come: a bundle that begins with what is known. Whether it does. */
  hear(bundle: Uint8Array): boolean;
  /** Performs a fragment of EML; plain times count from `nowSecs`. `mind` tells senders apart. */
  perform(mind: number, fragment: string, nowSecs: number): Performance | undefined;
  /** Ends what fragments say and do; undefined where there is nothing to end. */
  interrupt(nowSecs: number): Interruption | undefined;
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

/** A face of a face model, as `Faces` of `faces.ts` makes it. */
export interface FigureFace {
  /** x, y and z of each vertex of the skin: metres, between the tragions, x left, y up, z front. */
  readonly skin: Float64Array;
  /** Centres of the eyes, turns that close the lids (radians), height of the chin. */
  readonly organs: Float64Array;
  /** What the colours of each vertex, the irises and the brows are multiplied by. */
  readonly factors: Float64Array | undefined;
  /** What hair the head has and what it wears; without, those of the figure. */
  readonly look?: FaceLook | undefined;
  /** What is painted on the skin. */
  readonly marks?: readonly FaceMark[] | undefined;
  /** It is on its way to another that differs little and follows, as while a slider is dragged: shown soon rather than finely. */
  readonly moves?: boolean | undefined;
}

/** Pigments of hair: eumelanin 0.05 (blond) to 1.5 (black), pheomelanin 0.1 to 0.9 (red), and the share of grey hairs. */
export interface HairColour {
  readonly eumelanin: number;
  readonly pheomelanin: number;
  readonly grey: number;
}

/** A natural colour of hair; `rgb` is linear, 0 to 1. */
export interface NaturalHair {
  readonly name: string;
  readonly colour: HairColour;
  readonly rgb: readonly [number, number, number];
}

/** Whose hair a head has, and its colour. */
export interface HairLook {
  /** `own`, `none` (shaved), `bald`, or the name of a file of the library in `hair/`; of a beard also `stubble`. */
  readonly from?: string | undefined;
  /** As it is without. */
  readonly colour?: HairColour | undefined;
}

/** What can be worn on a head. */
export type WearKind = 'round-glasses' | 'square-glasses' | 'sunglasses' | 'ear-studs' | 'ear-rings' | 'nose-stud' | 'knitted-cap' | 'hat' | 'headscarf';

/** A thing that is worn; its colour is linear, 0 to 1. */
export interface Wear {
  readonly kind: WearKind;
  readonly colour: readonly [number, number, number];
}

/** Spots of skin that are finer than its vertices. */
export type SpotKind = 'freckles' | 'stubble' | 'ageSpots' | 'moles';

/** What hair a head has and what it wears. */
export interface FaceLook {
  readonly hair?: HairLook | undefined;
  readonly beard?: HairLook | undefined;
  /** How much of a beard that a figure lends, in looks of earlier versions. */
  readonly cut?: 'full' | 'moustache' | 'goatee' | undefined;
  /** Colour of brows and lashes. */
  readonly brows?: HairColour | undefined;
  readonly wear?: readonly Wear[] | undefined;
  /** How many freckles there are, how far shaved hair shows, and how many spots age has left, 0 to 1. */
  readonly freckles?: number | undefined;
  readonly stubble?: number | undefined;
  readonly ageSpots?: number | undefined;
  /** How many moles there are. */
  readonly moles?: number | undefined;
  /** Freckles, spots and moles lie elsewhere with another one: a whole number. */
  readonly seed?: number | undefined;
  /** Colour of the irises, linear, 0 to 1; that of the face without. */
  readonly iris?: readonly [number, number, number] | undefined;
  /** How far lines of age show at rest, 0 to 1. */
  readonly lines?: number | undefined;
}

/** A place on the skin: three of its vertices and their shares, which sum to 1. The same place on every face. */
export interface FaceSpot {
  readonly corners: readonly [number, number, number];
  readonly shares: readonly [number, number, number];
}

/** What a tattoo shows. */
export type TattooShape = 'star' | 'heart' | 'cross' | 'anchor' | 'dots' | 'text';

/** Something painted on the skin. */
export interface FaceMark extends FaceSpot {
  readonly kind: 'scar' | 'mole' | 'birthmark' | 'tattoo';
  /** Its length, metres. */
  readonly size: number;
  /** Turned clockwise by, radians. */
  readonly turn: number;
  /** How strongly it shows, 0 to 1, which it is without. */
  readonly strength?: number | undefined;
  readonly shape?: TattooShape | undefined;
  /** Letters of a tattoo. */
  readonly text?: string | undefined;
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
