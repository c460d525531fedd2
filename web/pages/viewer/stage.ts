/** Stage: handles of the limbs over the picture, and the view of the figure. */

import { html, nothing, svg, type TemplateResult } from 'lit';
import { keySteps, vars } from '../fields.js';
import { TURN_PER_PIXEL, zoomByKey, zoomByWheel } from '../pad.js';
import { along, type PoseNow, type ScreenPoint, type Vector } from '../../element/engine/pose.js';
import { FRONT, type App } from './app.js';
import { LIMB_NAMES, LIMBS, type LimbName, type Vector3 } from './state.js';
import { endOf, toPlace, toWorld } from './turns.js';

/** Distance from the skull's joint to the head's handle, above the crown: units of the figure, whose height is 77. */
const OVER_HEAD = 10.7;
/** Head rotation per pixel of its handle's movement, degrees. */
const NOD = 0.5;

/** Follows a pointer from its press to its release. */
function follow(event: PointerEvent, move: (event: PointerEvent) => void, done: () => void): void {
  const target = event.currentTarget as HTMLElement;
  target.setPointerCapture(event.pointerId);
  const mine = (listener: (event: PointerEvent) => void) => (other: Event) => {
    if ((other as PointerEvent).pointerId === event.pointerId) listener(other as PointerEvent);
  };
  const end = new AbortController();
  const stop = mine(() => {
    end.abort();
    done();
  });
  target.addEventListener('pointermove', mine(move), end);
  for (const type of ['pointerup', 'pointercancel']) target.addEventListener(type, stop, end);
}

/** Steps of the keyboard: right, up, nearer. */
function steps(event: KeyboardEvent): Vector3 | undefined {
  const by = keySteps(event);
  return by && [by[0], by[1], -by[2]];
}

/** Returns the position of a limb's handle in the world: at its target, otherwise at its end. */
function handlePlace(app: App, pose: PoseNow, name: LimbName): Vector | undefined {
  const limb = app.state.limbs[name];
  const end = endOf(pose, name);
  // Above the crown, because the user looks at the face.
  if (name === 'head') return end && along(end.position, end.axes[0], OVER_HEAD * pose.metresPerUnit);
  return limb.lead === 'place' ? toWorld(pose, limb.place) : end?.position;
}

export function overlay(app: App): TemplateResult | typeof nothing {
  const { pose, player } = app;
  const { clientWidth: width, clientHeight: height } = player;
  if (pose === undefined || width === 0) return nothing;
  const spot = (point: Vector | undefined): ScreenPoint | undefined => point && pose.camera.project(point, width, height);
  const strings = LIMBS.map((name) => {
    const [from, to] = [spot(endOf(pose, name)?.position), spot(handlePlace(app, pose, name))];
    if (name === 'head' || app.state.limbs[name].lead !== 'place' || from === undefined || to === undefined) return nothing;
    return svg`<line x1=${from.x} y1=${from.y} x2=${to.x} y2=${to.y} />`;
  });
  return html`<svg viewBox="0 0 ${width} ${height}" aria-hidden="true">${strings}</svg>${LIMBS.map((name) => {
    const at = spot(handlePlace(app, pose, name));
    return at === undefined ? nothing : handle(app, pose, name, (100 * at.x) / width, (100 * at.y) / height);
  })}`;
}

function handle(app: App, pose: PoseNow, name: LimbName, left: number, top: number): TemplateResult {
  const limb = app.state.limbs[name];
  const [x, y, z] = limb.place;
  const how = name === 'head' ? 'Arrow keys turn it.' : 'Arrow keys move it, page up and page down farther and nearer.';
  const where = limb.lead !== 'place' ? '' : name === 'head' ? ` yaw ${limb.angles[0]}, pitch ${limb.angles[1]} degrees.` : ` ${x} to the left, ${y} up, ${z} to the back.`;
  const classes = ['handle', name === app.limb && app.tab === 'manipulators' ? 'chosen' : '', limb.lead === 'place' ? 'led' : ''].join(' ');
  return html`<button
    type="button"
    class=${classes}
    data-limb=${name}
    aria-label="${LIMB_NAMES[name]}, handle.${where} ${how}"
    ${vars({ '--left': `${left.toFixed(2)}%`, '--top': `${top.toFixed(2)}%` })}
    @pointerdown=${(event: PointerEvent) => drag(app, pose, name, event)}
    @click=${() => choose(app, name)}
    @keydown=${(event: KeyboardEvent) => {
      const by = steps(event);
      if (by === undefined) return;
      event.preventDefault();
      choose(app, name);
      app.lead(name, 'place');
      app.set((s) => {
        const { place, angles } = s.limbs[name];
        if (name === 'head') turnHead(angles, by[0], by[1], 3);
        // From the front, the right of the image is the figure's left.
        else move(place, turned(app, by));
      });
    }}
  ><span></span></button>`;
}

/** Selects the limb of a used handle, and opens its panel. */
function choose(app: App, name: LimbName): void {
  app.limb = name;
  app.tab = 'manipulators';
  app.redraw();
}

function turnHead(angles: Vector3, right: number, up: number, scale: number): void {
  const within = (angle: number, most: number): number => Math.round(Math.min(most, Math.max(-most, angle)));
  // EML counts turns about its own axes: to the figure's left is a negative yaw, up a positive pitch.
  angles[0] = within(angles[0] - right * scale, 99);
  angles[1] = within(angles[1] + up * scale, 70);
}

/** Converts a step in the image to EML's axes. */
function turned(app: App, [right, up, nearer]: Vector3): Vector3 {
  const [sin, cos] = [Math.sin(app.view.turn), Math.cos(app.view.turn)];
  const tenth = (n: number): number => Math.round(n * 10) / 10;
  return [tenth(right * cos + nearer * sin), up, tenth(right * sin - nearer * cos)];
}

function move(place: Vector3, by: Vector3): void {
  for (const i of [0, 1, 2] as const) place[i] = Math.round((place[i] + by[i]) * 10) / 10;
}

function drag(app: App, pose: PoseNow, name: LimbName, event: PointerEvent): void {
  if (event.button !== 0) return;
  const frame = app.player.getBoundingClientRect();
  const begun = handlePlace(app, pose, name);
  if (begun === undefined) return;
  const from = { x: event.clientX, y: event.clientY };
  const at = pose.camera.project(begun, frame.width, frame.height);
  let before: Vector3 | undefined;
  follow(
    event,
    (now) => {
      const [dx, dy] = [now.clientX - from.x, now.clientY - from.y];
      // A press without movement selects and changes nothing.
      if (before === undefined && Math.hypot(dx, dy) < 3) return;
      if (before === undefined) {
        choose(app, name);
        app.lead(name, 'place');
        before = [...app.state.limbs[name][name === 'head' ? 'angles' : 'place']];
      }
      if (name === 'head') {
        const angles: Vector3 = [...before];
        turnHead(angles, dx, -dy, NOD);
        app.change((s) => (s.limbs[name].angles = angles));
        return;
      }
      // In the image plane through the previous position.
      const to = at && pose.camera.unproject({ x: at.x + dx, y: at.y + dy }, frame.width, frame.height, begun, pose.camera.forward);
      if (to !== undefined) app.change((s) => (s.limbs[name].place = toPlace(pose, to)));
    },
    () => app.done(),
  );
}

/** Connects the pad behind the handles: it rotates, moves and zooms the view. */
export function lookAround(app: App, pad: HTMLElement): void {
  const held = new Map<number, ScreenPoint>();
  let spread = 0;
  const apart = (): number => {
    const [a, b] = [...held.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  pad.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    spread = apart();
    follow(
      event,
      (now) => {
        const last = held.get(now.pointerId);
        if (last === undefined) return;
        const [dx, dy] = [now.clientX - last.x, now.clientY - last.y];
        held.set(now.pointerId, { x: now.clientX, y: now.clientY });
        if (held.size > 1) {
          const wider = apart();
          if (spread > 0 && wider > 0) app.look({ zoom: (app.view.zoom * wider) / spread });
          spread = wider;
        } else if (now.shiftKey) {
          shift(app, -dx, dy);
        } else {
          app.look({ turn: app.view.turn - dx * TURN_PER_PIXEL, tilt: app.view.tilt + dy * TURN_PER_PIXEL });
        }
      },
      () => held.delete(event.pointerId),
    );
  });
  zoomByWheel(pad, app);
  pad.addEventListener('keydown', (event) => {
    const by = steps(event);
    if (by !== undefined && event.shiftKey) shift(app, by[0] * 8, by[1] * 8);
    else if (by !== undefined) app.look({ turn: app.view.turn + by[0] * 0.12, tilt: app.view.tilt + by[1] * 0.08, zoom: app.view.zoom * 1.1 ** by[2] });
    else if (event.key === 'Home') app.look(FRONT);
    else if (!zoomByKey(event, app)) return;
    event.preventDefault();
  });
}

/** Moves the centre of the image by pixels. */
function shift(app: App, right: number, up: number): void {
  const { pose, player, view } = app;
  const chest = pose && endOf(pose, 'head');
  if (pose === undefined || chest === undefined) return;
  const metre = pose.camera.pixelsPerMetre(chest.position, player.clientHeight);
  app.look({ right: view.right + right / metre, up: view.up + up / metre });
}

/** Renders buttons for common views. */
export function views(app: App): TemplateResult {
  const { turn, zoom, up } = app.view;
  const near = (a: number, b: number): boolean => Math.abs(a - b) < 0.01;
  const sides = { Front: 0, Left: Math.PI / 2, Back: Math.PI, Right: -Math.PI / 2 };
  return html`<div class="group" role="group" aria-label="View">
    ${Object.entries(sides).map(
      ([name, side]) =>
        html`<button type="button" class="plain" aria-pressed=${near(Math.abs(turn - side) % (2 * Math.PI), 0)} @click=${() => app.look({ ...FRONT, zoom, up, turn: side })}>${name}</button>`,
    )}
    <button type="button" class="plain" aria-label="Farther" @click=${() => app.look({ zoom: zoom / 1.3 })}>−</button>
    <button type="button" class="plain" aria-label="Nearer" @click=${() => app.look({ zoom: zoom * 1.3 })}>+</button>
  </div>`;
}
