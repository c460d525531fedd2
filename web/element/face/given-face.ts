/** What is on the face of the figure on stage. */

import type { FaceFile } from './avatar.js';
import { applyFace, Paint, type Lent } from './face-look.js';
import type { Engine } from '../base/engine.js';
import type { FigureFace } from '../base/face-types.js';

/** The face that a figure has got, where it is not its own, what others lend it, and what is painted on it. */
export class GivenFace {
  /** Undefined: the figure has its own. */
  face: FigureFace | undefined;
  /** The files of figures that lend it hair. */
  lent: Lent = new Map();
  #paint = new Paint();

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
    this.#paint = new Paint();
  }

  /** Paints what there is to paint; `current` says whether the engine still shows that figure. */
  async paint(engine: Engine, current: () => boolean): Promise<void> {
    const paint = this.#paint;
    await paint.put(engine, this.face ?? {}, () => current() && paint === this.#paint);
  }

  /** What a file of the figure with this face is made of; undefined while it has its own. */
  async file(name: string, glb: Uint8Array): Promise<FaceFile | undefined> {
    const { face, lent } = this;
    return face === undefined ? undefined : { name, glb, face, lent, painted: await this.#paint.file() };
  }
}
