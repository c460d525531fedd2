/** Strip of speech over time: phones, their dominance over the mouth, and the movement of the face. */

import { html, nothing, svg, type TemplateResult } from 'lit';
import { curvesOf, segmentsOf, type Segment } from '../../element/face/course.js';
import type { RaconteurPlayer } from '../../element/element.js';
import { vars } from '../fields.js';
import type { App } from './app.js';
import { dominance, liveliest, type Curve } from './course.js';

/** Sample rate; also the number of samples that the player returns per call. */
const RATE_HZ = 50;
const MAX_SAMPLES = 1500;
/** Maximum number of curves. */
const MAX_CURVES = 12;
/** Pixels of a second, of the row of phones, of dominance, and of one curve. */
const SECOND = 220;
const PHONES = 26;
const DOMINANCE = 56;
const ROW = 30;
/** Share of the maximum dominance below which dominance is not drawn. */
const FAINT = 0.02;

/** Contents of the strip, computed once for each text. */
export interface Strip {
  readonly secs: number;
  readonly segments: readonly Segment[];
  readonly curves: readonly Curve[];
}

/** Measures the course; undefined if nothing is spoken or no story is loaded. */
export function measure(app: App): Strip | undefined {
  const { player, state } = app;
  if (state.speech.kind === 'none') return undefined;
  const secs = Math.min(player.duration, MAX_SAMPLES / RATE_HZ);
  if (!(secs > 0)) return undefined;
  const count = Math.ceil(secs * RATE_HZ);
  const course = player.course(0, secs, count);
  if (course === undefined || course.names.length === 0) return undefined;
  return { secs, segments: segmentsOf(course).filter((s) => s.start < secs), curves: liveliest(curvesOf(course, count), MAX_CURVES) };
}

const n = (value: number): string => value.toFixed(1);

/** Renders a hill of dominance under the phones. */
function hill(segment: Segment, secs: number, most: number): TemplateResult | typeof nothing {
  const points: string[] = [];
  const step = 0.01;
  // Extends as far as it is visible on either side.
  const reach = (rate: number): number => (rate > 0 ? Math.log(Math.max(1, segment.alpha / (FAINT * most))) / rate : 0);
  const from = Math.max(0, segment.held[0] - reach(segment.rates[0]));
  const to = Math.min(secs, segment.held[1] + reach(segment.rates[1]));
  for (let t = from; t <= to; t += step) points.push(`${n(t * SECOND)},${n(PHONES + DOMINANCE * (1 - dominance(segment, t) / most))}`);
  const floor = PHONES + DOMINANCE;
  return points.length < 2 ? nothing : svg`<polygon class="hill" points="${n(from * SECOND)},${floor} ${points.join(' ')} ${n(to * SECOND)},${floor}" />`;
}

function phone(segment: Segment, secs: number): TemplateResult {
  const from = Math.max(0, segment.start) * SECOND;
  const width = Math.min(secs, segment.end) * SECOND - from;
  const silent = segment.name === 'pau';
  return svg`<g class=${silent ? 'phone silent' : 'phone'}><rect x=${n(from)} y="1" width=${n(Math.max(0, width - 1))} height=${PHONES - 4} rx="4" />
    ${width > 9 && !silent ? svg`<text x=${n(from + width / 2)} y=${PHONES / 2 + 3}>${segment.name}</text>` : nothing}</g>`;
}

function curve({ values }: Curve, i: number, secs: number): TemplateResult {
  const top = PHONES + DOMINANCE + 8 + i * ROW;
  const signed = values.some((v) => v < -0.02);
  const [zero, full] = signed ? [top + ROW / 2, ROW / 2 - 3] : [top + ROW - 4, ROW - 7];
  const width = secs * SECOND;
  const points = values.map((v, k) => `${n((width * k) / Math.max(1, values.length - 1))},${n(zero - full * Math.min(1, Math.max(-1, v)))}`).join(' ');
  return svg`<g class="curve"><line x1="0" x2=${n(width)} y1=${zero} y2=${zero} /><polygon points="0,${zero} ${points} ${n(width)},${zero}" /><polyline points=${points} /></g>`;
}

/** Renders the strip with its labels at the side; a click on it seeks. */
export function strip(app: App, now: Strip | undefined): TemplateResult {
  if (now === undefined)
    return html`<p class="about none">Write a line, or choose a sentence of a story, to plot its phones, the dominance of each over the opening of the lips, and the resulting muscle contractions.</p>`;
  const { secs, segments, curves } = now;
  const height = PHONES + DOMINANCE + 8 + curves.length * ROW;
  const width = secs * SECOND;
  const most = Math.max(...segments.map((s) => s.alpha), 1e-6);
  const spoken = segments.filter((s) => s.name !== 'pau').map((s) => s.name);
  const seek = (event: MouseEvent): void => {
    const rect = (event.currentTarget as Element).getBoundingClientRect();
    app.player.currentTime = (secs * (event.clientX - rect.left)) / rect.width;
  };
  return html`<div class="strip" ${vars({ '--row': `${ROW}px`, '--phones': `${PHONES}px`, '--dominance': `${DOMINANCE + 8}px` })}>
    <ul class="names" aria-hidden="true"><li class="phones">Phones</li><li class="dominance">Dominance<br />over opening</li>${curves.map(({ name }) => html`<li>${name}</li>`)}</ul>
    <div class="scroll" tabindex="0" role="group" aria-label="Speech over time: ${spoken.length} phones, ${spoken.join(' ')}. Moving most: ${curves.map((c) => c.name).join('; ')}.">
      <div class="sheet" ${vars({ '--wide': `${n(width)}px` })} @click=${seek}>
        <svg viewBox="0 0 ${n(width)} ${height}" width=${n(width)} height=${height} aria-hidden="true">
          ${segments.map((s) => hill(s, secs, most))} ${segments.map((s) => phone(s, secs))} ${curves.map((c, i) => curve(c, i, secs))}
        </svg>
        <div class="playhead"></div>
      </div>
    </div>
  </div>`;
}

/** Keeps the playhead at the current time, and visible during playback. */
export function follow(place: HTMLElement, player: RaconteurPlayer): void {
  const head = place.querySelector<HTMLElement>('.playhead');
  const scroll = place.querySelector<HTMLElement>('.scroll');
  if (head === null || scroll === null) return;
  const x = player.currentTime * SECOND;
  head.style.setProperty('--at', `${n(x)}px`);
  if (player.paused) return;
  const seen = x - scroll.scrollLeft;
  if (seen < 20 || seen > scroll.clientWidth - 60) scroll.scrollLeft = Math.max(0, x - 60);
}
