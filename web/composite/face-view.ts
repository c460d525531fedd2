/** Updates the edited face on the figure: one at a time, fast while it changes, and in full detail at rest. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FigureFace } from '../element/base/face-types.js';
import { wait } from './hidden-player.js';

/** Time without changes after which the face is shown in full detail, milliseconds. */
const RESTED_MS = 150;

export class FaceView {
  /** True if the face is close to the previous one, and perhaps to the next. */
  moves = false;
  #now: Promise<void> | undefined;
  #behind = false;
  /** Ends the wait for a face to rest. */
  #hurry: () => void = () => undefined;

  /** Creates the updater; `face` returns the face to show; `shown` is called when it is shown, or with an error. */
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

  /** Schedules an update of the face; intermediate faces during an update are skipped. */
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
        // All details take two pieces of work; the page handles input between them.
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

  /** Waits until the face has not changed for a while; then it is shown in full detail. */
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
