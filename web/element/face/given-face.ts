/** What is on the face of the figure on stage. */

import { applyFace, SkinPainter, type DonorHair } from './face-look.js';
import type { Engine } from '../base/engine.js';
import type { FigureFace } from '../base/face-types.js';
import { PlayerError } from '../base/types.js';

/** The face that a figure has got, where it is not its own, what others lend it, and what is painted on it. */
export class GivenFace {
  /** Undefined: the figure has its own. */
  face: FigureFace | undefined;
  /** The files of figures that lend it hair. */
  lent: DonorHair = new Map();
  #paint = new SkinPainter();

  /** It changes, so that no picture of it stands still. */
  get moves(): boolean {
    return this.face?.moves === true;
  }

  /** Gives it to the figure that an engine has read. Throws what the engine says of a face that it cannot have. */
  apply(engine: Engine): void {
    if (this.face !== undefined) applyFace(engine, this.face, this.lent);
  }

  /** The figure's pictures have come anew: nothing is painted on them. */
  unpaint(): void {
    this.#paint = new SkinPainter();
  }

  /** Paints what there is to paint; `current` says whether the engine still shows that figure. */
  async paint(engine: Engine, current: () => boolean): Promise<void> {
    const paint = this.#paint;
    await paint.put(engine, this.face ?? {}, () => current() && paint === this.#paint);
  }

  /** A file of the figure, of which `glb` is the one with its own face, with this face; undefined while it has its own. */
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
