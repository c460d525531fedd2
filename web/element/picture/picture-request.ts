/** Display settings of a page, independent of the engine. */

import { reducesMotion } from '../base/surroundings.js';
import type { Engine } from '../base/engine.js';
import type { Light, Quality, View } from '../base/types.js';

/** Amount of idle motion for users who prefer reduced motion; gestures and lip sync stay, because they carry the story. */
const REDUCED_MOTION = 0.25;

/** Settings requested by the page, reapplied to each new engine and story. */
export class PictureRequest {
  quality: Quality = 'auto';
  /** The amount of idle life, where the page chooses it. */
  motion: number | undefined;
  /** True if the framing of rehearsed content leaves room for every hand position. */
  roomy = true;
  /** View of the whole figure. */
  view: View | undefined;
  light: { readonly name: Light; readonly turn: number } | undefined;
  /** The clock may pass the end of the story. */
  openEnded = false;
  /** Share of the height covered by captions. */
  captions = 0;

  /** Amount of idle motion, 0 to 1. */
  get life(): number {
    return this.motion ?? (reducesMotion() ? REDUCED_MOTION : 1);
  }

  /** Applies the settings that an engine needs before it reads a story. */
  prepare(engine: Engine): void {
    if (this.view !== undefined) applyView(engine, this.view);
    if (this.light !== undefined) engine.setLight(this.light.name, this.light.turn);
    engine.setCaptions(this.captions);
  }
}

export function applyView(engine: Engine, view: View): void {
  engine.setView(view.turn, view.tilt, view.zoom, view.right, view.up);
}
