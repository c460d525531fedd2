/** A face that a figure is given, and what its own does. */

/** How a face speaks, as numbers; `course.ts` decodes them. */
export interface FaceCourse {
  /** The controls of the face at even times. */
  readonly curves: Float32Array;
  /** What the mouth goes through. */
  readonly segments: Float32Array;
  /** The phones of the segments. */
  readonly names: readonly string[];
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
export type AccessoryKind = 'round-glasses' | 'square-glasses' | 'sunglasses' | 'ear-studs' | 'ear-rings' | 'nose-stud' | 'knitted-cap' | 'hat' | 'headscarf';

/** A thing that is worn; its colour is linear, 0 to 1. */
export interface Accessory {
  readonly kind: AccessoryKind;
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
  readonly wear?: readonly Accessory[] | undefined;
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
