/** Draggable disc of emotions: activation upwards, evaluation to the right (F&H figure 4.5). */

import { html, nothing, svg, type TemplateResult } from 'lit';
import { follow, keySteps, numberField, vars } from '../fields.js';
import type { App } from './app.js';
import { inWords, NEUTRAL, OUTLINE, sharesAt, within, WORDS, type EmotionWord, type EmotionPoint } from './disc.js';

/** Half the size of the image, in units of the disc. */
const HALF = 108;

/** Positions of word labels, chosen to avoid overlap: evaluation, activation, and text anchor. */
const LABELS: Readonly<Record<string, readonly [number, number, 'start' | 'end' | 'middle']>> = {
  surprise: [7, 93, 'start'],
  hate: [-52, 66, 'start'],
  anger: [-39, 39, 'end'],
  disliking: [-57, 26, 'end'],
  fear: [-57, 14, 'end'],
  shame: [-18, 9, 'start'],
  anxiety: [-15, 18, 'start'],
  panic: [-86, 38, 'middle'],
  kidding: [27, 36, 'end'],
  disappointment: [-17, -9, 'start'],
  resentment: [-54, 0, 'end'],
  reproach: [-27, -27, 'middle'],
  distress: [-57, -17, 'end'],
  'fears-confirmed': [-50, -42, 'middle'],
  gloating: [34, 50, 'start'],
  pride: [52, 41, 'start'],
  admiration: [58, 30, 'start'],
  gratitude: [58, 20, 'start'],
  joy: [58, 10, 'start'],
  love: [58, 0, 'start'],
  relief: [58, -10, 'start'],
  satisfaction: [42, -22, 'start'],
  hope: [12, 25, 'end'],
};

const round = (n: number): number => Math.round(n * 10) / 10;

function mark(word: EmotionWord, chosen: boolean): TemplateResult {
  const [x, y, anchor] = LABELS[word.word] ?? [word.evaluation, word.activation, 'start'];
  const gap = anchor === 'start' ? -2 : anchor === 'end' ? 2 : 0;
  return svg`<g class=${chosen ? 'word felt' : 'word'}>
    <line x1=${word.evaluation} y1=${-word.activation} x2=${x + gap} y2=${-y} />
    <circle cx=${word.evaluation} cy=${-word.activation} r="1.8" />
    <text x=${x} y=${2.4 - y} text-anchor=${anchor}>${word.word}</text>
  </g>`;
}

/** Renders the disc, its handle, and the same setting in words and numbers. */
export function disc(app: App): TemplateResult {
  const { emotion } = app.state;
  const shares = sharesAt(emotion);
  const said = app.state.word === '' ? inWords(shares) : `100 % ${app.state.word}`;
  const to = (place: Partial<EmotionPoint>): void => app.change((s) => Object.assign(s, { word: '', emotion: { ...s.emotion, ...place, ...within({ ...s.emotion, ...place }) } }));
  const press = (event: PointerEvent): void => {
    const frame = event.currentTarget as HTMLElement;
    const move = ({ x, y }: { x: number; y: number }, rect: DOMRect): void =>
      to({ evaluation: round(((2 * x) / rect.width - 1) * HALF), activation: round((1 - (2 * y) / rect.height) * HALF) });
    const rect = frame.getBoundingClientRect();
    if (event.button === 0) move({ x: event.clientX - rect.left, y: event.clientY - rect.top }, rect);
    follow(event, frame, move, () => app.done());
  };
  const key = (event: KeyboardEvent): void => {
    // Keys may repeat faster than the page renders, so the current position is used, not the
    // rendered one.
    const { emotion } = app.state;
    if (event.key === 'Home') to({ ...NEUTRAL });
    else {
      const by = keySteps(event);
      if (by === undefined) return;
      const limit = (n: number): number => Math.min(100, Math.max(-100, n));
      to({ evaluation: emotion.evaluation + 2 * by[0], activation: emotion.activation + 2 * by[1], power: limit(emotion.power + 5 * by[2]) });
    }
    event.preventDefault();
    app.done();
  };
  const number = (key: keyof EmotionPoint, label: string): TemplateResult =>
    numberField({
      label,
      value: emotion[key],
      min: -100,
      max: 100,
      step: 1,
      text: `${Math.round(emotion[key])}: ${said}`,
      set: (value) => to({ [key]: value }),
      done: () => app.done(),
    });
  const place = { '--left': `${(50 + (50 * emotion.evaluation) / HALF).toFixed(2)}%`, '--top': `${(50 - (50 * emotion.activation) / HALF).toFixed(2)}%` };
  const outline = OUTLINE.map(([e, a]) => `${e},${-a}`).join(' ');
  return html`<button type="button" class="disc" @pointerdown=${press} @keydown=${key} aria-label="Emotion: ${said}. Arrow keys move it on the disc, page up and page down change its power, Home is neutral.">
      <svg viewBox="${-HALF} ${-HALF} ${2 * HALF} ${2 * HALF}" aria-hidden="true">
        <circle class="rim" r="100" />
        <circle class="ring" r="50" />
        <path class="axes" d="M-100 0H100M0-100V100" />
        <polygon class="reach" points=${outline} />
        <text class="axis" x="-4" y="-88" text-anchor="end">active</text>
        <text class="axis" x="-4" y="94" text-anchor="end">passive</text>
        <text class="axis" x="-91" y="34">negative</text>
        <text class="axis" x="91" y="34" text-anchor="end">positive</text>
        ${WORDS.map((word) =>
          mark(
            word,
            shares.some((s) => s.word === word),
          ),
        )}
      </svg>
      <span class="thumb" ${vars(place)}></span>
    </button>
    <p class="felt" aria-hidden="true">${said}</p>
    <div class="numbers">${number('power', 'Power')}</div>
    <div class="row two">
      <label class="select"><span>Word</span>
        <select aria-label="Word of emotion" @change=${(event: Event) => choose(app, (event.target as HTMLSelectElement).value)}>
          <option value="" .selected=${shares.length !== 1}>${shares.length === 0 ? 'neutral' : '–'}</option>
          ${WORDS.flatMap((word) => [word.word, ...word.also].map((name, i) => html`<option value=${name} .selected=${app.state.word === '' ? i === 0 && shares.length === 1 && shares[0]?.word === word : name === app.state.word}>${name}</option>`))}
        </select></label>
      <button type="button" class="plain" ?disabled=${shares.length === 0 && emotion.power === 0} @click=${() => choose(app, '')}>Neutral</button>
    </div>
    <div class="numbers">${number('evaluation', 'Evaluation')}${number('activation', 'Activation')}</div>
    ${shares.length > 0 ? nothing : html`<p class="about">Drag on the disc, or choose a word. Words are placed as in F&amp;H table 4.4; the face follows within their outline.</p>`}`;
}

/** Selects the position of a word; words at one position may look different. */
function choose(app: App, name: string): void {
  const word = WORDS.find((w) => w.word === name || w.also.includes(name));
  const { activation, evaluation, power } = word ?? NEUTRAL;
  app.set((s) => Object.assign(s, { word: word === undefined ? '' : name, emotion: { activation, evaluation, power } }));
}
