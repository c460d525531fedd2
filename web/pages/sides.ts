/** Views of a stage from its sides, for pages that show gestures. */

import { html, type TemplateResult } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import type { View } from '../element/base/types.js';

/** Views of the stage, with room for a raised hand even in a narrow image; the first is the audience's. */
const SIDES: Readonly<Record<string, View | undefined>> = {
  'From the front': undefined,
  'From near by': { turn: 0, tilt: 0.05, zoom: 1.6, right: 0, up: 0.36 },
  'From its left': { turn: Math.PI / 2, tilt: 0.05, zoom: 1.7, right: -0.1, up: 0.36 },
  'From its right': { turn: -Math.PI / 2, tilt: 0.05, zoom: 1.7, right: 0.1, up: 0.36 },
  'From above': { turn: 0, tilt: 1.35, zoom: 1.55, right: 0, up: 0.3 },
};
/** Invalid view that restores the shot. */
const NO_VIEW: View = { turn: NaN, tilt: NaN, zoom: NaN, right: NaN, up: NaN };

/** Renders a menu of the views; `changed` is called after a choice. */
export function sides(player: RaconteurPlayer, changed: () => void): TemplateResult {
  const seen = (event: Event): void => {
    player.look(SIDES[(event.target as HTMLSelectElement).value] ?? NO_VIEW);
    changed();
  };
  return html`<select aria-label="Seen" @change=${seen}>${Object.keys(SIDES).map((name) => html`<option>${name}</option>`)}</select>`;
}
