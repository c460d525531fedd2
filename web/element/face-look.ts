/** What a face on a figure needs beside its numbers: hair that other figures lend, and paint on its skin. */

import type { PaintedSkin } from './marks.js';
import type { Engine, FaceLook, FigureFace } from './types.js';

/** Figures that lend hair to a face, by name. */
export function lendersOf({ look }: FigureFace): string[] {
  const names = [look?.hair?.from, look?.beard?.from].filter((name) => name !== undefined && !['', 'own', 'none'].includes(name));
  return [...new Set(names as string[])];
}

/** A look as engines read it: to them a key whose value is undefined has a value. */
export function plainLook(look: FaceLook | undefined): FaceLook | undefined {
  return look === undefined ? undefined : (JSON.parse(JSON.stringify(look)) as FaceLook);
}

/** Files of figures that lend hair, by name. */
export type Lent = ReadonlyMap<string, Uint8Array>;

/** Gives the figure that an engine has read a face. Throws what the engine says of a face that it cannot have. */
export function applyFace(engine: Engine, face: FigureFace, lent: Lent): void {
  const { skin, organs, factors, look } = face;
  for (const name of lendersOf(face)) {
    const glb = lent.get(name);
    if (glb !== undefined && !engine.lends(name)) engine.lend(name, glb, skin.length / 3);
  }
  engine.setFace(skin, organs, factors ?? new Float64Array(), plainLook(look));
}

/** The text of no marks and of hair in the figure's own colour. */
const NOTHING = '[[],null]';

/** The paint on the skin of one figure. */
export class Paint {
  /** What is painted now, as text. */
  #painted = NOTHING;
  #skin: PaintedSkin | undefined;

  /** Paints marks, and the scalp of coloured hair, on the skin that an engine shows; what is there already is not painted again. `current` says whether the figure is still that one. */
  async put(engine: Engine, { marks = [], look }: Partial<FigureFace>, current: () => boolean): Promise<void> {
    const wanted = JSON.stringify([marks, look?.hair?.colour ?? null]);
    if (wanted === this.#painted) return;
    this.#painted = wanted;
    // Most players never paint.
    const { openSkin } = await import('./marks.js');
    this.#skin ??= await openSkin(engine);
    if (this.#skin === undefined || !current() || wanted !== this.#painted) return;
    this.#skin.paint(engine, marks);
  }

  /** The painted picture as a JPEG; undefined where nothing is painted. */
  async file(): Promise<Uint8Array | undefined> {
    return this.#painted === NOTHING ? undefined : await this.#skin?.file();
  }
}
