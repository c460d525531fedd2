/** The controls of the composite editor, tab by tab. */

import { html, nothing, type TemplateResult } from 'lit';
import { repeat } from 'lit/directives/repeat.js';
import type { FacePack, FacePart } from '../element/face/faces.js';
import { check, numberField } from '../pages/fields.js';
import type { App } from './app.js';
import type { Index } from './find.js';
import { found } from './finder.js';
import { alsoCalled } from './words.js';

type Attribute = FacePack['attributes'][number];

/** Change per press of a button for more or less. */
const STEP = 0.1;
/** Attributes go somewhat farther than people do. */
const MAX_OFFSET = 1.5;
/** A slider that is nearer to its middle is in it. */
const MIN_OFFSET = 0.005;
export const PARTS: Readonly<Record<FacePart, string>> = { shape: 'Shape', texture: 'Colour' };

// --- features ---

/** Returns the terms of an attribute with a slider between them, buttons for one step, and a toggle for its constraint. */
function feature(app: App, a: Attribute): TemplateResult {
  const { part, name, terms } = a;
  const value = app.values[part].get(name) ?? 0;
  const held = app.held.find((h) => h.part === part && h.name === name);
  const of = app.faces.pack.attributes.filter((b) => b.name === name).length > 1 ? `${name}, ${PARTS[part].toLowerCase()}` : name;
  const to = (target: number): void => {
    const amount = target - (app.settled[part].get(name) ?? 0);
    if (held === undefined) app.move({ kind: 'add', part, name, amount, ...app.manner });
    else app.move({ kind: 'hold', held: app.held.map((h) => (h === held ? { ...h, value: target } : h)) });
  };
  const step = (by: number): void => {
    to(Math.min(MAX_OFFSET, Math.max(-MAX_OFFSET, value + by)));
    app.done();
  };
  const hold = (): void => {
    app.do({ kind: 'hold', held: held === undefined ? [...app.held, { part, name, value, ...app.region }] : app.held.filter((h) => h !== held) });
  };
  const also = name === 'age' ? `about ${app.yearsOf(value)} years by ${part === 'shape' ? 'its form' : 'its skin'}` : alsoCalled(a);
  return html`<div class=${held === undefined ? 'feature' : 'feature fixed'} title=${a.derived ?? ''}>
    <div class="ends" aria-hidden="true"><span>${terms[0]}</span><span>${terms[1]}</span></div>
    ${also === '' ? nothing : html`<small class="also">${also}</small>`}
    ${numberField({ label: of, value, min: -MAX_OFFSET, max: MAX_OFFSET, step: 0.01, text: termOf(value, terms), set: to, done: () => app.done() })}
    <div class="steps">
      <button type="button" class="plain" aria-label="${of}: less" title=${terms[0]} @click=${() => step(-STEP)}>−</button>
      <button type="button" class="plain" aria-label="${of}: more" title=${terms[1]} @click=${() => step(STEP)}>+</button>
      <button type="button" class="plain" aria-label="Hold ${of}" aria-pressed=${held !== undefined} @click=${hold}>Hold</button>
    </div>
    ${app.apart ? asymmetry(app, a, of) : nothing}
  </div>`;
}

/** Renders the asymmetry control of a feature: more on the left, and less on the right. At the slider's middle, both halves are as the feature has them. */
function asymmetry(app: App, { part, name }: Attribute, of: string): TemplateResult {
  const { history, sliding } = app;
  const slider = `asymmetry of ${part} ${name}`;
  const before = history.asymmetryAt(history.here, part, name);
  const value = sliding?.name === slider ? sliding.amount : before;
  return html`<div class="apart">${numberField({
    label: 'Left − right',
    of,
    value,
    min: -1,
    max: 1,
    step: 0.01,
    text: Math.abs(value) < MIN_OFFSET ? 'both alike' : `${Math.round(100 * Math.abs(value))} percent more ${value > 0 ? 'left' : 'right'}`,
    set: (amount) => {
      app.sliding = { name: slider, amount };
      app.move({ kind: 'asymmetry', part, name, amount: amount - before, region: { segments: [...app.segments] } });
    },
    done: () => {
      app.sliding = undefined;
      app.done();
    },
  })}</div>`;
}

/** Describes the value of an attribute. Between the average and none of something there is less of it. */
export function termOf(value: number, [less, more]: Attribute['terms']): string {
  const percent = Math.round(100 * Math.abs(value));
  if (percent === 0) return 'average';
  if (value > 0) return `${percent} percent ${more}`;
  if (less !== 'none') return `${percent} percent ${less}`;
  return percent >= 100 ? 'none' : `${percent} percent less than average`;
}

export function features(app: App, index: Index): TemplateResult {
  const { attributes } = app.faces.pack;
  const groups = [...new Set(attributes.map((a) => a.group))];
  const word = app.search.trim();
  const {
    features: shown,
    ways,
    isElsewhere,
  } = word === '' ? { features: attributes.filter((a) => a.group === app.group), ways: nothing, isElsewhere: false } : found(app, index, word);
  const search = (event: Event): void => {
    app.search = (event.target as HTMLInputElement).value;
    app.redraw();
  };
  const choose = (event: Event): void => {
    app.group = (event.target as HTMLSelectElement).value;
    app.search = '';
    app.redraw();
  };
  return html`<div class="row bar">
      <label class="select side"><span>Group</span><select @change=${choose}>${groups.map((group) => html`<option value=${group} .selected=${group === app.group}>${group}</option>`)}</select></label>
      <label class="select side"><span>Search</span><input type="search" .value=${app.search} placeholder="moustache, friendly …" autocomplete="off" @input=${search} /></label>
    </div>
    ${isElsewhere || shown.length === 0 ? ways : nothing}
    ${shown.length === 0 ? nothing : manner(app)}
    ${(Object.keys(PARTS) as FacePart[]).map((part) => {
      const own = shown.filter((a) => a.part === part);
      return own.length === 0
        ? nothing
        : html`<section class="region" aria-label=${PARTS[part]}><h3>${PARTS[part]}</h3>${repeat(
            own,
            ({ name }) => name,
            (a) => feature(app, a),
          )}</section>`;
    })}
    ${isElsewhere || shown.length === 0 ? nothing : ways}`;
}

/** Returns the controls for the scope of feature changes. */
function manner(app: App): TemplateResult {
  return html`${check('With correlated features', app.withAll, (on) => {
    app.withAll = on;
    app.redraw();
  })}
    ${check('Left and right apart', app.apart, (on) => {
      app.apart = on;
      app.redraw();
    })}
    <p class="about">${target(app)} <em>Hold</em> keeps a feature as it is, whatever else changes.</p>`;
}

/** Returns a description of the current target of changes. */
function target(app: App): string {
  const of = app.half === undefined ? '' : `, ${app.half} half`;
  if (app.segments.size > 0) return `Changes ${[...app.segments].join(', ')}${of}.`;
  return app.withAll ? `The rest of the face changes too${of}, as it does in people.` : `A feature changes alone${of}: its own part of the face moves, and nothing else.`;
}

// --- stored state ---

export function heldList(app: App): TemplateResult {
  const { held } = app;
  if (held.length === 0) return html`<p class="none">Nothing is held. <em>Hold</em> next to a feature keeps its value, whatever else you change.</p>`;
  return html`<ul class="held">
      ${held.map(
        (
          h,
        ) => html`<li><span><b>${h.name}</b>, ${PARTS[h.part].toLowerCase()}: ${h.value.toFixed(2)}${(h.segments ?? []).length === 0 ? '' : ` by ${(h.segments ?? []).join(', ')}`}</span>
          <button type="button" class="plain" aria-label="Release ${h.name}" @click=${() => app.do({ kind: 'hold', held: held.filter((other) => other !== h) })}>Release</button></li>`,
      )}
    </ul>
    <button type="button" class="plain" @click=${() => app.do({ kind: 'hold', held: [] })}>Release all</button>`;
}
