/** Panel of manipulators: a limb, its control, and the parameters of it (GEVH 3.3). */

import { html, nothing, type TemplateResult } from 'lit';
import { check, choice, numberField } from '../fields.js';
import type { App } from './app.js';
import { menu } from './fields.js';
import { LIMB_NAMES, RANGES, type DriveMode, type Limb, type State, type MotionMode } from './state.js';

const LEADS: Readonly<Record<DriveMode, string>> = { free: 'Nobody', place: 'A target', joints: 'Its joints' };

const ABOUT: Readonly<Record<DriveMode, string>> = {
  free: 'It moves with animations and idle motion. Drag its handle in the picture, or choose what drives it.',
  place: 'Drag the handle in the picture, or move it with the arrow keys, page up and page down.',
  joints: 'Each joint separately, within human limits.',
};

const WAYS: Readonly<Record<MotionMode, string>> = { joints: 'joint by joint', line: 'in a straight line', velocity: 'by inverse velocity' };

const AXES = ['To the left', 'Up', 'To the back'] as const;
const ANGLES = ['Yaw', 'Pitch', 'Roll'] as const;

export function manipulators(app: App): TemplateResult {
  const { limb: name, state } = app;
  const limb = state.limbs[name];
  const of = (s: State): Limb => s.limbs[name];
  const who = LIMB_NAMES[name].toLowerCase();
  const lead = (next: DriveMode): void => {
    if (next !== 'free') app.lead(name, next);
    app.set((s) => (of(s).lead = next));
  };
  return html`${choice('limb', 'Limb', name, LIMB_NAMES, (next) => {
    app.limb = next;
    app.redraw();
  })}
    ${choice('lead', 'Driven by', limb.lead, LEADS, lead)}
    <p class="about">${ABOUT[limb.lead]}</p>
    ${limb.lead === 'place' ? target(app, of, who) : limb.lead === 'joints' ? joints(app, of, who) : nothing}
    ${
      limb.lead === 'free'
        ? nothing
        : html`<div class="row">
          ${check('Joint limits', limb.limits, (on) => app.set((s) => (of(s).limits = on)))}
          ${limb.lead === 'place' && name !== 'head' ? check('Hold it there', limb.lock, (on) => app.set((s) => (of(s).lock = on)), ' while the body moves') : nothing}
        </div>
        <div class="row">
          ${limb.lead === 'place' ? menu('Movement', limb.way, WAYS, (way) => app.set((s) => (of(s).way = way))) : nothing}
          <button type="button" class="plain" @click=${() => watch(app)}>Watch it move</button>
          <button type="button" class="plain" @click=${() => lead('free')}>Release</button>
        </div>`
    }`;
}

/** Plays the script from the beginning, when limbs start to move. */
function watch(app: App): void {
  app.restart();
  app.player.play().catch(() => undefined);
}

function target(app: App, of: (state: State) => Limb, who: string): TemplateResult {
  const { place, angles } = of(app.state);
  const field = (list: 'place' | 'angles', i: number, label: string, least: number, most: number, unit: string): TemplateResult =>
    numberField({
      label,
      of: who,
      value: (list === 'place' ? place : angles)[i] ?? 0,
      min: least,
      max: most,
      step: list === 'place' ? 0.1 : 1,
      unit,
      set: (value) => app.change((s) => (of(s)[list][i] = value)),
      done: () => app.done(),
    });
  const ranges = [
    [-50, 50],
    [0, 100],
    [-50, 50],
  ] as const;
  return html`<div class="numbers" role="group" aria-label="Position of the target, in units of the figure, which is 77 tall">
      ${AXES.map((label, i) => field('place', i, label, ranges[i]?.[0] ?? 0, ranges[i]?.[1] ?? 0, 'u'))}
    </div>
    <div class="numbers" role="group" aria-label="Orientation of the target">
      ${ANGLES.map((label, i) => field('angles', i, label, -180, 180, '°'))}
    </div>`;
}

function joints(app: App, of: (state: State) => Limb, who: string): TemplateResult {
  const { limits } = of(app.state);
  return html`<div class="numbers" role="group" aria-label="Angles of the joints">
    ${RANGES[app.limb].map(({ name, least, most }, i) =>
      numberField({
        label: name,
        of: who,
        value: of(app.state).joints[i] ?? 0,
        min: limits ? Math.ceil(least) : -180,
        max: limits ? Math.floor(most) : 180,
        step: 1,
        unit: '°',
        set: (value) => app.change((s) => (of(s).joints[i] = value)),
        done: () => app.done(),
      }),
    )}
  </div>`;
}
