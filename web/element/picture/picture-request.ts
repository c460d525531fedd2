/** How a page wants a story shown, whichever engine shows it. */

import { reducesMotion } from '../base/surroundings.js';
import type { Engine } from '../base/engine.js';
import type { Light, Quality, View } from '../base/types.js';

/** Idle life for people who ask for less motion; gestures and lips stay, they carry the story. */
const REDUCED_MOTION = 0.25;

/** What the page has asked for: a new engine, and a new story, are given it again. */
export class PictureRequest {
  quality: Quality = 'auto';
  /** The amount of idle life, where the page chooses it. */
  motion: number | undefined;
  /** What is rehearsed has room for every place of a hand. */
  roomy = true;
  /** From where the whole figure is seen. */
  view: View | undefined;
  light: { readonly name: Light; readonly turn: number } | undefined;
  /** The clock may pass the end of the story. */
  openEnded = false;
  /** Share of the height that captions take. */
  captions = 0;

  /** How much idle life, 0 to 1. */
  get life(): number {
    return this.motion ?? (reducesMotion() ? REDUCED_MOTION : 1);
  }

  /** What an engine must know before it reads a story. */
  prepare(engine: Engine): void {
    if (this.view !== undefined) applyView(engine, this.view);
    if (this.light !== undefined) engine.setLight(this.light.name, this.light.turn);
    engine.setCaptions(this.captions);
  }
}

export function applyView(engine: Engine, view: View): void {
  engine.setView(view.turn, view.tilt, view.zoom, view.right, view.up);
}
