/** The disc of activation and evaluation: the direction from its middle is the type, the distance its potential. */

import { html, svg, type TemplateResult } from 'lit';
import { follow, keySteps, vars } from '../fields.js';
import type { App } from './app.js';
import { BANDS, bandOf, formatNumber } from './rules.js';
import { feltAt, rayOf, RAYS, spotOf, stepFrom, STRONGEST, type CurrentEmotion, type EmotionRay } from './types.js';

/** Half the width of the image, in units in which the disc's rim has `RIM`; the next constant is half the height. */
const WIDE = 170;
const HIGH = 102;
const RIM = 88;

/** Renders a type at the rim, with its name beyond. */
function mark(ray: EmotionRay, chosen: boolean): TemplateResult {
  const [dot, name] = [spotOf(ray, RIM), spotOf(ray, RIM + 6)];
  return svg`<g class=${chosen ? 'word felt' : 'word'}>
    <line x1="0" y1="0" x2=${dot.x} y2=${-dot.y} />
    <circle cx=${dot.x} cy=${-dot.y} r="1.8" />
    <text x=${name.x} y=${3.2 - name.y} text-anchor=${ray.side > 0 ? 'start' : 'end'}>${ray.name}</text>
  </g>`;
}

/** Renders the ring at which the camera moves closer. */
const ring = (from: number): TemplateResult => svg`<circle class="ring" r=${(RIM * from) / STRONGEST} />`;

export function disc(app: App): TemplateResult {
  const { emotion, potential } = app.edited;
  const to = (felt: CurrentEmotion): void => app.change(app.edit((s) => Object.assign(s, felt)));
  const press = (event: PointerEvent): void => {
    const frame = event.currentTarget as HTMLElement;
    const move = ({ x, y }: { x: number; y: number }, rect: DOMRect): void =>
      to(feltAt({ x: (((2 * x) / rect.width - 1) * WIDE) / RIM, y: ((1 - (2 * y) / rect.height) * HIGH) / RIM }));
    const rect = frame.getBoundingClientRect();
    if (event.button === 0) move({ x: event.clientX - rect.left, y: event.clientY - rect.top }, rect);
    follow(event, frame, move, () => app.done());
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key === 'Home') to({ emotion: 'neutral', potential: 0 });
    else {
      const by = keySteps(event);
      if (by === undefined || (by[0] === 0 && by[1] === 0)) return;
      to(stepFrom(app.edited, by[0], by[1]));
    }
    event.preventDefault();
    app.done();
  };
  const ray = rayOf(emotion);
  const spot = ray === undefined ? { x: 0, y: 0 } : spotOf(ray, (RIM * potential) / STRONGEST);
  const place = { '--left': `${(50 + (50 * spot.x) / WIDE).toFixed(2)}%`, '--top': `${(50 - (50 * spot.y) / HIGH).toFixed(2)}%` };
  const said = ray === undefined ? 'neutral' : `${emotion}, potential ${formatNumber(potential)}, ${bandOf(potential).name}`;
  return html`<button type="button" class="disc" @pointerdown=${press} @keydown=${key} aria-label="Emotion: ${said}. Up and down choose the next type, left and right its potential, Home is neutral.">
      <svg viewBox="${-WIDE} ${-HIGH} ${2 * WIDE} ${2 * HIGH}" aria-hidden="true">
        <circle class="rim" r=${RIM} />
        ${BANDS.slice(1).map(({ from }) => ring(from))}
        <text class="axis" x="0" y=${10 - RIM} text-anchor="middle">active</text>
        <text class="axis" x="0" y=${RIM - 5} text-anchor="middle">passive</text>
        ${RAYS.map((own) => mark(own, own.name === emotion))}
      </svg>
      <span class="thumb" ${vars(place)}></span>
    </button>
    <p class="felt" aria-hidden="true">${said}</p>
    <p class="about">Negative emotions on the left, positive on the right, each side in the order of F&amp;H table 4.4 and spread evenly. The camera moves closer at each ring.</p>`;
}
