/** Face, hair and paint of the figure on stage. */

import { applyFace, SkinPainter, type DonorHair } from './face-look.js';
import type { Engine } from '../base/engine.js';
import type { FigureFace } from '../base/face-types.js';
import { PlayerError } from '../base/types.js';

/** Face given to a figure in place of its own, with the hair of other figures and the paint on it. */
export class GivenFace {
  /** Undefined: the figure has its own. */
  face: FigureFace | undefined;
  /** The files of figures that lend it hair. */
  lent: DonorHair = new Map();
  #paint = new SkinPainter();

  /** True if it changes continuously, so that no image of it is final. */
  get moves(): boolean {
    return this.face?.moves === true;
  }

  /** Applies it to the figure that an engine has read. Throws the engine's error if the face is not applicable. */
  apply(engine: Engine): void {
    if (this.face !== undefined) applyFace(engine, this.face, this.lent);
  }

  /** Resets the paint after the figure's images have been reloaded. */
  unpaint(): void {
    this.#paint = new SkinPainter();
  }

  /** Paints the skin; `current` returns true while the engine still shows that figure. */
  async paint(engine: Engine, current: () => boolean): Promise<void> {
    const paint = this.#paint;
    await paint.put(engine, this.face ?? {}, () => current() && paint === this.#paint);
  }

  /** Returns a file of the figure with this face, where `glb` is the file with the figure's own face; undefined while the figure has its own face. */
  async file(name: string, glb: Uint8Array): Promise<Uint8Array | undefined> {
    const { face, lent } = this;
    if (face === undefined) return undefined;
    const parts = { name, glb, face, lent, painted: await this.#paint.file() };
    // Most players never write figures.
    const { faceFile } = await import('./avatar.js').catch((error: unknown) => {
      throw new PlayerError('The part that writes figures could not be fetched: is the network available?', { cause: error });
    });
    return await faceFile(parts);
  }
}
