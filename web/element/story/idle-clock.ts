/**
 * Waiting figure, before a story is played and where it waits for an answer: idle animation at a low frame rate, no frames while the player is hidden, a
 * single one for users who prefer reduced motion. Waiting time is not story time. A story paused elsewhere, or at its end, stands still like a film.
 */

import { reducesMotion } from '../base/surroundings.js';

/** Maximum frame rate; breathing and glances need no more. */
const MAX_HZ = 15;
/** Maximum share of the time for rendering: slow devices render fewer frames. */
const MAX_SHARE = 0.25;
/** Maximum time between frames, milliseconds: fewer than one frame a second would look like a series of stills. */
const MAX_INTERVAL_MS = 1000;
/** Maximum time of the screen's own frame; the remainder is rendering time. */
const SCREEN_MS = 17;

/** The clock of one player's waiting. */
export class IdleClock {
  readonly #draw: () => void;
  #animation = 0;
  #waitedMs = 0;
  /** Time of the last frame, on the screen's clock. */
  #drawnMs: number | undefined;
  /** Cost of a frame, milliseconds, weighted towards the slowest recent ones. */
  #costMs = 0;
  /** True if the next callback measures the last frame. */
  #measuring = false;

  /** Creates the loop; `draw` renders the current waiting state. */
  constructor(draw: () => void) {
    this.#draw = draw;
  }

  /** Waiting time in view, seconds. */
  get secs(): number {
    return this.#waitedMs / 1000;
  }

  /** Restarts the waiting time for another reason. */
  restart(): void {
    this.#waitedMs = 0;
  }

  /** Runs only while the figure waits and is visible. */
  keep(waiting: boolean): void {
    if (waiting && this.#animation === 0 && !reducesMotion()) {
      this.#drawnMs = undefined;
      this.#measuring = false;
      this.#animation = requestAnimationFrame((now) => this.#frame(now));
    } else if (!waiting) {
      cancelAnimationFrame(this.#animation);
      this.#animation = 0;
    }
  }

  #frame(nowMs: number): void {
    this.#animation = requestAnimationFrame((now) => this.#frame(now));
    const since = nowMs - (this.#drawnMs ?? nowMs);
    // Measures the time for which the display was blocked.
    if (this.#measuring) {
      this.#measuring = false;
      this.#costMs = Math.max(since - SCREEN_MS, 0.8 * this.#costMs);
    }
    const pause = Math.min(MAX_INTERVAL_MS, Math.max(1000 / MAX_HZ, this.#costMs / MAX_SHARE));
    if (this.#drawnMs !== undefined && since < pause - 1) return;
    this.#drawnMs = nowMs;
    // After a hidden page or a long task the story continues where it was.
    this.#waitedMs += Math.min(since, MAX_INTERVAL_MS);
    this.#draw();
    this.#measuring = true;
  }
}
