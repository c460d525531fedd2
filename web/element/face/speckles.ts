/** Freckles, age spots, moles and stubble, painted into the skin texture spot by spot. */

import type { SkinPaint } from './face-look.js';
import type { Engine } from '../base/engine.js';
import type { SpotKind } from '../base/face-types.js';

/** Count of numbers per spot in the engine's output. */
const NUMBERS = 7;
/** The fewest of all freckles that a face with some has. */
const MIN_COUNT = 0.12;
/** Rings of which a spot is painted, as parts of its radius: its border is soft. */
const RINGS = [1, 0.75, 0.5];

/** Paint of a kind of spot: minimum and maximum radius, metres; remaining share of each colour, and the strength of its ring. */
interface SpeckleColour {
  readonly radius: readonly [number, number];
  readonly colour: string;
  readonly alpha: (strength: number) => number;
}

export class Speckles {
  /** Last spots of each kind, and the seed of their positions. */
  readonly #spots = new Map<SpotKind, { readonly seed: number; readonly spots: Float32Array }>();

  #of(engine: Engine, kind: SpotKind, seed: number): Float32Array {
    const known = this.#spots.get(kind);
    if (known?.seed === seed) return known.spots;
    const spots = engine.speckles(kind, seed) ?? new Float32Array();
    this.#spots.set(kind, { seed, spots });
    return spots;
  }

  draw(context: OffscreenCanvasRenderingContext2D, engine: Engine, { freckles, stubble, grey, ageSpots, moles, seed }: SkinPaint): void {
    context.save();
    // Paint reflects a share of each colour.
    context.globalCompositeOperation = 'multiply';
    const share = (kind: SpotKind, of: number): Float32Array => {
      const spots = this.#of(engine, kind, seed);
      return spots.subarray(0, NUMBERS * Math.round((spots.length / NUMBERS) * of));
    };
    if (freckles > 0) {
      const alpha = (strength: number): number => (0.12 + 0.38 * strength) * (0.35 + 0.65 * freckles);
      this.#each(context, share('freckles', MIN_COUNT + (1 - MIN_COUNT) * freckles), { radius: [0.0004, 0.001], colour: 'rgb(198 148 114)', alpha });
    }
    if (ageSpots > 0) this.#each(context, share('ageSpots', ageSpots), { radius: [0.0009, 0.0034], colour: 'rgb(202 168 140)', alpha: (strength) => 0.18 + 0.26 * strength });
    if (moles > 0) {
      const all = this.#of(engine, 'moles', seed);
      this.#each(context, all.subarray(0, NUMBERS * moles), { radius: [0.0005, 0.0014], colour: 'rgb(104 66 48)', alpha: () => 0.55 });
    }
    if (stubble > 0) {
      const pale = Math.round(66 + 134 * grey);
      const alpha = (strength: number): number => (0.22 + 0.4 * strength) * stubble;
      this.#each(context, share('stubble', 0.35 + 0.65 * stubble), { radius: [0.0003, 0.00042], colour: `rgb(${pale} ${pale - 8} ${pale - 12})`, alpha });
    }
    context.restore();
  }

  #each(context: OffscreenCanvasRenderingContext2D, spots: Float32Array, { radius, colour, alpha }: SpeckleColour): void {
    const { width, height } = context.canvas;
    context.fillStyle = colour;
    for (let i = 0; i < spots.length; i += NUMBERS) {
      const [u = 0, v = 0, rightU = 0, rightV = 0, upU = 0, upV = 0, strength = 0] = spots.subarray(i, i + NUMBERS);
      const size = radius[0] + (radius[1] - radius[0]) * strength * strength;
      context.setTransform(rightU * width, rightV * height, -upU * width, -upV * height, u * width, v * height);
      context.globalAlpha = alpha(strength);
      for (const ring of RINGS) {
        context.beginPath();
        // No spot is round.
        context.ellipse(0, 0, size * ring, size * ring * (0.72 + 0.28 * strength), 9 * strength, 0, 2 * Math.PI);
        context.fill();
      }
    }
  }
}
