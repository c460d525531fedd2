/** View of a head: around it, from above, and zoom. */

import { html, type TemplateResult } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import { minus, readPose } from '../element/engine/pose.js';
import type { View } from '../element/base/types.js';
import { keySteps } from './fields.js';
import { leastTilt, TURN_PER_PIXEL, zoomByKey, zoomByWheel } from './pad.js';

/** Named views of the head: rotations about it, radians. */
export const SIDES = { 'Three-quarter': 0.6, Front: 0, Left: Math.PI / 2, Right: -Math.PI / 2 } as const;
/** Offset from the skull's joint to the middle of the head, metres: left, up, front. */
const MIDDLE_M = [0, 0.025, 0.03] as const;

/** View of the head: azimuth and elevation, radians, and zoom. */
export type Look = Pick<View, 'turn' | 'tilt' | 'zoom'>;

/** Elevation at which the viewer's eyes are level with those of the face, radians. */
export const LEVEL = 0.02;

export class HeadView {
  from: Look;
  /** Centre of the head, relative to the target of the full shot; until known, that of a person of medium height. */
  #head: readonly [number, number, number] = [0, 0.72, 0.05];
  /** Height of the head's centre; the next field is the camera distance of the full shot from its target, metres. */
  #height = 1.6;
  #distance = 5;
  #view: View;

  constructor(
    private readonly player: RaconteurPlayer,
    from: Look,
    private readonly changed: () => void,
  ) {
    this.from = from;
    this.#view = { ...from, right: 0, up: 0 };
  }

  /** Changes the view; the head stays centred. */
  look(look: Partial<Look>): void {
    this.#turn(look);
    this.player.look(this.#view);
    this.changed();
  }

  /** Renders an image from another view, with its centre lowered by a number of metres; undefined if there is none. */
  picture(look: Partial<Look>, lower = 0): HTMLCanvasElement | undefined {
    this.#turn(look);
    return this.player.snapshot({ ...this.#view, up: this.#view.up - lower });
  }

  #turn(look: Partial<Look>): void {
    const next = { ...this.from, ...look };
    const zoom = Math.min(12, Math.max(1.5, next.zoom));
    this.from = {
      turn: Math.atan2(Math.sin(next.turn), Math.cos(next.turn)),
      tilt: Math.min(1.2, Math.max(-0.8, leastTilt(this.#height, this.#distance / zoom), next.tilt)),
      zoom,
    };
    this.#aim();
  }

  /** Current view, for another player of this figure. */
  get view(): View {
    return this.#view;
  }

  /** Zoom of the view. */
  get zoom(): number {
    return this.from.zoom;
  }

  /** Aims the camera: its centre moves in the image plane, which rotates with it. */
  #aim(): void {
    const { turn } = this.from;
    const [x, y, z] = this.#head;
    this.#view = { ...this.from, right: x * Math.cos(turn) - z * Math.sin(turn), up: y };
  }

  /** Locates and centres the head: figures differ in height. Call it after a frame has been rendered since the last change of view. */
  centre(): void {
    const pose = readPose(this.player);
    const skull = pose?.joints.find((joint) => joint.name === 'bone_skull');
    if (pose === undefined || skull === undefined) return;
    const [tx, ty, tz] = pose.camera.target;
    const { turn, right, up } = this.#view;
    const shot = [tx - Math.cos(turn) * right, ty - up, tz + Math.sin(turn) * right] as const;
    const head = MIDDLE_M.map((m, i) => (skull.position[i] ?? 0) + m - (shot[i] ?? 0));
    this.#head = [head[0] ?? 0, head[1] ?? 0, head[2] ?? 0];
    this.#height = skull.position[1] + MIDDLE_M[1];
    this.#distance = Math.hypot(...minus(pose.camera.eye, pose.camera.target)) * this.#view.zoom;
    this.#aim();
    this.player.look(this.#view);
  }
}

/** Rotates the view of the head by dragging and arrow keys; dragging only while `turns` returns true. */
export function lookAround(view: HeadView, pad: HTMLElement, turns = (): boolean => true): void {
  pad.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !event.isPrimary || !turns()) return;
    let last = { x: event.clientX, y: event.clientY };
    const end = new AbortController();
    pad.setPointerCapture(event.pointerId);
    const move = (now: PointerEvent): void => {
      if (now.pointerId !== event.pointerId) return;
      view.look({ turn: view.from.turn - (now.clientX - last.x) * TURN_PER_PIXEL, tilt: view.from.tilt + (now.clientY - last.y) * TURN_PER_PIXEL });
      last = { x: now.clientX, y: now.clientY };
    };
    pad.addEventListener('pointermove', move, end);
    for (const type of ['pointerup', 'pointercancel'] as const) pad.addEventListener(type, () => end.abort(), end);
  });
  zoomByWheel(pad, view);
  pad.addEventListener('keydown', (event) => {
    const by = keySteps(event);
    if (by !== undefined) view.look({ turn: view.from.turn + by[0] * 0.12, tilt: view.from.tilt + by[1] * 0.08, zoom: view.from.zoom * 1.1 ** -by[2] });
    else if (event.key === 'Home') view.look({ turn: SIDES['Three-quarter'], tilt: LEVEL });
    else if (!zoomByKey(event, view)) return;
    event.preventDefault();
  });
}

/** Renders buttons for the views, and for the zoom. */
export function lookFrom(view: HeadView): TemplateResult {
  const { from } = view;
  return html`<div class="group" role="group" aria-label="View">
    ${Object.entries(SIDES).map(([name, turn]) => html`<button type="button" class="plain" aria-pressed=${Math.abs(from.turn - turn) < 0.01} @click=${() => view.look({ turn, tilt: LEVEL })}>${name}</button>`)}
    <button type="button" class="plain" aria-label="Farther" @click=${() => view.look({ zoom: from.zoom / 1.2 })}>−</button>
    <button type="button" class="plain" aria-label="Nearer" @click=${() => view.look({ zoom: from.zoom * 1.2 })}>+</button>
  </div>`;
}
