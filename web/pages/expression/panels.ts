/** Controls of a setting, and the rules that it triggers. */

import { html, nothing, type TemplateResult } from 'lit';
import { check, choice, numberField, vars } from '../fields.js';
import type { App } from './app.js';
import { BANDS, bandOf, rulesOf, formatNumber, type Rule } from './rules.js';
import { settingOf, type Channels, type StageSet, type Side } from './state.js';
import { BAD, GOOD, POTENTIAL_STEP, STRONGEST, type EmotionName } from './types.js';

const SETS: Readonly<Record<StageSet, string>> = { curtain: 'Curtain', fireside: 'Fireside', garden: 'Garden', night: 'Night', school: 'School' };
const CHANNELS: Readonly<Record<keyof Channels, string>> = { camera: 'Camera', light: 'Light', music: 'Music' };
const SIDES: Readonly<Record<Side, string>> = { a: 'A', b: 'B' };

const named = <T extends string>(names: readonly T[]): Record<T, T> => Object.fromEntries(names.map((name) => [name, name])) as Record<T, T>;

/** Renders all types in their groups: one set of radio buttons. */
export function types(app: App): TemplateResult {
  const { emotion } = app.edited;
  const choose = (to: EmotionName): void => app.set(app.edit((s) => (s.emotion = to)));
  const group = (label: string, names: readonly EmotionName[]): TemplateResult => choice<EmotionName>('emotion', label, emotion, named(names), choose);
  return html`<div class="types">${group('Positive', GOOD)}${group('Negative', BAD)}${group('None', ['neutral'])}</div>`;
}

/** Renders the tick on the slider at which the shot changes. */
const tick = ({ from }: { readonly from: number }): TemplateResult => html`<li ${vars({ '--share': String(from / STRONGEST) })}>${formatNumber(from)}</li>`;

/** Renders strength, channels and set. */
export function setting(app: App): TemplateResult {
  const { emotion, potential, set } = app.edited;
  const channel = (name: keyof Channels): TemplateResult => check(CHANNELS[name], app.edited[name], (on) => app.set(app.edit((s) => (s[name] = on))));
  return html`<div class=${emotion === 'neutral' ? 'strength idle' : 'strength'}>
      ${numberField({
        label: 'Potential',
        value: potential,
        min: 0,
        max: STRONGEST,
        step: POTENTIAL_STEP,
        text: `${formatNumber(potential)}, ${bandOf(potential).name}`,
        set: (value) => app.change(app.edit((s) => (s.potential = value))),
        done: () => app.done(),
      })}
      <ul class="ticks" aria-hidden="true">${BANDS.slice(1).map(tick)}</ul>
    </div>
    <div class="channels" role="group" aria-label="Channels in addition to the face"><span class="name" aria-hidden="true">Channels</span>${(Object.keys(CHANNELS) as (keyof Channels)[]).map(channel)}</div>
    <div class="channels" role="group" aria-label="How closely the light follows the thesis">
      <span class="name" aria-hidden="true">Colour</span>${check('To the letter', app.edited.thesis, (on) => app.set(app.edit((s) => (s.thesis = on))))}
    </div>
    ${choice('set', 'Set', set, SETS, (to) => app.set(app.edit((s) => (s.set = to))))}`;
}

/** Renders the switch for comparison, and the choice of the edited setting. */
export function comparison(app: App): TemplateResult {
  const { compares, edits } = app.state;
  return html`<div class="group comparison" role="group" aria-label="Two settings">
    <button type="button" class="plain" aria-pressed=${compares} @click=${() => app.compare(!compares)}>Compare</button>
    ${compares ? choice('edits', 'Edit', edits, SIDES, (to) => app.set((s) => (s.edits = to))) : nothing}
  </div>`;
}

const NAMES: Readonly<Record<Rule['channel'], string>> = { feeling: 'Emotion', ...CHANNELS };

function rule({ channel, text, source, color }: Rule): TemplateResult {
  const lamp = color === undefined ? nothing : html`<span class="lamp" ${vars({ '--lamp': color })}></span>`;
  return html`<li class=${source === '' ? 'silent' : ''}><b>${NAMES[channel]}</b><span>${lamp}${text}${source === '' ? nothing : html` <small>${source}</small>`}</span></li>`;
}

/** Renders the rules of each player on stage at its current time. */
export function rules(app: App): TemplateResult {
  const { compares } = app.state;
  const list = (side: Side): TemplateResult | typeof nothing => {
    const { player } = app.sittings[side];
    const { expressed } = player;
    if (expressed === undefined) return nothing;
    const heading = compares ? html`<h3>${SIDES[side]}</h3>` : nothing;
    // Screen readers announce the changes of a control, but not every number during playback.
    return html`<div>${heading}<ul aria-live=${player.paused ? 'polite' : 'off'}>${rulesOf(expressed, settingOf(app.state, side)).map(rule)}</ul></div>`;
  };
  return html`<div class="lists">${app.shown.map(list)}</div>`;
}

/** Renders the button that plays from before the emotion starts: the camera moves, light and mood follow. */
export const fromStart = (app: App): TemplateResult =>
  html`<button type="button" class="plain" ?disabled=${app.player.readyState < 2} @click=${() => app.playAll()}>From the start</button>`;
