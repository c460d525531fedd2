/** Timeline of phases and keys, for selection and dragging; every item is also a button or a slider. */

import { html, nothing, type TemplateResult } from 'lit';
import { follow, keySteps, vars } from '../fields.js';
import type { App } from './app.js';
import { inSequence, ownTime, setDuration, setKeyTime, setStart, written } from './edit.js';
import { FEATURES, HANDS, PHASES, toldApart, trackOf, type Feature, type Key, type Phase } from './gesture.js';
import { shapeName } from './shapes.js';

/** Time shown after the last phase. */
const AFTER_SECS = 0.4;
/** Seconds of an arrow key. */
const STEP_SECS = 0.05;
export const LANES: Readonly<Record<Feature, string>> = { shape: 'Shape', palm: 'Palm', place: 'Place' };

const seconds = (secs: number): string => `${written(secs)} s`;

/** Returns a short description of a key's value. */
export function keyInWords(feature: Feature, { value: { shape, palm, place } }: Key): string {
  if (shape !== undefined) return `${shape.id} ${shapeName(shape.id)}${shape.second === undefined ? '' : ` mixed with ${shape.second} ${shapeName(shape.second)}`}`;
  if (palm !== undefined) return `normal ${palm.normal.map((n) => written(n)).join(', ')}, angle ${written(palm.angle, 0)}°`;
  return place === undefined ? LANES[feature] : place.map((n) => written(n, 1)).join(', ');
}

export function timeline(app: App): TemplateResult {
  const { gesture } = app;
  // A phase whose start only the player knows is drawn after the previous one.
  let before = 0;
  const starts = gesture.phases.map((phase) => {
    const start = phase.startSecs ?? before;
    before = start + phase.durationSecs;
    return start;
  });
  const first = Math.max(0, Math.min(...starts, Infinity) - AFTER_SECS);
  const from = Number.isFinite(first) ? first : 0;
  const length = Math.max(1, ...gesture.phases.map((phase, i) => (starts[i] ?? 0) + phase.durationSecs + AFTER_SECS - from));
  const percent = (secs: number): string => `${((100 * (secs - from)) / length).toFixed(3)}%`;
  const scale: Scale = { percent, length, secsOf: (x, width) => from + (x / width) * length };
  const marks = Array.from({ length: Math.floor(from + length) - Math.ceil(from) + 1 }, (_, i) => Math.ceil(from) + i);
  const shown = Math.min(from + length, Math.max(from, app.secs));
  return html`<div class="ruled">
    <span class="lane-name" aria-hidden="true"></span>
    <div class="lane scrub">
      ${marks.map((secs) => html`<span class="mark" aria-hidden="true" ${vars({ '--at': percent(secs) })}>${secs}</span>`)}
      <input
        type="range"
        aria-label="Time on stage"
        aria-valuetext=${seconds(shown)}
        min=${from.toFixed(2)}
        max=${(from + length).toFixed(2)}
        step="0.01"
        .value=${shown.toFixed(2)}
        @input=${(event: Event) => app.seek(Number((event.target as HTMLInputElement).value))}
      />
    </div>
    <span class="lane-name">Phase</span>
    <div class="lane phases">${gesture.phases.map((phase, i) => block(app, phase, i, starts[i] ?? 0, scale))}</div>
    ${FEATURES.map(
      (feature) => html`<span class="lane-name">${LANES[feature]}</span>
        <div class="lane keys">
          ${gesture.phases.map((phase, i) => keysOf(app, phase, i, starts[i] ?? 0, feature, scale))}
        </div>`,
    )}
    <div class="needle-lane" aria-hidden="true"><span class="needle" ${vars({ '--at': percent(shown) })}></span></div>
  </div>`;
}

interface Scale {
  percent(secs: number): string;
  readonly length: number;
  secsOf(x: number, width: number): number;
}

/** Renders a phase with its draggable edges: its end, and its start if the text gives it in plain seconds. */
function block(app: App, phase: Phase, index: number, start: number, { percent, length, secsOf }: Scale): TemplateResult {
  const name = phase.name === undefined ? 'Gesture' : PHASES[phase.name];
  const chosen = index === app.phaseIndex;
  const now = (): Phase => app.gesture.phases[index] ?? phase;
  const setEnd = (secs: number): void => app.drag(setDuration(now(), Math.round((secs - start) * 100) / 100));
  const own = ownTime(phase);
  const zero = start - (own ?? 0);
  const setBegin = (secs: number): void => app.drag(setStart(now(), Math.round((secs - zero) * 100) / 100));
  const edge = (label: string, classes: string, value: number, set: (secs: number) => void, text: string): TemplateResult =>
    html`<span
      class="edge ${classes}"
      role="slider"
      tabindex="0"
      aria-label=${label}
      aria-valuemin="0"
      aria-valuemax="60"
      aria-valuenow=${written(value)}
      aria-valuetext=${text}
      @pointerdown=${(event: PointerEvent) => {
        const lane = (event.currentTarget as HTMLElement).closest('.lane');
        app.selectPhase(index);
        // The scale of now: it changes while the end moves.
        const width = lane?.getBoundingClientRect().width ?? 1;
        if (lane !== null)
          follow(
            event,
            lane,
            ({ x }) => set(secsOf(x, width)),
            () => app.done(),
          );
      }}
      @keydown=${(event: KeyboardEvent) => {
        const steps = keySteps(event);
        if (steps === undefined) return;
        event.preventDefault();
        const live = classes === 'end' ? start + now().durationSecs : zero + (ownTime(now()) ?? 0);
        set(live + (steps[0] + steps[1]) * STEP_SECS);
        app.done();
      }}
    ></span>`;
  return html`<div class="phase ${phase.name ?? 'plain'} ${chosen ? 'chosen' : ''}" ${vars({ '--at': percent(start), '--long': `${((100 * phase.durationSecs) / length).toFixed(3)}%` })}>
    <button type="button" aria-pressed=${chosen ? 'true' : 'false'} aria-label="${name}, ${seconds(start)} to ${seconds(start + phase.durationSecs)}" title=${name} @click=${() => app.selectPhase(index)}>
      <span>${name}</span>
    </button>
    ${own === undefined || (inSequence(phase) && index > 0 && own === 0 && !chosen) ? nothing : edge(inSequence(phase) ? `Pause before ${name}` : `Start of ${name}`, 'begin', own, setBegin, seconds(own))}
    ${edge(`Length of ${name}`, 'end', phase.durationSecs, setEnd, seconds(phase.durationSecs))}
  </div>`;
}

/** Renders the keys of a feature in a phase: those of the edited hand, or of both where they differ. */
function keysOf(app: App, phase: Phase, index: number, start: number, feature: Feature, { percent, secsOf }: Scale): TemplateResult[] {
  const apart = toldApart(phase);
  const hands = apart ? HANDS : [phase.hands === 'left' ? ('left' as const) : ('right' as const)];
  return hands.flatMap((hand) => {
    const track = trackOf(phase, feature, hand);
    if (track === undefined) return [];
    const selected = index === app.phaseIndex && hand === app.hand;
    return track.keys.map((key, i) => {
      const chosen = selected && i === app.keyIndex(feature);
      const select = (): void => {
        if (apart) app.hand = hand;
        app.selectKey(index, feature, i);
      };
      const move = (secs: number): void => {
        const now = app.gesture.phases[index];
        const live = now && trackOf(now, feature, hand)?.keys[i];
        if (now !== undefined && live !== undefined) app.drag(setKeyTime(now, live, secs));
      };
      return html`<button
        type="button"
        class="key ${chosen ? 'chosen' : ''} ${apart ? hand : ''}"
        aria-pressed=${chosen ? 'true' : 'false'}
        aria-label="${LANES[feature]} at ${seconds(start + key.secs)}${apart ? `, ${hand} hand` : ''}: ${keyInWords(feature, key)}. Arrow keys move it."
        title="${LANES[feature]}: ${keyInWords(feature, key)}"
        ${vars({ '--at': percent(start + key.secs) })}
        @click=${select}
        @pointerdown=${(event: PointerEvent) => {
          const lane = (event.currentTarget as HTMLElement).closest('.lane');
          if (lane === null) return;
          const width = lane.getBoundingClientRect().width;
          const pressed = event.clientX;
          let moved = false;
          select();
          follow(
            event,
            lane,
            ({ x }, _rect, e) => {
              // A press with a small movement selects and does not drag.
              moved ||= Math.abs(e.clientX - pressed) > 3;
              if (moved) move(Math.round((secsOf(x, width) - start) * 100) / 100);
            },
            () => app.done(),
          );
        }}
        @keydown=${(event: KeyboardEvent) => {
          const steps = keySteps(event);
          if (steps === undefined || steps[2] !== 0) return;
          event.preventDefault();
          const now = app.gesture.phases[index];
          const live = now && trackOf(now, feature, hand)?.keys[i];
          move((live?.secs ?? key.secs) + (steps[0] + steps[1]) * STEP_SECS);
          app.done();
        }}
      ></button>`;
    });
  });
}
