/**
 * Before a story is played, and where it waits for an answer, the figure waits, alive: pictures of it at a low rate, none where
 * the player is hidden, one for people who ask for less motion. How long it has waited is no story
 * time.
 *
 * A story that rests elsewhere in its middle or at its end stands still, as a film does.
 */

import { reducesMotion } from '../base/surroundings.js';

/** Breath and glances need no more pictures a second. */
const MAX_HZ = 15;
/** The share of the time that pictures may take: a device that draws slowly draws fewer of them. */
const MAX_SHARE = 0.25;
/** But one a second; fewer would be a row of stills. */
const MIN_SPEED_MS = 1000;
/** What a screen takes for a picture of its own, at most; the rest is our own time. */
const SCREEN_MS = 17;

/** The clock of one player's waiting. */
export class IdleClock {
  readonly #draw: () => void;
  #animation = 0;
  #waitedMs = 0;
  /** When the last picture was drawn, on the screen's clock. */
  #drawnMs: number | undefined;
  /** What pictures take, milliseconds, the slowest of late counting most. */
  #costMs = 0;
  /** The next callback tells what the last picture took. */
  #measuring = false;

  /** `draw` draws the present moment of waiting. */
  constructor(draw: () => void) {
    this.#draw = draw;
  }

  /** How long the figure has waited in view, seconds. */
  get secs(): number {
    return this.#waitedMs / 1000;
  }

  /** The figure begins to wait for something else. */
  restart(): void {
    this.#waitedMs = 0;
  }

  /** Runs while the figure waits and is seen, and else not at all. */
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
    // How long the screen was held up.
    if (this.#measuring) {
      this.#measuring = false;
      this.#costMs = Math.max(since - SCREEN_MS, 0.8 * this.#costMs);
    }
    const pause = Math.min(MIN_SPEED_MS, Math.max(1000 / MAX_HZ, this.#costMs / MAX_SHARE));
    if (this.#drawnMs !== undefined && since < pause - 1) return;
    this.#drawnMs = nowMs;
    // After a hidden page or a long task it goes on where it was.
    this.#waitedMs += Math.min(since, MIN_SPEED_MS);
    this.#draw();
    this.#measuring = true;
  }
}
