/** Descriptions of hair, beard, accessories, marks and light, for reports. */

import type { FaceMark, HairColour, NaturalHair } from '../element/base/face-types.js';
import type { App } from './app.js';
import { plainLook } from '../element/face/face-look.js';
import { BEARDS, HAIR, MARKS, SHAPES, WEAR } from './look.js';
import { LIGHTS } from './scene.js';

const DEGREE = Math.PI / 180;
/** Minimum share of grey; below it hair counts as not grey. */
const MIN_GREY = 0.005;

/** Describes a colour by the nearest natural one and its grey. */
export function colourWords(colour: HairColour | undefined, natural: readonly NaturalHair[]): string | undefined {
  if (colour === undefined) return undefined;
  const far = (n: NaturalHair): number => Math.hypot(n.colour.eumelanin - colour.eumelanin, n.colour.pheomelanin - colour.pheomelanin);
  const nearest = [...natural].sort((a, b) => far(a) - far(b))[0];
  const grey = colour.grey < MIN_GREY ? undefined : colour.grey === 1 ? 'white' : `${Math.round(100 * colour.grey)} percent grey`;
  return [colour.grey === 1 ? undefined : nearest?.name, grey].filter((word) => word !== undefined).join(', ') || undefined;
}

const joined = (...words: readonly (string | undefined)[]): string => words.filter((word) => word !== undefined).join(', ');

function markOf({ kind, size, shape, text }: FaceMark): string {
  const motif = kind !== 'tattoo' ? '' : shape === 'text' ? ` “${text ?? ''}”` : ` ${SHAPES[shape ?? 'star'].toLowerCase()}`;
  return `${MARKS[kind].name.toLowerCase()}${motif}, ${Math.round(1000 * size)} mm`;
}

/** Returns the properties of a head in addition to its features, and its light. */
export function lookFacts({ look, marks, light }: Pick<App, 'look' | 'marks' | 'light'>, natural: readonly NaturalHair[]): [name: string, text: string][] {
  // Sessions of before name hair and beards by the figures that lent them.
  const { hair, beard } = plainLook(look) ?? {};
  const styleOf = (names: Readonly<Record<string, string>>, from = 'own'): string => names[from] ?? from;
  const turned = Math.round(light.turn / DEGREE);
  const worn = (look.wear ?? []).map(({ kind }) => WEAR[kind].name.toLowerCase());
  return [
    ['Hair', joined(styleOf(HAIR, hair?.from), colourWords(hair?.colour, natural))],
    ['Beard', joined(styleOf(BEARDS, beard?.from), colourWords(beard?.colour, natural))],
    ['Brows and lashes', colourWords(look.brows, natural) ?? 'as they are'],
    ['Accessories', worn.join(', ') || 'nothing'],
    ['Marks', marks.map(markOf).join('; ') || 'none'],
    ['Light', joined(LIGHTS[light.name], turned === 0 ? undefined : `turned by ${Math.abs(turned)}° to the ${turned > 0 ? 'left' : 'right'}`)],
  ];
}
