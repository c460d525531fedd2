/** Parts of a face on a figure in addition to its numbers: hair lent by other figures, and paint on its skin. */

import type { PaintedSkin } from './marks.js';
import type { Engine } from '../base/engine.js';
import type { FaceLook, FigureFace } from '../base/face-types.js';

/** Hair values that are not file names: the figure's own, none, permanently none, and painted hair. */
const NOT_LENT: readonly string[] = ['', 'own', 'none', 'bald'];

/** Hair formerly lent by figures, before it had files of its own. */
export const FORMER_HAIR: Readonly<Record<string, string>> = { sofia: 'bob', lia: 'long', amara: 'bun', kenji: 'crop', nuno: 'tousled', papous: 'swept' };
/** Beards formerly lent by one figure, by extent. */
const FORMER_BEARDS = { full: 'full', moustache: 'moustache', goatee: 'goatee' } as const;
/** Name of the beard that is painted on the skin. */
const STUBBLE = 'stubble';

/** Names of hair and beards of the library that a face needs. */
export function lendersOf({ look }: FigureFace): string[] {
  const { hair, beard } = plainLook(look) ?? {};
  const names = [hair?.from, beard?.from === STUBBLE ? undefined : beard?.from].filter((name) => name !== undefined && !NOT_LENT.includes(name));
  return [...new Set(names as string[])];
}

/** Returns a look with present hair names, and without keys that have no value: to engines such a key has one. */
export function plainLook(look: FaceLook | undefined): FaceLook | undefined {
  if (look === undefined) return undefined;
  const { cut = 'full', ...plain } = JSON.parse(JSON.stringify(look)) as FaceLook;
  const [hair, beard] = [FORMER_HAIR[plain.hair?.from ?? ''], Object.hasOwn(FORMER_HAIR, plain.beard?.from ?? '') ? FORMER_BEARDS[cut] : undefined];
  return { ...plain, ...(hair && { hair: { ...plain.hair, from: hair } }), ...(beard && { beard: { ...plain.beard, from: beard } }) };
}

/** Returns a look as engines read it, without painted parts, which have no strands. */
export function toldLook(look: FaceLook | undefined): FaceLook | undefined {
  const plain = plainLook(look);
  return plain?.beard?.from === STUBBLE ? { ...plain, beard: { ...plain.beard, from: 'none' } } : plain;
}

/** Files of hair, by name. */
export type DonorHair = ReadonlyMap<string, Uint8Array>;

/** Sets a face on the figure that an engine has read. Throws the engine's error for an incompatible face. */
export function applyFace(engine: Engine, face: FigureFace, lent: DonorHair): void {
  const { skin, organs, factors, look, moves = false } = face;
  for (const name of lendersOf(face)) {
    const glb = lent.get(name);
    if (glb !== undefined && !engine.hasDonor(name)) engine.addDonor(name, glb, skin.length / 3);
  }
  engine.setFace(skin, organs, factors ?? new Float64Array(), toldLook(look), moves);
}

/** Skin paint other than marks. */
export interface SkinPaint {
  /** 0 to 1. */
  readonly freckles: number;
  readonly stubble: number;
  /** Greyness of stubble, 0 to 1. */
  readonly grey: number;
  /** 0 to 1. */
  readonly ageSpots: number;
  /** Number of moles. */
  readonly moles: number;
  /** Seed of the positions of freckles, spots and moles. */
  readonly seed: number;
}

/** Number of steps of freckles and stubble: smaller changes are not repainted. */
const STEPS = 25;
/** Strength of the painted stubble under each beard: under a beard of tufts the skin looks shaved. */
const UNDER: Readonly<Record<string, number>> = { [STUBBLE]: 1, full: 0.8, boxed: 0.9 };
/** Maximum number of moles. */
const MAX_MOLES = 12;
const stepped = (x: number): number => Math.round(Math.min(1, Math.max(0, x)) * STEPS) / STEPS;

/** Returns the paint of a look. */
export function paintOf(look: FaceLook | undefined): SkinPaint {
  const { freckles = 0, stubble = 0, ageSpots = 0, moles = 0, seed = 0, hair, beard } = plainLook(look) ?? {};
  const grey = (beard?.colour ?? hair?.colour)?.grey ?? 0;
  return {
    freckles: stepped(freckles),
    stubble: stepped(Math.max(stubble, UNDER[beard?.from ?? ''] ?? 0)),
    grey: stepped(grey),
    ageSpots: stepped(ageSpots),
    moles: Math.min(MAX_MOLES, Math.max(0, Math.round(moles))),
    seed,
  };
}

const textOf = ({ marks = [], look }: Partial<FigureFace>): string => {
  const { hair, beard } = plainLook(look) ?? {};
  const { freckles, stubble, grey, ageSpots, moles, seed } = paintOf(look);
  const isOwn = freckles > 0 || ageSpots > 0 || moles > 0;
  return JSON.stringify([marks, hair?.from ?? 'own', hair?.colour ?? null, beard?.from ?? 'own', freckles, stubble, stubble > 0 ? grey : 0, ageSpots, moles, isOwn ? seed : 0]);
};

/** The text of no marks, and of the figure's own hair and skin. */
const NOTHING = textOf({});

/** The paint on the skin of one figure. */
export class SkinPainter {
  /** Present paint, as text, with its level of detail. */
  #painted = NOTHING;
  #isFine = true;
  #fine: PaintedSkin | undefined;
  #soon: PaintedSkin | undefined;

  /**
   * Paints marks, spots, stubble, and the scalp under other hair on the skin that an engine shows; existing paint is not repeated. The paint of a moving face
   * is fast rather than fine. `current` returns false if the figure has been replaced.
   */
  async put(engine: Engine, face: Partial<FigureFace>, current: () => boolean): Promise<void> {
    const wanted = textOf(face);
    const isFine = face.moves !== true;
    if (wanted === this.#painted && (this.#isFine || !isFine)) return;
    [this.#painted, this.#isFine] = [wanted, isFine];
    // Most players never paint.
    const { openSkin } = await import('./marks.js');
    const skin = isFine ? (this.#fine ??= await openSkin(engine, true)) : (this.#soon ??= await openSkin(engine, false));
    if (skin === undefined || !current() || wanted !== this.#painted || isFine !== this.#isFine) return;
    skin.paint(engine, face.marks ?? [], paintOf(face.look));
  }

  /** Returns the painted image as a JPEG; undefined if nothing is painted. */
  async file(): Promise<Uint8Array | undefined> {
    return this.#painted === NOTHING ? undefined : await this.#fine?.file();
  }
}
