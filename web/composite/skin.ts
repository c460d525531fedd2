/** Texture properties finer than vertex colours, or in the eyes: derived from the values of its attributes. */

import type { FaceLook } from '../element/base/face-types.js';

/** A colour, linear. */
type Rgb = readonly [number, number, number];

/** Irises from dark brown to light, and where they are light from amber to blue; as the faces of the database were made. */
const DARK: Rgb = [0.055, 0.03, 0.016];
const AMBER: Rgb = [0.3, 0.2, 0.085];
const BLUE: Rgb = [0.17, 0.27, 0.4];
/** Lightness and blueness of the average face's irises, 0 to 1, and their change per unit of the value. */
const LIGHT = [0.42, 0.5] as const;
const BLUENESS = [0.4, 0.6] as const;
/** Blue irises are lighter than brown ones. */
const LIGHTER = 0.32;
/** Value of the beard's shadow below which skin counts as shaved. */
const SHAVED = 0.05;

const clamp = (x: number): number => Math.min(1, Math.max(0, x));
const mix = (a: Rgb, b: Rgb, share: number): Rgb => [0, 1, 2].map((i) => (a[i] ?? 0) + ((b[i] ?? 0) - (a[i] ?? 0)) * share) as unknown as Rgb;

/** Value of ageing from which sun spots appear, and the further increase at which all of them are present. */
const SPOTTED = [0.1, 1.1] as const;
/** Maximum number of moles; some people have none, some half a dozen. */
const MAX_MOLES = 6;

/** Returns spots, stubble and irises of a face with these texture values; the positions of spots are unique to the face. */
export function skinOf(texture: ReadonlyMap<string, number>, seed: number): Pick<FaceLook, 'freckles' | 'stubble' | 'iris' | 'ageSpots' | 'moles' | 'seed'> {
  const of = (name: string): number => texture.get(name) ?? 0;
  const chance = Math.abs(Math.sin(seed * 12.9898) * 43_758.5453) % 1;
  const blue = of('colour of the iris');
  const light = clamp(LIGHT[0] + LIGHT[1] * of('lightness of the iris') + LIGHTER * blue);
  return {
    freckles: clamp(of('freckles')),
    ageSpots: clamp((Math.max(of('ageing'), of('age')) - SPOTTED[0]) / SPOTTED[1]),
    moles: seed === 0 ? 0 : Math.floor((MAX_MOLES + 1) * chance * chance),
    seed,
    stubble: clamp((of('beard shadow') - SHAVED) / (1 - SHAVED)),
    iris: mix(DARK, mix(AMBER, BLUE, clamp(BLUENESS[0] + BLUENESS[1] * blue)), light ** 1.3),
  };
}
