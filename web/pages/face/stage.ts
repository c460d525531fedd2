/** The picture: looks around the head, and its layers. */

import { html, type TemplateResult } from 'lit';
import { keySteps } from '../fields.js';
import { SIDES, type App } from './app.js';
import type { Layers } from './state.js';

/** Turn of the view for each pixel that the pointer goes, radians. */
const TURN = 0.008;

const LAYERS: Readonly<Record<keyof Layers, string>> = { skin: 'Skin', springs: 'Springs', muscles: 'Muscles', skull: 'Skull' };

/** Dragging and arrow keys turn the head's picture. */
export function lookAround(app: App, pad: HTMLElement): void {
  pad.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    let last = { x: event.clientX, y: event.clientY };
    const end = new AbortController();
    pad.setPointerCapture(event.pointerId);
    const move = (now: PointerEvent): void => {
      if (now.pointerId !== event.pointerId) return;
      app.look({ turn: app.from.turn - (now.clientX - last.x) * TURN, tilt: app.from.tilt + (now.clientY - last.y) * TURN });
      last = { x: now.clientX, y: now.clientY };
    };
    pad.addEventListener('pointermove', move, end);
    for (const type of ['pointerup', 'pointercancel'] as const) pad.addEventListener(type, () => end.abort(), end);
  });
  pad.addEventListener(
    'wheel',
    (event) => {
      // The page scrolls unless the picture is in use.
      if (!event.ctrlKey && document.activeElement !== pad) return;
      event.preventDefault();
      app.look({ zoom: app.from.zoom * Math.exp(-event.deltaY * 0.0015) });
    },
    { passive: false },
  );
  pad.addEventListener('keydown', (event) => {
    const by = keySteps(event);
    if (by !== undefined) app.look({ turn: app.from.turn + by[0] * 0.12, tilt: app.from.tilt + by[1] * 0.08, zoom: app.from.zoom * 1.1 ** -by[2] });
    else if (event.key === '+' || event.key === '=') app.look({ zoom: app.from.zoom * 1.15 });
    else if (event.key === '-') app.look({ zoom: app.from.zoom / 1.15 });
    else if (event.key === 'Home') app.look({ turn: SIDES['Three-quarter'], tilt: 0.02 });
    else return;
    event.preventDefault();
  });
}

/** Sides to look from, and what is drawn. */
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
