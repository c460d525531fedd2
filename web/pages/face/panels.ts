/** Sliders of muscles, of direct controls, and of visemes. */

import { html, nothing, type TemplateResult } from 'lit';
import { check, numberField } from '../fields.js';
import type { App } from './app.js';
import { namesOf, type FaceControl, type Region } from './dials.js';
import { AMOUNTS, type Amount } from './manner.js';

function slider(app: App, dial: FaceControl, names: readonly string[], label: string): TemplateResult {
  const value = app.state.values[names[0] ?? ''] ?? 0;
  const set = (to: number): void =>
    app.change((s) => {
      for (const name of names) {
        if (to === 0) delete s.values[name];
        else s.values[name] = to;
      }
    });
  return html`<div class=${value === 0 ? 'dial' : 'dial used'} title=${dial.note}>
    ${numberField({ label, value, min: dial.signed ? -1 : 0, max: 1, step: 0.01, text: `${Math.round(100 * value)} percent, ${dial.note}`, set, done: () => app.done() })}
  </div>`;
}

/** Renders a dial: one slider for both sides while they are linked, else one for each. */
function control(app: App, dial: FaceControl): TemplateResult {
  const names = namesOf(dial);
  if (!dial.paired || app.state.linked) return slider(app, dial, names, dial.label);
  return html`${names.map((name) => slider(app, dial, [name], `${dial.label}, ${name.endsWith('Left') ? 'left' : 'right'}`))}`;
}

/** Regions of a tab, each open to all that it has. */
export function regions(app: App, list: readonly Region[], note: string): TemplateResult {
  const { values, linked } = app.state;
  const all = list.flatMap((region) => region.dials);
  const used = all.flatMap(namesOf).filter((name) => values[name]);
  return html`<div class="row bar">
      ${all.some((d) => d.paired) ? check('Left and right together', linked, (on) => link(app, on)) : nothing}
      <button type="button" class="plain" ?disabled=${used.length === 0} @click=${() => app.set((s) => used.forEach((name) => delete s.values[name]))}>Reset all</button>
    </div>
    <p class="about">${note}</p>
    ${list.map(
      (region) => html`<section class="region" aria-label=${region.title}>
        <h3>${region.title}</h3>
        <div class="numbers">${region.dials.map((dial) => control(app, dial))}</div>
      </section>`,
    )}`;
}

/** Links the sides, or unlinks them. Linked sides are equal: the right one follows the left. */
function link(app: App, on: boolean): void {
  app.set((s) => {
    s.linked = on;
    if (!on) return;
    for (const name of Object.keys(s.values).filter((n) => n.endsWith('Right') && s.values[n.replace(/Right$/, 'Left')] === undefined)) delete s.values[name];
    for (const [name, value] of Object.entries(s.values)) if (name.endsWith('Left')) s.values[name.replace(/Left$/, 'Right')] = value;
  });
}

/** Renders the slider of an amount of accompanying expression. */
function amount(app: App, own: Amount): TemplateResult {
  const { name, label, note, least, most, step, usual } = own;
  const value = app.state.manner[name] ?? usual;
  const set = (to: number): void =>
    app.change((s) => {
      if (to === usual) delete s.manner[name];
      else s.manner[name] = to;
    });
  return html`<div class=${value === usual ? 'dial' : 'dial used'} title=${note}>
    ${numberField({ label, value, min: least, max: most, step, text: `${value}, ${note}; usually ${usual}`, set, done: () => app.done() })}
  </div>`;
}

/** Renders the settings of expressions that accompany speech: source, amount and frequency. */
export function manner(app: App): TemplateResult {
  const isUsual = Object.keys(app.state.manner).length === 0;
  return html`<div class="row bar">
      <button type="button" class="plain" ?disabled=${isUsual} @click=${() => app.set((s) => (s.manner = {}))}>Reset to defaults</button>
    </div>
    <p class="about">Movements of head, brows and eyes during speech. The defaults are the published amounts. Let the figure speak to see them.</p>
    ${AMOUNTS.map(
      (group) => html`<section class="region" aria-label=${group.title}>
        <h3>${group.title}</h3>
        <div class="numbers">${group.amounts.map((own) => amount(app, own))}</div>
      </section>`,
    )}`;
}
