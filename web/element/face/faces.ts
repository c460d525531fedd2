/** Faces as numbers: a face model and a face that is edited; fetched only by pages that edit faces. */

import instantiate from '../../pkg/faces/raconteur.js';
import wasmUrl from '../../pkg/faces/raconteur_bg.wasm?url';
import { fetchBytes, fetchModule, SCRIPT, type Progress } from '../base/fetching.js';
import type { FigureFace } from '../base/face-types.js';

/** Neither the part that edits nor a file of a pack is larger. */
const MAX_BYTES = 64e6;

/** Shape or texture. */
export type FacePart = 'shape' | 'texture';

/** Region of a change: segments by their names, on one half or both; default: the whole head. */
export interface FaceRegion {
  readonly segments?: readonly string[];
  readonly half?: 'left' | 'right' | undefined;
}

/** Attribute value held as a constraint. */
export interface FaceConstraint extends FaceRegion {
  readonly part: FacePart;
  readonly name: string;
  readonly value: number;
}

/** Contents of a pack. */
export interface FacePack {
  /** Vertices of the skin. */
  readonly vertices: number;
  /** Faces in the database. */
  readonly faces: number;
  readonly attributes: readonly {
    readonly part: FacePart;
    readonly group: string;
    readonly name: string;
    /** Terms for −1 and for 1. */
    readonly terms: readonly [string, string];
    /** Formula of an impression derived without ratings. */
    readonly derived: string | null;
  }[];
  /** Parents before their parts. */
  readonly segments: readonly { readonly name: string; readonly parent: number | null }[];
  /** People of the database faces: sex from 0 (male) to 1, years, shares of European, Asian and African ancestry. */
  readonly people: readonly { readonly sex: number; readonly ageYears: number; readonly ancestry: readonly [number, number, number] }[];
  /** Figures whose colours are known. */
  readonly figures: readonly string[];
}

/** `Faces` of `crate/faces`. */
interface Model {
  addTexture(bytes: Uint8Array): void;
  contents(): FacePack;
  average(): void;
  random(seed: number): void;
  randomPerson(seed: number): number | undefined;
  example(index: number): void;
  mask(segments: readonly string[]): Float64Array;
  segmentAt(vertex: number): string | undefined;
  value(part: FacePart, name: string): number;
  values(part: FacePart): Float64Array;
  add(part: FacePart, name: string, amount: number, withAll: boolean, segments: readonly string[], half?: string): void;
  addAlone(part: FacePart, name: string, amount: number, kept: readonly string[]): void;
  addYears(years: number, segments: readonly string[], half?: string): void;
  caricature(part: FacePart, level: number, segments: readonly string[], half?: string): void;
  importFrom(index: number, part: FacePart, segments: readonly string[], half?: string): void;
  transform(scale: Float64Array, turn: Float64Array, way: Float64Array, segments: readonly string[], half?: string): void;
  addDetail(strength: number): void;
  constrain(held: readonly FaceConstraint[]): void;
  keep(): Uint8Array;
  restore(bytes: Uint8Array): void;
  skin(moves: boolean): Float64Array;
  organs(): Float64Array;
  factors(figure: string): Float64Array | undefined;
}

interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  Faces: new (bytes: Uint8Array) => Model;
}

/** Three numbers: along or about x, y and z. */
type Vector3 = readonly [number, number, number];

/** Face model and the edited face. Methods throw an `Error` that describes the fault, and then change nothing. */
export class Faces {
  readonly #model: Model;
  readonly pack: FacePack;

  private constructor(model: Model) {
    this.#model = model;
    this.pack = model.contents();
  }

  /** Fetches the model with its shapes and, in a separate file, its textures. */
  static async open(shapes: URL, textures?: URL, { signal, progress }: { readonly signal?: AbortSignal; readonly progress?: Progress } = {}): Promise<Faces> {
    const watched = { most: MAX_BYTES, signal };
    const instance = instantiate() as unknown as Instance;
    const [module, shape, texture] = await Promise.all([
      fetchModule(new URL(wasmUrl, SCRIPT), { ...watched, what: 'The part that edits faces' }),
      fetchBytes(shapes, { ...watched, what: 'The pack of faces', progress }),
      textures === undefined ? undefined : fetchBytes(textures, { ...watched, what: 'The textures of the pack of faces' }),
    ]);
    await instance({ module_or_path: module });
    const model = new instance.Faces(shape);
    if (texture !== undefined) model.addTexture(texture);
    return new Faces(model);
  }

  average(): void {
    this.#model.average();
  }

  /** Sets a random face; the same seed, an integer, gives the same face. */
  random(seed: number): void {
    this.#model.random(seed);
  }

  /** Returns the number of the database face most similar to the random face of a seed; undefined if the pack has no records. */
  randomPerson(seed: number): number | undefined {
    return this.#model.randomPerson(seed);
  }

  /** Sets the face to one of the database. */
  example(index: number): void {
    this.#model.example(index);
  }

  /** Returns a mask: 1 for the vertices of segments and of their parts, 0 for the others. */
  mask(segments: readonly string[]): Float64Array {
    return this.#model.mask(segments);
  }

  /** Returns the smallest segment that contains a vertex; undefined for the rest of the head. */
  segmentAt(vertex: number): string | undefined {
    return this.#model.segmentAt(vertex);
  }

  /** Returns x, y and z of each vertex of the skin: metres, between the tragions, x left, y up, z front. */
  skin(): Float64Array {
    return this.#model.skin(false);
  }

  /** Returns the face's value of an attribute: 0 for the average, mostly −1 to 1. */
  value(part: FacePart, name: string): number {
    return this.#model.value(part, name);
  }

  /** Returns the face's values of all attributes of a part, in the order of `pack.attributes`. */
  values(part: FacePart): Float64Array {
    return this.#model.values(part);
  }

  /** Adds an amount of an attribute; `withAll` also adds the traits that correlate with it in people, such as a small nose with a narrow mouth. */
  add(part: FacePart, name: string, amount: number, { segments = [], half }: FaceRegion = {}, withAll = false): void {
    this.#model.add(part, name, amount, withAll, segments, half);
  }

  /**
   * Adds an amount of an attribute in isolation: a feature changes only its own segments; a trait of the whole person, sex or age, changes the face so that
   * the other such traits of its part keep their values.
   */
  addAlone(part: FacePart, name: string, amount: number, kept: readonly string[]): void {
    this.#model.addAlone(part, name, amount, kept);
  }

  /**
   * Ages the face by a number of years (negative: makes it younger), by the average change for its sex: growth to 20 years, ageing after that; ages from 8 to
   * 80.
   */
  addYears(years: number, { segments = [], half }: FaceRegion = {}): void {
    this.#model.addYears(years, segments, half);
  }

  /** Exaggerates the difference of the face from the average: above 1 a caricature, below 1 a more average face. */
  caricature(part: FacePart, level: number, { segments = [], half }: FaceRegion = {}): void {
    this.#model.caricature(part, level, segments, half);
  }

  /** Copies a region from a face of the database. */
  importFrom(index: number, part: FacePart, { segments = [], half }: FaceRegion = {}): void {
    this.#model.importFrom(index, part, segments, half);
  }

  /** Scales a region about its middle, turns it (radians) and moves it (metres). */
  transform({ scale = [1, 1, 1], turn = [0, 0, 0], way = [0, 0, 0] }: { scale?: Vector3; turn?: Vector3; way?: Vector3 }, { segments = [], half }: FaceRegion = {}): void {
    const [s, t, w] = [scale, turn, way].map((numbers) => Float64Array.from(numbers)) as [Float64Array, Float64Array, Float64Array];
    this.#model.transform(s, t, w, segments, half);
  }

  /** Adds a multiple of the texture's own detail; 0.7 is usual. */
  addDetail(strength: number): void {
    this.#model.addDetail(strength);
  }

  /** Brings the face to given attribute values; the error names the first one that conflicts with those before it. */
  constrain(held: readonly FaceConstraint[]): void {
    this.#model.constrain(held);
  }

  /** Returns the face as bytes, bit-exact. */
  keep(): Uint8Array {
    return this.#model.keep();
  }

  /** Restores a face saved by `keep` from the same pack. */
  restore(kept: Uint8Array): void {
    this.#model.restore(kept);
  }

  /**
   * Returns the face in the format of a figure, with its colours if the pack contains this figure. A face that `moves` reuses the self-intersection correction
   * of the last requested face, which takes no time; request it again when it is at rest.
   */
  face(figure: string, moves = false): FigureFace {
    return { skin: this.#model.skin(moves), organs: this.#model.organs(), factors: this.#model.factors(figure), moves };
  }
}
