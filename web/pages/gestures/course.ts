/** Timing curve to a key: the covered share of the path by the share of the time, with handles if it has any. */

import { html, nothing, svg, type TemplateResult } from 'lit';
import { choice, type Sink } from '../fields.js';
import { handle, numberField } from './fields.js';
import type { Course } from './gesture.js';
import { DEFAULT_CONTROLS, KINDS, wayAt, type Kind } from './profile.js';

/** Lower bound of the displayed path share, with room for overshoot and anticipation. */
const LOW = -0.35;
const HIGH = 1.45;
const WIDTH = 100;
const HEIGHT = 90;
/** Room left and right of the time, percent. */
const SIDE = 6;

const toX = (s: number): number => SIDE + s * (WIDTH - 2 * SIDE);
const toY = (way: number): number => ((HIGH - way) / (HIGH - LOW)) * HEIGHT;
const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
const hundredths = (value: number): number => Math.round(value * 100) / 100;
/** Distance of a slope handle from its end point, as a share of the time. */
const ARM = 0.25;

export interface CourseField extends Sink<Course | undefined> {
  readonly course: Course | undefined;
  /** Returns the current curve: key presses may come faster than the page is rendered. */
  live(): Course | undefined;
}

interface DragHandle {
  readonly label: string;
  readonly s: number;
  readonly way: number;
  /** The end of the curve that it belongs to. */
  readonly from: readonly [number, number];
  /** Returns the controls after dragging the handle there. */
  at(s: number, way: number): readonly number[];
}

function grips({ kind, controls }: Course): DragHandle[] {
  const [a = 0, b = 0, c = 0, d = 0] = controls;
  if (kind === 'bezier') {
    return [
      { label: 'First control point', s: a, way: b, from: [0, 0], at: (s, way) => [clamp(s, 0, 1), way, c, d] },
      { label: 'Second control point', s: c, way: d, from: [1, 1], at: (s, way) => [a, b, clamp(s, 0, 1), way] },
    ];
  }
  if (kind === 'hermite') {
    return [
      { label: 'Slope at the start', s: ARM, way: a * ARM, from: [0, 0], at: (_, way) => [clamp(way / ARM, -1.4, 5.5), b] },
      { label: 'Slope at the end', s: 1 - ARM, way: 1 - b * ARM, from: [1, 1], at: (_, way) => [a, clamp((1 - way) / ARM, -1.8, 5.4)] },
    ];
  }
  return [];
}

const CONTROL_NAMES: Readonly<Record<'bezier' | 'hermite', readonly string[]>> = {
  bezier: ['First point, time', 'First point, way', 'Second point, time', 'Second point, way'],
  hermite: ['Slope at the start', 'Slope at the end'],
};

export function courseField({ course, live, set, done }: CourseField): TemplateResult {
  const kind: Kind = course?.kind ?? 'natural';
  const change = (controls: readonly number[]): void => {
    if (course !== undefined) set({ kind: course.kind, controls: controls.map(hundredths) });
  };
  const choose = (wanted: Kind): void => {
    set(wanted === 'natural' ? undefined : { kind: wanted, controls: wanted === course?.kind ? course.controls : DEFAULT_CONTROLS[wanted] });
    done();
  };
  const points = Array.from({ length: 65 }, (_, i) => `${toX(i / 64).toFixed(2)},${toY(clamp(wayAt(course, i / 64), LOW, HIGH)).toFixed(2)}`).join(' ');
  const held = course === undefined ? [] : grips(course);
  const dots = held.map((grip, i) =>
    handle({
      label: `${grip.label}: ${hundredths(grip.s)} of the time, ${hundredths(grip.way)} of the way. Arrow keys move it.`,
      classes: 'small',
      left: toX(grip.s),
      top: (100 * toY(clamp(grip.way, LOW, HIGH))) / HEIGHT,
      drag: ({ x, y }, { width, height }) => {
        const s = ((x / width) * WIDTH - SIDE) / (WIDTH - 2 * SIDE);
        change(grip.at(s, clamp(HIGH - (y / height) * (HIGH - LOW), LOW, HIGH)));
      },
      key: (right, up) => {
        if (right === 0 && up === 0) return false;
        const now = live();
        const same = (now && grips(now)[i]) ?? grip;
        change(same.at(same.s + right * 0.02, same.way + up * 0.02));
        return true;
      },
      done,
    }),
  );
  return html`
    ${choice('course', 'Course', kind, KINDS, choose)}
    <div class="curve frame">
      <svg viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none" aria-hidden="true">
        <path class="grid" d="M${toX(0)} ${toY(0)}H${toX(1)}M${toX(0)} ${toY(1)}H${toX(1)}M${toX(0)} 0V${HEIGHT}M${toX(1)} 0V${HEIGHT}" />
        ${held.map(({ s, way, from: [fs, fw] }) => svg`<line class="arm" x1=${toX(fs)} y1=${toY(fw)} x2=${toX(s)} y2=${toY(clamp(way, LOW, HIGH))} />`)}
        <polyline class="way" points=${points} />
      </svg>
      <span class="axis time" aria-hidden="true">time →</span><span class="axis way" aria-hidden="true">way →</span>
      ${dots}
    </div>
    ${
      course?.kind === 'bezier' || course?.kind === 'hermite'
        ? CONTROL_NAMES[course.kind].map((label, i) => {
            const time = course.kind === 'bezier' && i % 2 === 0;
            return numberField({
              label,
              value: course.controls[i] ?? 0,
              min: time ? 0 : course.kind === 'bezier' ? -0.3 : -1.4,
              max: time ? 1 : course.kind === 'bezier' ? 1.4 : 5,
              step: 0.01,
              set: (value) => change(course.controls.map((c, k) => (k === i ? (time ? clamp(value, 0, 1) : value) : c))),
              done,
            });
          })
        : nothing
    }
  `;
}
