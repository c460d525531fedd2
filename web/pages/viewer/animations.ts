/** The panel of animations: weighted layers, body groups, or two stances (GEVH 3.2). */

import { html, nothing, type TemplateResult } from 'lit';
import { choice, numberField } from '../fields.js';
import type { App } from './app.js';
import { aboutClip, clipTitle } from './clips.js';
import { clipMenu, menu } from './fields.js';
import { ends, GROUP_NAMES, GROUPS, MAX_LAYERS, track, type Mechanism, type State, type Style, type Track } from './state.js';

const MECHANISMS: Readonly<Record<Mechanism, string>> = { layers: 'Layers', groups: 'Body groups', stances: 'Stances', none: 'None' };

const ABOUT: Readonly<Record<Mechanism, string>> = {
  layers: 'Several animations at once, each with a weight. The weights are scaled to a sum of 1.',
  groups: 'Each part of the body plays its own animation.',
  stances: 'Two stances, and the blend between them.',
  none: 'No animation plays; only idle motion remains.',
};

const STYLES: Readonly<Record<Style, string>> = {
  loop: 'repeatedly',
  loopReverse: 'backwards, repeatedly',
  pingPong: 'back and forth',
  iterations: 'a number of times, then hold',
  iterationsReverse: 'backwards a number of times, then hold',
  temporaryIterations: 'a number of times, then remove',
  temporaryIterationsReverse: 'backwards a number of times, then remove',
};

export function animations(app: App): TemplateResult {
  const { state } = app;
  const panels = { layers: () => layers(app), groups: () => groups(app), stances: () => stances(app), none: () => nothing };
  return html`${choice('mechanism', 'Play', state.mechanism, MECHANISMS, (mechanism) => app.set((s) => (s.mechanism = mechanism)))}
    <p class="about">${ABOUT[state.mechanism]}</p>
    ${panels[state.mechanism]()}
    ${
      state.mechanism === 'none'
        ? nothing
        : numberField({
            label: 'Cross-fade',
            value: state.swapSecs,
            min: 0,
            max: 2,
            step: 0.05,
            unit: 's',
            text: state.swapSecs === 0 ? 'at once' : `${state.swapSecs} seconds`,
            set: (secs) => app.change((s) => (s.swapSecs = secs)),
            done: () => app.done(),
          })
    }`;
}

/** Changes a track; a finite animation restarts, otherwise it might already be over. */
function put(app: App, of: (state: State) => Track, change: Partial<Track>): void {
  app.set((s) => Object.assign(of(s), change));
  if (ends(of(app.state).style)) app.restart();
}

/** Renders the playback settings of a track's animation. */
function playing(app: App, name: string, of: (state: State) => Track): TemplateResult {
  const { style, times, speed } = of(app.state);
  return html`<div class="row">
      ${menu(`Plays`, style, STYLES, (next) => put(app, of, { style: next }))}
      ${
        ends(style)
          ? html`<label class="select"><span>Times</span><input type="number" min="1" max="100" .value=${String(times)} @change=${(event: Event) => put(app, of, { times: Math.min(100, Math.max(1, Math.round(Number((event.target as HTMLInputElement).value)) || 1)) })} /></label>`
          : nothing
      }
    </div>
    ${numberField({ label: 'Speed', of: name, value: speed, min: -2, max: 3, step: 0.05, unit: '×', set: (value) => app.change((s) => (of(s).speed = value)), done: () => app.done() })}`;
}

function layers(app: App): TemplateResult {
  const { layers } = app.state;
  const heard = layers.filter((layer) => layer.on && layer.clip !== '');
  const sum = heard.reduce((total, layer) => total + layer.weight, 0);
  return html`<ol class="tracks">
      ${layers.map((layer, i) => {
        const name = `layer ${i + 1}`;
        const of = (s: State): Track => s.layers[i] ?? layer;
        const share = heard.includes(layer) && sum > 0 ? Math.round((100 * layer.weight) / sum) : 0;
        return html`<li class=${layer.on ? '' : 'off'}>
          <div class="row">
            ${clipMenu(`Layer ${i + 1}`, layer.clip, undefined, (clip) => put(app, of, { clip }))}
            <button type="button" class="switch" aria-pressed=${layer.on} @click=${() => app.set((s) => (of(s).on = !layer.on))} aria-label="Layer ${i + 1} enabled">${layer.on ? 'On' : 'Off'}</button>
            <button type="button" class="plain" ?disabled=${layers.length === 1} @click=${() => app.set((s) => s.layers.splice(i, 1))} aria-label="Remove layer ${i + 1}">Remove</button>
          </div>
          <p class="about">${aboutClip(layer.clip)}</p>
          ${numberField({
            label: 'Weight',
            of: name,
            value: layer.weight,
            min: 0,
            max: 1,
            step: 0.01,
            text: `${layer.weight}, ${share} percent of the total`,
            set: (weight) => app.change((s) => (of(s).weight = weight)),
            done: () => app.done(),
          })}
          <div class="share" aria-hidden="true"><progress max="100" value=${share}></progress><span>${share} %</span></div>
          <details><summary>How it plays</summary>${playing(app, name, of)}</details>
        </li>`;
      })}
    </ol>
    <button type="button" class="plain" ?disabled=${layers.length >= MAX_LAYERS} @click=${() => app.set((s) => s.layers.push(track('wave', { weight: 0.5 })))}>Add a layer</button>`;
}

function groups(app: App): TemplateResult {
  return html`<ul class="tracks groups">
    ${GROUPS.map((group) => {
      const of = (s: State): Track => s.groups[group];
      const { clip } = of(app.state);
      return html`<li>
        ${clipMenu(GROUP_NAMES[group], clip, 'Nothing', (next) => put(app, of, { clip: next }))}
        ${clip === '' ? nothing : html`<details><summary>How ${clipTitle(clip).toLowerCase()} plays</summary>${playing(app, GROUP_NAMES[group].toLowerCase(), of)}</details>`}
      </li>`;
    })}
  </ul>`;
}

function stances(app: App): TemplateResult {
  const { from, to, blend } = app.state.stances;
  return html`<div class="row two">
      ${clipMenu('From', from, undefined, (clip) => app.set((s) => (s.stances.from = clip)))}
      ${clipMenu('To', to, undefined, (clip) => app.set((s) => (s.stances.to = clip)))}
    </div>
    ${numberField({ label: 'Blend', value: blend, min: 0, max: 1, step: 0.01, text: `${Math.round(100 * blend)} percent of the second`, set: (value) => app.change((s) => (s.stances.blend = value)), done: () => app.done() })}
    <p class="about">A moving animation stands still at its beginning.</p>`;
}
