/** How fast pictures follow each other, and how finely each may be drawn. */

import type { Engine } from '../base/engine.js';

export class FramePacer {
  /** When the last picture of a running sequence was requested. */
  #lastAsked = 0;
  #resting = true;

  /** As if nothing had been shown yet. */
  restart(engine: Engine): void {
    this.#lastAsked = 0;
    engine.setResting((this.#resting = true));
  }

  /** A new engine goes on as the last one. */
  pass(engine: Engine): void {
    engine.setResting(this.#resting);
  }

  /** A picture that stands still, or is one of few, has the time for every pixel. */
  rest(engine: Engine, resting: boolean): void {
    if (resting !== this.#resting) engine.setResting((this.#resting = resting));
  }

  /** Tells the engine how fast pictures come while the story plays on screen; it draws more simply where they are slow. */
  keep(engine: Engine, running: boolean): void {
    const now = performance.now();
    if (running && this.#lastAsked > 0) engine.reportFrame(now - this.#lastAsked);
    this.#lastAsked = running ? now : 0;
  }
}
