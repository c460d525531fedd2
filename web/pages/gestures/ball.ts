/** A palm on a ball: one rolls it with a finger or the arrow keys, and turns it by its rim. */

import { html, svg, type TemplateResult } from 'lit';
import { cross, dot } from '../../element/engine/pose.js';
import { follow, keySteps, type Sink } from '../fields.js';
import type { Hand, Vector3 } from './gesture.js';
import type { HandDirections } from './palm.js';
import { radians, roll, twist } from './roll.js';

/** The outline of a flat hand: its thumb to the right, its fingers up, the palm's middle at 0; the ball has the radius 1. */
const OUTLINE =
  'M-.26-.36C-.3-.1-.33.05-.32.2L-.31.44A.07.07 0 0 0-.17.44L-.165.27-.155.58A.075.075 0 0 0-.005.58L0 .29.01.66A.08.08 0 0 0 .16.66L.165.28.18.56A.07.07 0 0 0 .32.55L.31.12C.36.16.4.25.44.34A.075.075 0 0 0 .58.28C.54.1.46-.06.36-.16L.26-.36Z';
/** Marks that are visible only on the palm's side. */
const LINES = 'M-.24.06C-.1-.02.08-.02.2.12M-.22-.06C-.06-.16.04-.22.08-.32M.2.02C.1-.06.08-.2.14-.32';
/** Marks that are visible only on the back. */
const NAILS = 'M-.24.45v.03M-.08.6v.03M.085.68v.03M.25.57v.03';

/** Projects a direction to the image: x to the right, y down, in the audience's view. */
const flat = ([x, y]: Vector3): [number, number] => [x, -y];
const short = (n: number): string => n.toFixed(3);

/** Describes a direction in words, from the speaker's view. */
export function inWords(direction: Vector3): string {
  const names: [string, Vector3][] = [
    ['to the front', [0, 0, 1]],
    ['to the back', [0, 0, -1]],
    ['up', [0, 1, 0]],
    ['down', [0, -1, 0]],
    ['to the speaker’s left', [1, 0, 0]],
    ['to the speaker’s right', [-1, 0, 0]],
  ];
  const strong = names.filter(([, axis]) => dot(axis, direction) > 0.38).sort(([, a], [, b]) => dot(b, direction) - dot(a, direction));
  return strong
    .slice(0, 2)
    .map(([name]) => name)
    .join(' and ');
}

/** Degrees of an arrow key. */
const STEP = 5;
/** Radius of the ball as a share of half the image; outside is its rim. */
const BALL = 0.8;

export interface Ball extends Sink<HandDirections> {
  readonly hand: Hand;
  readonly directions: HandDirections;
  /** Returns the current directions: key presses may come faster than the page is rendered. */
  live(): HandDirections;
}

export function ball({ hand, directions, live, set, done }: Ball): TemplateResult {
  const { normal, fingers } = directions;
  const across = cross(fingers, normal);
  const thumb: Vector3 = hand === 'right' ? across : [-across[0], -across[1], -across[2]];
  const [ux, uy] = flat(thumb);
  const [vx, vy] = flat(fingers);
  const [nx, ny] = flat(normal);
  const towards = normal[2] > 0;
  // A thin slab: the far side a little behind the near one.
  const slab = (side: number) => `matrix(${[ux, uy, vx, vy, nx * side, ny * side].map(short).join(' ')})`;
  const [near, far] = towards ? [0.04, -0.04] : [-0.04, 0.04];
  const arrow = svg`<g class="normal"><line x1="0" y1="0" x2=${short(nx * 0.86)} y2=${short(ny * 0.86)} /><circle cx=${short(nx * 0.9)} cy=${short(ny * 0.9)} r=${short(0.055 + 0.02 * normal[2])} /></g>`;

  const press = (event: PointerEvent): void => {
    const frame = event.currentTarget as HTMLElement;
    const rect = frame.getBoundingClientRect();
    const half = rect.width / 2;
    let now = live();
    let last = { x: event.clientX - rect.left - half, y: event.clientY - rect.top - half };
    const rim = Math.hypot(last.x, last.y) > half * (BALL + 0.04);
    follow(
      event,
      frame,
      ({ x, y }) => {
        const spot = { x: x - half, y: y - half };
        now = rim ? twist(now, Math.atan2(last.y, last.x) - Math.atan2(spot.y, spot.x)) : roll(now, (spot.x - last.x) / (half * BALL), -(spot.y - last.y) / (half * BALL));
        last = spot;
        set(now);
      },
      done,
    );
  };
  const key = (event: KeyboardEvent): void => {
    const steps = keySteps(event);
    if (steps === undefined) return;
    event.preventDefault();
    const [right, up, ahead] = steps.map((step) => radians(step * STEP)) as [number, number, number];
    set(ahead === 0 ? roll(live(), right, up) : twist(live(), ahead));
    done();
  };
  return html`<button
    type="button"
    class="ball"
    aria-label="Palm ${inWords(normal)}, fingers ${inWords(fingers)}. Arrow keys roll the hand, page up and page down turn it."
    @pointerdown=${press}
    @keydown=${key}
  >
    <svg viewBox="-1.25 -1.25 2.5 2.5" aria-hidden="true">
      <circle class="rim" r="1.16" />
      <path class="ticks" d="M0-1.22v.12M0 1.1v.12M-1.22 0h.12M1.1 0h.12" />
      <circle class="sphere" r="1" />
      <ellipse class="equator" rx="1" ry=".3" />
      ${towards ? '' : arrow}
      <g class="hand ${towards ? 'palm' : 'back'}">
        <path class="under" transform=${slab(far)} d=${OUTLINE} />
        <path class="face" transform=${slab(near)} d=${OUTLINE} />
        <path class="lines" transform=${slab(near)} d=${towards ? LINES : NAILS} />
      </g>
      ${towards ? arrow : ''}
      <circle class="shine" cx="-.35" cy="-.45" r=".34" />
    </svg>
  </button>`;
}
