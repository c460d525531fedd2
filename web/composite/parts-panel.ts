/** Panel of face segments, and the operations on the selected ones. */

import { html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import type { FacePart } from '../element/face/faces.js';
import { check, choice, numberField } from '../pages/fields.js';
import type { Act } from './acts.js';
import type { App } from './app.js';
import { PARTS } from './panels.js';
import type { SegmentPictures } from './segment-pictures.js';

/** Effects of dragging on the image. */
const DRAGS = { view: 'turns the head', move: 'moves', turn: 'turns', scale: 'scales' } as const;
const HALVES = { both: 'Both', left: 'Left', right: 'Right' } as const;

export function parts(app: App, pictures: SegmentPictures): TemplateResult {
  const { segments } = app.faces.pack;
  const toggle = (name: string, on: boolean): void => {
    if (on) app.segments.add(name);
    else app.segments.delete(name);
    app.chosen();
  };
  return html`<p class="about">Click on the face, with Shift for more than one segment: features, moves, ageing and caricature are limited to the selection, and blend at its border.</p>
    <fieldset class="segments"><legend class="unseen">Segments of the face</legend>
      ${segments.map(({ name }) => tile(name, pictures.pictureOf(name), app.segments.has(name), (on) => toggle(name, on)))}
    </fieldset>
    <div class="row bar">
      ${choice('half', 'Halves', app.half ?? 'both', HALVES, (half) => {
        app.half = half === 'both' ? undefined : half;
        app.chosen();
      })}
      <button type="button" class="plain" ?disabled=${app.segments.size === 0 && app.half === undefined} @click=${() => {
        app.segments.clear();
        app.half = undefined;
        app.chosen();
      }}>Whole head</button>
    </div>
    ${check('Highlight on the face', app.lit, (on) => {
      app.lit = on;
      app.chosen();
    })}
    ${choice('drag', 'Dragging on the face', app.drag, DRAGS, (drag) => {
      app.drag = drag;
      app.redraw();
    })}
    ${moves(app)} ${wholes(app)}`;
}

/** Returns a segment tile with its image. */
function tile(name: string, picture: string | undefined, on: boolean, toggle: (on: boolean) => void): TemplateResult {
  return html`<label><img src=${picture ?? nothing} width="56" height="72" alt="" />
    <input type="checkbox" .checked=${live(on)} @change=${(event: Event) => toggle((event.target as HTMLInputElement).checked)} /><span>${name}</span></label>`;
}

/** Returns the sliders for moving the selection: each returns to its middle at rest. */
function moves(app: App): TemplateResult {
  const slider = resting(app);
  const none = { scale: [1, 1, 1], turn: [0, 0, 0], way: [0, 0, 0] } as const;
  const move = (name: string, most: number, unit: string, change: (amount: number) => Partial<Record<keyof typeof none, readonly [number, number, number]>>): TemplateResult =>
    slider({ name, most, unit, act: (amount) => ({ kind: 'transform', ...none, ...change(amount), region: app.region }) });
  const mm = 1e-3;
  const degree = Math.PI / 180;
  return html`<section class="region" aria-label="Moves"><h3>Move, turn, scale</h3>
    <div class="numbers">
      ${move('Sideways', 8, 'mm', (x) => ({ way: [x * mm, 0, 0] }))} ${move('Up', 8, 'mm', (y) => ({ way: [0, y * mm, 0] }))}
      ${move('Forwards', 8, 'mm', (z) => ({ way: [0, 0, z * mm] }))} ${move('Tilt', 15, '°', (a) => ({ turn: [0, 0, a * degree] }))}
      ${move('Size', 30, '%', (s) => ({ scale: [1 + s / 100, 1 + s / 100, 1 + s / 100] }))} ${move('Breadth', 30, '%', (s) => ({ scale: [1 + s / 100, 1, 1] }))}
      ${move('Height', 30, '%', (s) => ({ scale: [1, 1 + s / 100, 1] }))}
    </div>
  </section>`;
}

/** Returns the operations on the whole selection. */
function wholes(app: App): TemplateResult {
  const { region } = app;
  const slider = resting(app);
  const told = (less: string, more: string) => (percent: number) => (percent === 0 ? 'as it is' : `${Math.abs(percent)} percent ${percent < 0 ? less : more}`);
  return html`<section class="region" aria-label="Age and caricature"><h3>Age and caricature</h3>
    <div class="numbers">
      ${slider({ name: 'Age', most: 100, unit: '%', text: told('younger', 'older'), act: (s) => ({ kind: 'age', amount: s / 100, region }) })}
      ${(Object.entries(PARTS) as [FacePart, string][]).map(([part, name]) =>
        slider({
          name: `Caricature, ${name.toLowerCase()}`,
          most: 100,
          unit: '%',
          text: told('more like everybody', 'more of itself'),
          act: (s) => ({ kind: 'caricature', part, level: 1 + s / 100, region }),
        }),
      )}
      ${slider({ name: 'Detail of the skin', most: 150, unit: '%', text: told('softer', 'sharper'), act: (s) => ({ kind: 'detail', strength: s / 100 }) })}
    </div>
    <p class="about">Dragging shows a preview; releasing makes one step. Detail applies to the whole head.</p>
  </section>`;
}

/** A slider whose middle is the face as it is. */
interface CentredSlider {
  readonly name: string;
  readonly most: number;
  readonly unit: string;
  readonly text?: (amount: number) => string;
  readonly act: (amount: number) => Act;
}

/** Returns sliders that preview while dragged, add a step on release, and then return to the middle. */
function resting(app: App): (slider: CentredSlider) => TemplateResult {
  return ({ name, most, unit, text, act }) => {
    const value = app.sliding?.name === name ? app.sliding.amount : 0;
    return numberField({
      label: name,
      value,
      min: -most,
      max: most,
      step: most / 50,
      unit,
      ...(text === undefined ? {} : { text: text(value) }),
      set: (amount) => {
        app.sliding = { name, amount };
        app.move(act(amount));
      },
      done: () => {
        app.sliding = undefined;
        app.done();
      },
    });
  };
}
