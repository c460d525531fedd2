/** Freckles and stubble, painted into the picture of the skin spot by spot. */

import type { SkinPaint } from './face-look.js';
import type { Engine } from './types.js';

type Kind = 'freckles' | 'stubble';

/** Numbers of one spot, as an engine tells it. */
const NUMBERS = 7;
/** Radius of a freckle, least and most, and of a shaved hair, metres. */
const FRECKLE_M = [0.0004, 0.0011] as const;
const HAIR_M = 0.00052;
/** The fewest of all freckles that a face with some has. */
const FEWEST = 0.12;

export class Speckles {
  /** Places are the same on every face. */
  readonly #spots = new Map<Kind, Float32Array>();

  #of(engine: Engine, kind: Kind): Float32Array {
    const known = this.#spots.get(kind) ?? engine.speckles(kind) ?? new Float32Array();
    this.#spots.set(kind, known);
    return known;
  }

  draw(context: OffscreenCanvasRenderingContext2D, engine: Engine, { freckles, stubble, grey }: SkinPaint): void {
    context.save();
    // Paint is what is left of each colour.
    context.globalCompositeOperation = 'multiply';
    if (freckles > 0) {
      context.fillStyle = 'rgb(190 136 100)';
      const share = FEWEST + (1 - FEWEST) * freckles;
      this.#each(context, this.#of(engine, 'freckles'), share, (strength) => {
        context.globalAlpha = (0.25 + 0.55 * strength) * (0.45 + 0.55 * freckles);
        return FRECKLE_M[0] + (FRECKLE_M[1] - FRECKLE_M[0]) * strength * strength;
      });
    }
    if (stubble > 0) {
      const pale = Math.round(66 + 134 * grey);
      context.fillStyle = `rgb(${pale} ${pale - 8} ${pale - 12})`;
      this.#each(context, this.#of(engine, 'stubble'), 0.35 + 0.65 * stubble, (strength) => {
        context.globalAlpha = (0.3 + 0.5 * strength) * stubble;
        return HAIR_M;
      });
    }
    context.restore();
  }

  /** Draws the first share of spots, each with the radius that `radius` tells of its strength, metres. */
  #each(context: OffscreenCanvasRenderingContext2D, spots: Float32Array, share: number, radius: (strength: number) => number): void {
    const { width, height } = context.canvas;
    const count = Math.round((spots.length / NUMBERS) * share);
    for (let i = 0; i < count; i += 1) {
      const [u = 0, v = 0, rightU = 0, rightV = 0, upU = 0, upV = 0, strength = 0] = spots.subarray(i * NUMBERS, (i + 1) * NUMBERS);
      const size = radius(strength);
      context.setTransform(rightU * width, rightV * height, -upU * width, -upV * height, u * width, v * height);
      context.beginPath();
      context.arc(0, 0, size, 0, 2 * Math.PI);
      context.fill();
    }
  }
}
