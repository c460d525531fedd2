/** Display settings of a face in addition to its steps: body, light, and view. Part of the session. */

import type { Light } from '../element/base/types.js';
import type { Look } from '../pages/head-view.js';

export interface Scene {
  /** Library name of the figure with body, clothes and voice; undefined for a user's own file, which a session does not contain. */
  readonly figure?: string | undefined;
  readonly light?: { readonly name: Light; readonly turn: number };
  readonly view?: Look;
}

/** Lights, with their displayed names. */
export const LIGHTS: Readonly<Record<Light, string>> = { stage: 'Stage', daylight: 'Window', evening: 'Lamp', studio: 'Studio' };

/** Pattern of a library name; an arbitrary address is rejected. */
const NAME = /^[a-z][a-z0-9-]{0,39}$/;
/** Numbers of a scene are not larger. */
const MAX_NUMBER = 100;

export const isLibraryName = (figure: string | undefined): figure is string => figure !== undefined && NAME.test(figure);

const isRecord = (x: unknown): x is Record<string, unknown> => typeof x === 'object' && x !== null;
const isNumber = (x: unknown): x is number => typeof x === 'number' && Math.abs(x) <= MAX_NUMBER;

/** Reads the display settings of saved data; unreadable parts leave the stage unchanged. */
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
