/** The editors of the selected phase: one panel for each step. */

import { html, nothing, type TemplateResult } from 'lit';
import { choice } from '../fields.js';
import { tabAt } from '../tabs.js';
import type { App, Tab } from './app.js';
import { ball, inWords } from './ball.js';
import { courseField } from './course.js';
import {
  addKey,
  addPhase,
  inSequence,
  ownTime,
  removeKey,
  removePhase,
  setCourse,
  setDuration,
  setHands,
  setKeyTime,
  setPhase,
  setSpace,
  setStart,
  written,
  type Handedness,
} from './edit.js';
import { numberField } from './fields.js';
import { PHASES, toldApart, type Feature, type Key, type Phase, type PhaseName, type Vector3, type Value } from './gesture.js';
import { ORIENTATIONS, orientationName, orientationOf } from './orientations.js';
import { wristNow } from './overlay.js';
import type { Palms } from './palm.js';
import { shapeName, shapePicker, shapePicture } from './shapes.js';
import { keyInWords, LANES } from './timeline.js';

export const TABS: Readonly<Record<Tab, string>> = { phase: 'Phase', shape: 'Hand shape', palm: 'Palm', place: 'Place', course: 'Course' };

/** Renders the steps as tabs, and the panel of the selected one. */
export function panels(app: App): TemplateResult {
  const { phase } = app;
  const names = Object.keys(TABS) as Tab[];
  const walk = (event: KeyboardEvent): void => {
    const to = tabAt(event.key, names, app.tab);
    if (to === undefined) return;
    event.preventDefault();
    app.selectTab(to);
    document.getElementById(`tab-${to}`)?.focus();
  };
  return html`<div class="tabs" role="tablist" aria-label="Steps" @keydown=${walk}>
      ${names.map(
        (
          tab,
        ) => html`<button type="button" role="tab" id="tab-${tab}" aria-selected=${tab === app.tab ? 'true' : 'false'} aria-controls="panel" tabindex=${tab === app.tab ? '0' : '-1'} @click=${() => app.selectTab(tab)}>
          ${TABS[tab]}
        </button>`,
      )}
    </div>
    <div class="panel" role="tabpanel" id="panel" aria-labelledby="tab-${app.tab}" tabindex="-1">${phase === undefined ? nothingYet(app) : panel(app, phase)}</div>`;
}

function nothingYet(app: App): TemplateResult {
  return html`<p class="none">The text has no gesture that could be edited here: a <code>gesture-key</code> in the <code>body</code> of an <code>eml</code>.</p>
    ${app.gesture.body === undefined ? nothing : html`<button type="button" class="plain" @click=${() => app.change(addPhase(app.editor.text, app.gesture, 'stroke', undefined))}>Begin with a stroke</button>`}`;
}

function panel(app: App, phase: Phase): TemplateResult {
  if (app.tab === 'phase') return phasePanel(app, phase);
  if (app.tab === 'course') return coursePanel(app);
  const feature = app.tab;
  const key = app.key(feature);
  const name = phase.name === undefined ? 'this gesture' : `the ${PHASES[phase.name].toLowerCase()}`;
  return html`${hands(app, phase)}
    ${
      key === undefined
        ? html`<p class="none">${phase.name === 'retraction' || phase.name === 'partial-retraction' ? `In ${name} the hand returns to rest automatically.` : `${capital(name)} has no key here: the ${LANES[feature].toLowerCase()} stays unchanged.`}</p>`
        : keyRow(app, phase, feature, key)
    }
    ${key === undefined ? nothing : feature === 'shape' ? shapePanel(app, key) : feature === 'palm' ? palmPanel(app, key) : placePanel(app, key)}
    ${adding(app, phase, feature, key)}`;
}

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** Renders the choice of the edited hand, if each has its own track. */
function hands(app: App, phase: Phase): TemplateResult | typeof nothing {
  return toldApart(phase) ? choice('hand', 'Hand', app.hand, { right: 'Right', left: 'Left' }, (hand) => (app.hand = hand)) : nothing;
}

/** Renders the keys of a track and the time of the edited one. */
function keyRow(app: App, phase: Phase, feature: Feature, key: Key): TemplateResult {
  const keys = app.track(feature)?.keys ?? [];
  return html`<div class="key-row">
    ${keys.length > 1 ? choice('key', 'Key', String(keys.indexOf(key)), Object.fromEntries(keys.map((k, i) => [String(i), `${written(k.secs)} s`])), (i) => app.selectKey(app.phaseIndex, feature, Number(i))) : nothing}
    ${numberField({
      label: 'When',
      value: key.secs,
      min: 0,
      max: phase.durationSecs,
      step: 0.01,
      unit: 's',
      set: (secs) => {
        const live = app.key(feature);
        if (app.phase !== undefined && live !== undefined) app.drag(setKeyTime(app.phase, live, secs));
      },
      done: () => app.done(),
    })}
  </div>`;
}

/** Returns the initial value of a new key: the current state of the hand. */
function valueNow(app: App, feature: Feature): Value {
  const near =
    app.key(feature)?.value ??
    [...app.gesture.phases]
      .slice(0, app.phaseIndex)
      .reverse()
      .flatMap((p) => p.tracks.filter((t) => t.feature === feature))
      .at(0)
      ?.keys.at(-1)?.value;
  if (feature === 'place') return { place: wristNow(app, app.track('place')?.world ?? false) ?? near?.place ?? [-9, 18, -12] };
  if (near !== undefined) return near;
  return feature === 'shape' ? { shape: { id: 0, weight: 0.5 } } : { palm: { normal: [1, 0, 0], angle: 90 } };
}

function adding(app: App, phase: Phase, feature: Feature, key: Key | undefined): TemplateResult {
  const start = phase.startSecs ?? 0;
  const within = Math.min(phase.durationSecs, Math.max(0, Math.round((app.secs - start) * 100) / 100));
  const taken = app.track(feature)?.keys.some((k) => Math.abs(k.secs - within) < 0.02);
  // If the time already has a key, the next key goes to the end, or half-way back to the previous
  // one.
  const last = app.track(feature)?.keys.at(-1)?.secs ?? 0;
  const secs = !taken ? within : last < phase.durationSecs - 0.02 ? phase.durationSecs : Math.round(50 * (within === 0 ? last : within)) / 100;
  const add = (): void => {
    app.change(addKey(app.editor.text, app.gesture, phase, feature, app.hand, secs, valueNow(app, feature), toldApart(phase)));
    const index = app.track(feature)?.keys.findIndex((k) => Math.abs(k.secs - secs) < 0.006) ?? 0;
    app.selectKey(app.phaseIndex, feature, Math.max(0, index));
  };
  const remove = (): void => {
    const track = app.track(feature);
    if (track !== undefined && key !== undefined) app.change(removeKey(app.editor.text, phase, track, key));
  };
  return html`<div class="row">
    <button type="button" class="plain" @click=${add}>Add a key at ${written(secs)} s</button>
    ${key === undefined ? nothing : html`<button type="button" class="plain" @click=${remove}>Remove this key</button>`}
  </div>`;
}

function shapePanel(app: App, key: Key): TemplateResult {
  const shape = key.value.shape ?? { id: 0, weight: 0.5 };
  const { second } = shape;
  const set = (change: Partial<NonNullable<Value['shape']>>): void => {
    const now = app.key('shape')?.value.shape;
    if (now !== undefined) app.setValue('shape', { shape: { ...now, ...change } });
  };
  const alone = (): void => {
    app.second = false;
    app.setValue('shape', { shape: { id: app.key('shape')?.value.shape?.id ?? shape.id, weight: 0.5 } });
    app.done();
  };
  const slot = (label: string, id: number | undefined, chosen: boolean, choose: () => void): TemplateResult =>
    html`<button type="button" class="slot" aria-pressed=${chosen ? 'true' : 'false'} @click=${choose}>
      ${id === undefined ? html`<span class="picture empty" aria-hidden="true">+</span>` : shapePicture(id)}<span><small>${label}</small> ${id === undefined ? 'nothing' : `${id} ${shapeName(id)}`}</span>
    </button>`;
  const pick = (mixed: boolean): void => {
    app.second = mixed;
    app.redraw();
  };
  const picking = app.second ? second : shape.id;
  return html`<div class="slots">
      ${slot('Shape', shape.id, !app.second, () => pick(false))} ${slot('Blended with', second, app.second, () => pick(true))}
    </div>
    ${
      second === undefined
        ? nothing
        : html`${numberField({ label: 'Share of the second', value: shape.weight, min: 0, max: 1, step: 0.01, text: `${Math.round(shape.weight * 100)} percent`, set: (weight) => set({ weight: Math.min(1, Math.max(0, weight)) }), done: () => app.done() })}
          <button type="button" class="plain" @click=${alone}>No blend</button>`
    }
    ${shapePicker(`shape-${app.second ? 2 : 1}`, app.second ? 'Blended shape' : 'Shape of the hand', picking, (id) => {
      set(app.second ? { second: id } : { id });
      app.done();
    })}`;
}

/** Common palm directions, relative to the speaker; EML's axes. */
const WAYS: Readonly<Record<string, Vector3>> = { Front: [0, 0, -1], Back: [0, 0, 1], Up: [0, 1, 0], Down: [0, -1, 0], Left: [1, 0, 0], Right: [-1, 0, 0] };

/** Renders the palm on its ball, and its direction in words. */
function onBall(app: App, palms: Palms, palm: NonNullable<Value['palm']>, set: (normal: Vector3, angle: number) => void): TemplateResult {
  const { hand } = app;
  const directions = palms.directionsOf(hand, palm.normal, palm.angle);
  const field = ball({
    hand,
    directions,
    live: () => {
      const now = app.key('palm')?.value.palm ?? palm;
      return palms.directionsOf(hand, now.normal, now.angle);
    },
    set: (to) => {
      const { normal, angle } = palms.palmOf(hand, to);
      set(normal, angle);
    },
    done: () => app.done(),
  });
  return html`<div class="palm-ball">
        ${field}
        <p class="hint">The ${hand} hand as the audience sees it. Roll the ball, or turn it by its rim.</p>
      </div>
      <p class="words">Palm ${inWords(directions.normal)},<br />fingers ${inWords(directions.fingers)}.</p>`;
}

function palmPanel(app: App, key: Key): TemplateResult {
  const palm = key.value.palm ?? { normal: [1, 0, 0] as Vector3, angle: 0 };
  const { palms } = app;
  const set = (normal: Vector3, angle: number): void => {
    if (Math.hypot(...normal) > 1e-6) app.setValue('palm', { palm: { normal, angle } });
  };
  const axis = (label: string, i: 0 | 1 | 2): TemplateResult =>
    numberField({
      label,
      value: palm.normal[i],
      min: -1,
      max: 1,
      step: 0.01,
      set: (value) => {
        const now = app.key('palm')?.value.palm ?? palm;
        set(now.normal.map((n, k) => (k === i ? value : n)) as unknown as Vector3, now.angle);
      },
      done: () => app.done(),
    });
  const choose = (normal: Vector3): void => {
    set(normal, palm.angle);
    app.done();
  };
  return html`<div class="palm">
      ${palms === undefined ? nothing : onBall(app, palms, palm, set)}
      <div class="ways" role="group" aria-label="Palm faces">
        ${Object.entries(WAYS).map(([name, normal]) => html`<button type="button" class="plain" @click=${() => choose(normal)}>${name}</button>`)}
      </div>
    </div>
    ${typical(app, palm, (normal, angle) => {
      set(normal, angle);
      app.done();
    })}
    ${numberField({ label: 'Turn about the normal', value: palm.angle, min: -180, max: 360, step: 1, unit: '°', set: (angle) => set((app.key('palm')?.value.palm ?? palm).normal, angle), done: () => app.done() })}
    ${axis('Normal to the left', 0)} ${axis('Normal upwards', 1)} ${axis('Normal to the back', 2)}`;
}

/** Renders the menu of typical orientations. */
function typical(app: App, palm: NonNullable<Value['palm']>, choose: (normal: Vector3, angle: number) => void): TemplateResult {
  const { hand } = app;
  const now = orientationName(hand, palm);
  const pick = (event: Event): void => {
    const known = ORIENTATIONS[(event.target as HTMLSelectElement).value];
    if (known === undefined) return;
    const { normal, angle } = orientationOf(hand, known);
    choose(normal, angle);
  };
  return html`<label class="select"><span>Typical</span>
      <select @change=${pick}>
        <option value="" ?selected=${now === undefined} disabled>Choose…</option>
        ${Object.keys(ORIENTATIONS).map((name) => html`<option ?selected=${name === now}>${name}</option>`)}
      </select></label>`;
}

function placePanel(app: App, key: Key): TemplateResult {
  const place = key.value.place ?? ([0, 0, 0] as Vector3);
  const track = app.track('place');
  const world = track?.world ?? false;
  const axis = (label: string, i: 0 | 1 | 2, min: number, max: number): TemplateResult =>
    numberField({
      label,
      value: place[i],
      min,
      max,
      step: 0.1,
      set: (value) => {
        const now = app.key('place')?.value.place;
        if (now !== undefined) app.setValue('place', { place: now.map((n, k) => (k === i ? value : n)) as unknown as Vector3 });
      },
      done: () => app.done(),
    });
  return html`<p class="hint">Drag the light in the picture; hold Shift to move it to the front and back. The speaker is about 77 units tall, and positions are relative to ${world ? 'the floor of the scene' : 'the pelvis'}.</p>
    ${axis('To the left', 0, -30, 30)} ${axis('Up', 1, world ? 20 : -20, world ? 90 : 50)} ${axis('To the back', 2, -30, 15)}
    ${app.player.paused && app.pose !== undefined ? reached(app, key) : nothing}`;
}

/** Reports the distance of the hand from its target if the arm is too short. */
function reached(app: App, key: Key): TemplateResult | typeof nothing {
  const target = app.pose?.targets.find((t) => t.name === `${app.hand}Arm`);
  const start = app.phase?.startSecs;
  const there = start !== undefined && Math.abs(app.secs - start - key.secs) < 0.02;
  return target !== undefined && there && target.error > 0.005
    ? html`<p class="trouble">The arm is ${Math.round(target.error * 100)} cm too short for this position.</p>`
    : nothing;
}

function coursePanel(app: App): TemplateResult {
  const { gesture, courseOf: feature } = app;
  const track = app.track(feature);
  const key = app.key(feature);
  const of = app.wholeTrack ? track : key;
  const live = () => (app.wholeTrack ? app.track(feature) : app.key(feature));
  const words = { shape: 'the fingers', palm: 'the palm', place: 'the wrist' }[feature];
  const moves = feature === 'shape' ? 'move' : 'moves';
  return html`${choice('course-of', 'Of', feature, LANES, (f) => app.selectKey(app.phaseIndex, (app.courseOf = f), app.keyIndex(f)))}
    ${
      track === undefined || key === undefined || of === undefined
        ? html`<p class="none">This phase says nothing about ${words}, so there is no course to it.</p>`
        : html`${choice('scope', 'For', app.wholeTrack ? 'track' : 'key', { key: `This key, ${written(key.secs)} s`, track: 'Every key of the phase' }, (scope) => {
            app.wholeTrack = scope === 'track';
            app.redraw();
          })}
        <p class="hint">${app.wholeTrack ? `How ${words} ${moves} to each key that has no course of its own.` : (firstWords(app, feature) ?? `How ${words} ${moves} to ${keyInWords(feature, key)}${key.course === undefined && track.course !== undefined ? `; the phase says ${track.course.kind}` : ''}.`)}</p>
        ${courseField({
          course: of.course,
          live: () => live()?.course,
          set: (course) => {
            const now = live();
            if (now !== undefined) app.drag(setCourse(app.gesture, now, course));
          },
          done: () => app.done(),
        })}
        ${
          feature === 'shape'
            ? nothing
            : choice('space', 'On the way', track.space ?? 'free', { free: 'Natural', cartesian: 'Straight', joint: 'By joints' }, (space) =>
                app.change(setSpace(gesture, track, space === 'free' ? undefined : space)),
              )
        }`
    }`;
}

/** Returns a note for the first key of a stroke, which is its start: the path to it belongs to the preparation. */
function firstWords(app: App, feature: Feature): string | undefined {
  const { name } = app.phase ?? {};
  const stroke = name === undefined || name === 'stroke';
  return stroke && app.keyIndex(feature) === 0 && (app.track(feature)?.keys.length ?? 0) > 1
    ? 'The phase begins with this key, so there is no path to it in this phase; choose a later one.'
    : undefined;
}

function phasePanel(app: App, phase: Phase): TemplateResult {
  const { gesture } = app;
  const own = ownTime(phase);
  const names = { plain: 'None', ...PHASES };
  return html`${choice('phase-name', 'This phase is a', phase.name ?? 'plain', names, (name) => app.change(setPhase(gesture, phase, name === 'plain' ? undefined : (name as PhaseName))))}
    ${choice('hands', 'Hands', toldApart(phase) ? 'apart' : phase.hands, { right: 'Right', left: 'Left', both: 'Both, mirrored', apart: 'Both, separately' } as Record<Handedness, string>, (hands) => app.change(setHands(app.editor.text, gesture, phase, hands)))}
    ${
      own === undefined
        ? html`<p class="hint">It starts at a time that the text defines; change it there.</p>`
        : numberField({
            label: inSequence(phase) ? 'Pause before it' : 'Starts at',
            value: own,
            min: 0,
            max: 5,
            step: 0.05,
            unit: 's',
            set: (secs) => app.phase && app.drag(setStart(app.phase, secs)),
            done: () => app.done(),
          })
    }
    ${numberField({ label: 'Length', value: phase.durationSecs, min: 0.05, max: 5, step: 0.05, unit: 's', set: (secs) => app.phase && app.drag(setDuration(app.phase, secs)), done: () => app.done() })}
    <div class="after" role="group" aria-labelledby="after-title">
      <h3 id="after-title">After it, add a</h3>
      <div class="row">
        ${(Object.entries(PHASES) as [PhaseName, string][]).map(([name, text]) => html`<button type="button" class="plain" @click=${() => add(app, phase, name)}>${text}</button>`)}
      </div>
    </div>
    <div class="row">
      <button type="button" class="plain" @click=${() => app.change(removePhase(app.editor.text, phase))}>Remove this phase</button>
    </div>`;
}

function add(app: App, phase: Phase, name: PhaseName): void {
  app.change(addPhase(app.editor.text, app.gesture, name, phase));
  const index = app.gesture.phases.findIndex((p) => p.element.from > phase.element.from && p.name === name);
  if (index >= 0) app.selectPhase(index);
}
