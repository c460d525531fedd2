/** How a face is shown besides its steps: on whose body, in which light, and from where. It belongs to the session. */

import type { Light } from '../element/base/types.js';
import type { Look } from '../pages/head-view.js';

export interface Scene {
  /** Whose body, clothes and voice it is, by a name of the library; undefined for a file of the user's own, which a session does not hold. */
  readonly figure?: string | undefined;
  readonly light?: { readonly name: Light; readonly turn: number };
  readonly view?: Look;
}

/** Lamps, and what they are called. */
export const LIGHTS: Readonly<Record<Light, string>> = { stage: 'Stage', daylight: 'Window', evening: 'Lamp', studio: 'Studio' };

/** A name of the library; an address might lead anywhere. */
const NAME = /^[a-z][a-z0-9-]{0,39}$/;
/** Numbers of a scene are not larger. */
const MAX_NUMBER = 100;

export const isLibraryName = (figure: string | undefined): figure is string => figure !== undefined && NAME.test(figure);

const isRecord = (x: unknown): x is Record<string, unknown> => typeof x === 'object' && x !== null;
const isNumber = (x: unknown): x is number => typeof x === 'number' && Math.abs(x) <= MAX_NUMBER;

/** The scene of what was saved; what of it cannot be read is left as it is on stage. */
export function readScene(saved: unknown): Scene {
  const scene = isRecord(saved) ? saved['scene'] : undefined;
  if (!isRecord(scene)) return {};
  const { figure, light, view } = scene;
  return {
    ...(typeof figure === 'string' && isLibraryName(figure) ? { figure } : {}),
    ...(isRecord(light) && Object.hasOwn(LIGHTS, String(light['name'])) && isNumber(light['turn']) ? { light: { name: light['name'] as Light, turn: light['turn'] } } : {}),
    ...(isRecord(view) && isNumber(view['turn']) && isNumber(view['tilt']) && isNumber(view['zoom'])
      ? { view: { turn: view['turn'], tilt: view['tilt'], zoom: view['zoom'] } }
      : {}),
  };
}
