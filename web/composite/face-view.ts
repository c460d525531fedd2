/** Puts the face that is edited on the figure: one at a time, soon while it changes, and with all its detail when it has come to rest. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FigureFace } from '../element/base/face-types.js';
import { wait } from './hidden-player.js';

/** Whose face has not changed for so long sees it with all its detail, milliseconds. */
const RESTED_MS = 150;

export class FaceView {
  /** The face is near the one that was shown before, and perhaps to the next. */
  moves = false;
  #now: Promise<void> | undefined;
  #behind = false;
  /** Ends the wait for a face to rest. */
  #hurry: () => void = () => undefined;

  /** `face` is asked for what is to be shown; `shown` hears when it is, or what went wrong. */
  constructor(
    private readonly player: RaconteurPlayer,
    private readonly face: () => FigureFace,
    private readonly shown: (error?: unknown) => void,
  ) {}

  /** Resolves when the stage shows the face as it was changed last. */
  get done(): Promise<void> {
    return this.#now ?? Promise.resolve();
  }

  get busy(): boolean {
    return this.#now !== undefined;
  }

  /** The face has changed; while one is put on, the next waits, and those between are never shown. */
  show(): Promise<void> {
    this.#behind = true;
    this.#hurry();
    this.#now ??= this.#show();
    return this.#now;
  }

  async #show(): Promise<void> {
    let fault: unknown;
    try {
      while (this.#behind) {
        this.#behind = false;
        const face = this.face();
        // All its detail is two pieces of work; between them the page hears its user.
        if (face.moves !== true) await wait(0);
        if (!this.#behind) await this.player.setFace(face);
        if (!this.#behind && this.moves) await this.#rest();
      }
    } catch (error) {
      fault = error;
    }
    this.#now = undefined;
    this.shown(fault);
  }

  /** Waits until the face has not changed for a while; then there is more of it to be shown. */
  async #rest(): Promise<void> {
    await new Promise<void>((resolve) => {
      const rested = setTimeout(() => {
        this.moves = false;
        this.#behind = true;
        resolve();
      }, RESTED_MS);
      this.#hurry = () => {
        clearTimeout(rested);
        resolve();
      };
    });
    this.#hurry = () => undefined;
  }
}
