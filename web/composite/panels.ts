/** The controls of the composite editor, tab by tab. */

import { html, nothing, type TemplateResult } from 'lit';
import type { FacePack, FacePart } from '../element/faces.js';
import { check, choice, numberField } from '../pages/fields.js';
import type { App } from './app.js';
import { label } from './acts.js';

type Attribute = FacePack['attributes'][number];

/** One press of a button for more or less. */
const STEP = 0.1;
/** Attributes go somewhat farther than people do. */
const FARTHEST = 1.5;
const PARTS: Readonly<Record<FacePart, string>> = { shape: 'Shape', texture: 'Colour' };

// --- features ---

/** The terms of an attribute with a slider between them, buttons for one step, and one that holds it. */
function feature(app: App, a: Attribute): TemplateResult {
  const { part, name, terms } = a;
  const value = app.values[part].get(name) ?? 0;
  const held = app.held.find((h) => h.part === part && h.name === name);
  const of = app.faces.pack.attributes.filter((b) => b.name === name).length > 1 ? `${name}, ${PARTS[part].toLowerCase()}` : name;
  const to = (target: number): void => {
    if (held === undefined) app.move({ kind: 'add', part, name, amount: target - (app.settled[part].get(name) ?? 0), region: app.region, withAll: app.withAll });
    else app.move({ kind: 'hold', held: app.held.map((h) => (h === held ? { ...h, value: target } : h)) });
  };
  const step = (by: number): void => {
    to(Math.min(FARTHEST, Math.max(-FARTHEST, value + by)));
    app.done();
  };
  const hold = (): void => {
    app.do({ kind: 'hold', held: held === undefined ? [...app.held, { part, name, value, ...app.region }] : app.held.filter((h) => h !== held) });
  };
  return html`<div class=${held === undefined ? 'feature' : 'feature fixed'} title=${a.derived ?? ''}>
    <div class="ends" aria-hidden="true"><span>${terms[0]}</span><span>${terms[1]}</span></div>
    ${numberField({ label: of, value, min: -FARTHEST, max: FARTHEST, step: 0.01, text: told(value, terms), set: to, done: () => app.done() })}
    <div class="steps">
      <button type="button" class="plain" aria-label="${of}: less" title=${terms[0]} @click=${() => step(-STEP)}>−</button>
      <button type="button" class="plain" aria-label="${of}: more" title=${terms[1]} @click=${() => step(STEP)}>+</button>
      <button type="button" class="plain" aria-label="Hold ${of}" aria-pressed=${held !== undefined} @click=${hold}>Hold</button>
    </div>
  </div>`;
}

function told(value: number, [less, more]: Attribute['terms']): string {
  const percent = Math.round(100 * Math.abs(value));
  return percent === 0 ? 'average' : `${percent} percent ${value < 0 ? less : more}`;
}

export function features(app: App): TemplateResult {
  const { attributes } = app.faces.pack;
  const groups = [...new Set(attributes.map((a) => a.group))];
  const word = app.search.trim().toLowerCase();
  const found =
    word === '' ? attributes.filter((a) => a.group === app.group) : attributes.filter((a) => [a.name, a.group, ...a.terms].some((text) => text.toLowerCase().includes(word)));
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
      <label class="select side"><span>Search</span><input type="search" .value=${app.search} placeholder="nose, friendly …" autocomplete="off" @input=${search} /></label>
    </div>
    ${check('With what goes with it in people', app.withAll, (on) => {
      app.withAll = on;
      app.redraw();
    })}
    <p class="about">${target(app)}</p>
    ${found.length === 0 ? html`<p class="none">No feature is called so.</p>` : nothing}
    ${(Object.keys(PARTS) as FacePart[]).map((part) => {
      const own = found.filter((a) => a.part === part);
      return own.length === 0 ? nothing : html`<section class="region" aria-label=${PARTS[part]}><h3>${PARTS[part]}</h3>${own.map((a) => feature(app, a))}</section>`;
    })}`;
}

/** What is changed now. */
function target(app: App): string {
  const of = app.half === undefined ? '' : `, ${app.half} half`;
  return app.segments.size === 0 ? `Changes the whole head${of}.` : `Changes ${[...app.segments].join(', ')}${of}.`;
}

// --- parts ---

/** What dragging on the picture does. */
const DRAGS = { view: 'turns the head', move: 'moves', turn: 'turns', scale: 'scales' } as const;
const HALVES = { both: 'Both', left: 'Left', right: 'Right' } as const;

export function parts(app: App): TemplateResult {
  const { segments } = app.faces.pack;
  const toggle = (name: string, on: boolean): void => {
    if (on) app.segments.add(name);
    else app.segments.delete(name);
    app.chosen();
  };
  const depth = (i: number): number => {
    const parent = segments[i]?.parent;
    return parent == null ? 0 : 1 + depth(parent);
  };
  return html`<p class="about">Press on the face, with Shift for more than one: features, moves, ageing and caricature keep to what is chosen, and blend at its border.</p>
    <fieldset class="segments"><legend class="unseen">Segments of the face</legend>
      ${segments.map(({ name }, i) => html`<div class="depth${depth(i)}">${check(name, app.segments.has(name), (on) => toggle(name, on))}</div>`)}
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
    ${check('Lit on the face', app.lit, (on) => {
      app.lit = on;
      app.chosen();
    })}
    ${choice('drag', 'Dragging on the face', app.drag, DRAGS, (drag) => {
      app.drag = drag;
      app.redraw();
    })}
    ${moves(app)} ${wholes(app)}`;
}

/** Moves of what is chosen: each slider is back in its middle when it rests. */
function moves(app: App): TemplateResult {
  const none = { scale: [1, 1, 1], turn: [0, 0, 0], way: [0, 0, 0] } as const;
  const slider = (name: string, most: number, unit: string, change: (amount: number) => Partial<Record<keyof typeof none, readonly [number, number, number]>>): TemplateResult =>
    numberField({
      label: name,
      value: app.sliding?.name === name ? app.sliding.amount : 0,
      min: -most,
      max: most,
      step: most / 50,
      unit,
      set: (amount) => {
        app.sliding = { name, amount };
        app.move({ kind: 'transform', ...none, ...change(amount), region: app.region });
      },
      done: () => {
        app.sliding = undefined;
        app.done();
      },
    });
  const mm = 1e-3;
  const degree = Math.PI / 180;
  return html`<section class="region" aria-label="Moves"><h3>Move, turn, scale</h3>
    <div class="numbers">
      ${slider('Sideways', 8, 'mm', (x) => ({ way: [x * mm, 0, 0] }))} ${slider('Up', 8, 'mm', (y) => ({ way: [0, y * mm, 0] }))}
      ${slider('Forwards', 8, 'mm', (z) => ({ way: [0, 0, z * mm] }))} ${slider('Tilt', 15, '°', (a) => ({ turn: [0, 0, a * degree] }))}
      ${slider('Size', 30, '%', (s) => ({ scale: [1 + s / 100, 1 + s / 100, 1 + s / 100] }))} ${slider('Breadth', 30, '%', (s) => ({ scale: [1 + s / 100, 1, 1] }))}
      ${slider('Height', 30, '%', (s) => ({ scale: [1, 1 + s / 100, 1] }))}
    </div>
  </section>`;
}

/** What is done to all that is chosen at once. */
function wholes(app: App): TemplateResult {
  const { region } = app;
  const button = (name: string, act: Parameters<App['do']>[0]): TemplateResult => html`<button type="button" class="plain" @click=${() => app.do(act)}>${name}</button>`;
  return html`<section class="region" aria-label="Age and caricature"><h3>Age and caricature</h3>
    <div class="group" role="group" aria-label="Age">${button('Younger', { kind: 'age', amount: -0.2, region })} ${button('Older', { kind: 'age', amount: 0.2, region })}</div>
    ${(Object.entries(PARTS) as [FacePart, string][]).map(
      ([part, name]) => html`<div class="group" role="group" aria-label="Caricature of ${name.toLowerCase()}"><span class="what">${name}</span>
        ${button('More of itself', { kind: 'caricature', part, level: 1.15, region })} ${button('More like everybody', { kind: 'caricature', part, level: 0.85, region })}</div>`,
    )}
    <div class="group" role="group" aria-label="Detail">${button('Sharper skin', { kind: 'detail', strength: 0.7 })} ${button('Softer skin', { kind: 'detail', strength: -0.4 })}</div>
  </section>`;
}

// --- what is held ---

export function heldList(app: App): TemplateResult {
  const { held } = app;
  if (held.length === 0) return html`<p class="none">Nothing is held. <em>Hold</em> beside a feature keeps its value, whatever else you change.</p>`;
  return html`<ul class="held">
      ${held.map(
        (
          h,
        ) => html`<li><span><b>${h.name}</b>, ${PARTS[h.part].toLowerCase()}: ${h.value.toFixed(2)}${(h.segments ?? []).length === 0 ? '' : ` by ${(h.segments ?? []).join(', ')}`}</span>
          <button type="button" class="plain" aria-label="Let go of ${h.name}" @click=${() => app.do({ kind: 'hold', held: held.filter((other) => other !== h) })}>Let go</button></li>`,
      )}
    </ul>
    <button type="button" class="plain" @click=${() => app.do({ kind: 'hold', held: [] })}>Let go of all</button>`;
}

// --- history ---

/** Steps that are listed around the present one. */
const LISTED = 200;

export function historyList(app: App): TemplateResult {
  const { history } = app;
  const { steps, here } = history;
  const on = new Set(history.path());
  const first = Math.max(0, Math.min(steps.length - LISTED, here - LISTED / 2));
  const named = steps.flatMap((step, i) => (step.name === undefined ? [] : [{ i, name: step.name }]));
  const entry = (i: number, text: string): TemplateResult =>
    html`<li class=${on.has(i) ? '' : 'aside'}><button type="button" class="plain" aria-current=${i === here ? 'step' : 'false'} @click=${() => app.goTo(i)}>${text}</button></li>`;
  const name = (event: Event): void => {
    event.preventDefault();
    const input = (event.currentTarget as HTMLFormElement).querySelector('input');
    app.name(input?.value.trim() ?? '');
  };
  return html`<form class="line" @submit=${name}>
      <label class="select"><span>Name this face</span><input type="text" maxlength="60" .value=${steps[here]?.name ?? ''} autocomplete="off" /></label><button type="submit" class="plain">Name</button>
    </form>
    ${named.length === 0 ? nothing : html`<h3>Named</h3><ul class="steps-list">${named.map(({ i, name: own }) => entry(i, own))}</ul>`}
    <h3>${steps.length === 1 ? 'Nothing was changed' : `${steps.length - 1} steps`}</h3>
    <ol class="steps-list" aria-label="Steps">${steps.slice(first, first + LISTED).map((step, i) => entry(first + i, step.name ?? label(step.act)))}</ol>`;
}
