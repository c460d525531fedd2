/** The picture: looks around the head, and its layers. */

import { html, type TemplateResult } from 'lit';
import { keySteps } from '../fields.js';
import { TURN_PER_PIXEL, zoomByKey, zoomByWheel } from '../pad.js';
import { SIDES, type Look } from '../head-view.js';
import type { App } from './app.js';
import type { Layers } from './state.js';

const LAYERS: Readonly<Record<keyof Layers, string>> = { skin: 'Skin', springs: 'Springs', muscles: 'Muscles', skull: 'Skull' };

/** A page that looks at a head. */
interface Looker {
  readonly from: Look;
  readonly zoom: number;
  look(look: Partial<Look>): void;
}

/** Dragging and arrow keys turn the head's picture. */
export function lookAround(app: Looker, pad: HTMLElement): void {
  pad.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    let last = { x: event.clientX, y: event.clientY };
    const end = new AbortController();
    pad.setPointerCapture(event.pointerId);
    const move = (now: PointerEvent): void => {
      if (now.pointerId !== event.pointerId) return;
      app.look({ turn: app.from.turn - (now.clientX - last.x) * TURN_PER_PIXEL, tilt: app.from.tilt + (now.clientY - last.y) * TURN_PER_PIXEL });
      last = { x: now.clientX, y: now.clientY };
    };
    pad.addEventListener('pointermove', move, end);
    for (const type of ['pointerup', 'pointercancel'] as const) pad.addEventListener(type, () => end.abort(), end);
  });
  zoomByWheel(pad, app);
  pad.addEventListener('keydown', (event) => {
    const by = keySteps(event);
    if (by !== undefined) app.look({ turn: app.from.turn + by[0] * 0.12, tilt: app.from.tilt + by[1] * 0.08, zoom: app.from.zoom * 1.1 ** -by[2] });
    else if (event.key === 'Home') app.look({ turn: SIDES['Three-quarter'], tilt: 0.02 });
    else if (!zoomByKey(event, app)) return;
    event.preventDefault();
  });
}

/** Sides to look from, and drawing modes. */
export function views(app: App): TemplateResult {
  const { layers } = app.state;
  const turn = (key: keyof Layers): void =>
    app.set((s) => {
      s.layers[key] = !s.layers[key];
      // Something is always there: who takes the skin away sees muscles, and the other way round.
      if (!Object.values(s.layers).some(Boolean)) s.layers[key === 'skin' ? 'muscles' : 'skin'] = true;
    });
  return html`<div class="group" role="group" aria-label="View">
      ${Object.entries(SIDES).map(([name, side]) => html`<button type="button" class="plain" aria-pressed=${Math.abs(app.from.turn - side) < 0.01} @click=${() => app.look({ turn: side })}>${name}</button>`)}
      <button type="button" class="plain" aria-label="Farther" @click=${() => app.look({ zoom: app.from.zoom / 1.2 })}>−</button>
      <button type="button" class="plain" aria-label="Nearer" @click=${() => app.look({ zoom: app.from.zoom * 1.2 })}>+</button>
    </div>
    <div class="group" role="group" aria-label="Layers">
      ${(Object.entries(LAYERS) as [keyof Layers, string][]).map(([key, name]) => html`<button type="button" class="plain" aria-pressed=${layers[key]} @click=${() => turn(key)}>${name}</button>`)}
    </div>`;
}
