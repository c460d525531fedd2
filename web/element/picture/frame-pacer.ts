/** Frame rate and rendering quality. */

import type { Engine } from '../base/engine.js';

export class FramePacer {
  /** Time of the last requested frame of a running sequence. */
  #lastAsked = 0;
  #resting = true;

  /** Resets as if no frame had been shown. */
  restart(engine: Engine): void {
    this.#lastAsked = 0;
    engine.setResting((this.#resting = true));
  }

  /** Transfers the state to a new engine. */
  pass(engine: Engine): void {
    engine.setResting(this.#resting);
  }

  /** Selects full quality for a still frame, or one of few. */
  rest(engine: Engine, resting: boolean): void {
    if (resting !== this.#resting) engine.setResting((this.#resting = resting));
  }

  /** Reports the frame rate of visible playback to the engine, which reduces the quality if it is low. */
  keep(engine: Engine, running: boolean): void {
    const now = performance.now();
    if (running && this.#lastAsked > 0) engine.reportFrame(now - this.#lastAsked);
    this.#lastAsked = running ? now : 0;
  }
}
