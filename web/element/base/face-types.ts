/** Face of a figure, and its animation. */

/** Animation of a face by speech, as numbers; `course.ts` decodes them. */
export interface FaceCourse {
  /** The controls of the face at even times. */
  readonly curves: Float32Array;
  /** Segments of speech that drive the mouth. */
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
  /** Factors of the colours of each vertex, the irises and the brows. */
  readonly factors: Float64Array | undefined;
  /** Hair and accessories of the head; default: those of the figure. */
  readonly look?: FaceLook | undefined;
  /** Marks on the skin. */
  readonly marks?: readonly FaceMark[] | undefined;
  /** True for an intermediate face that differs little from the next one, as while a slider is dragged: shown fast rather than in full detail. */
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

/** Source and colour of hair. */
export interface HairLook {
  /** Source: `own`, `none` (shaved), `bald`, or the name of a library file in `hair/`; for a beard also `stubble`. */
  readonly from?: string | undefined;
  /** Colour of the hair; its original colour if absent. */
  readonly colour?: HairColour | undefined;
}

/** Kind of accessory on a head. */
export type AccessoryKind = 'round-glasses' | 'square-glasses' | 'sunglasses' | 'ear-studs' | 'ear-rings' | 'nose-stud' | 'knitted-cap' | 'hat' | 'headscarf';

/** An accessory; its colour is linear, 0 to 1. */
export interface Accessory {
  readonly kind: AccessoryKind;
  readonly colour: readonly [number, number, number];
}

/** Spots of skin that are finer than its vertices. */
export type SpotKind = 'freckles' | 'stubble' | 'ageSpots' | 'moles';

/** Hair and accessories of a head. */
export interface FaceLook {
  readonly hair?: HairLook | undefined;
  readonly beard?: HairLook | undefined;
  /** Part of a beard lent by a figure, in looks of earlier versions. */
  readonly cut?: 'full' | 'moustache' | 'goatee' | undefined;
  /** Colour of brows and lashes. */
  readonly brows?: HairColour | undefined;
  readonly wear?: readonly Accessory[] | undefined;
  /** Amounts of freckles, of visible shaved hair, and of age spots, 0 to 1. */
  readonly freckles?: number | undefined;
  readonly stubble?: number | undefined;
  readonly ageSpots?: number | undefined;
  /** Number of moles. */
  readonly moles?: number | undefined;
  /** Seed of the positions of freckles, spots and moles: a whole number. */
  readonly seed?: number | undefined;
  /** Colour of the irises, linear, 0 to 1; that of the face without. */
  readonly iris?: readonly [number, number, number] | undefined;
  /** Visibility of age lines at rest, 0 to 1. */
  readonly lines?: number | undefined;
}

/** A point of the skin: three of its vertices and their weights, which sum to 1. The same point on every face. */
export interface FaceSpot {
  readonly corners: readonly [number, number, number];
  readonly shares: readonly [number, number, number];
}

/** Motif of a tattoo. */
export type TattooShape = 'star' | 'heart' | 'cross' | 'anchor' | 'dots' | 'text';

/** A mark painted on the skin. */
export interface FaceMark extends FaceSpot {
  readonly kind: 'scar' | 'mole' | 'birthmark' | 'tattoo';
  /** Length of the mark, metres. */
  readonly size: number;
  /** Turned clockwise by, radians. */
  readonly turn: number;
  /** Opacity, 0 to 1. Default: 1. */
  readonly strength?: number | undefined;
  readonly shape?: TattooShape | undefined;
  /** Letters of a tattoo. */
  readonly text?: string | undefined;
}
