/** Overlay on the picture: the paths of the wrists, and the handle of the edited position. */

import { html, nothing, svg, type TemplateResult } from 'lit';
import { along, type PoseNow, type ScreenPoint, type Vector } from '../../element/engine/pose.js';
import type { App } from './app.js';
import { handle } from './fields.js';
import { mirror, mirrored, trackOf, HANDS, type Track, type Vector3 } from './gesture.js';

/** Converts an EML position to the world, metres. */
export function toWorld({ origin, metresPerUnit }: PoseNow, [x, y, z]: Vector3, world: boolean): Vector {
  const [ox, oy, oz] = world ? [0, 0, 0] : origin;
  return [ox + x * metresPerUnit, oy + y * metresPerUnit, oz - z * metresPerUnit];
}

/** Converts a point in the world to an EML position. */
export function toPlace({ origin, metresPerUnit }: PoseNow, [x, y, z]: Vector, world: boolean): Vector3 {
  const [ox, oy, oz] = world ? [0, 0, 0] : origin;
  return [(x - ox) / metresPerUnit, (y - oy) / metresPerUnit, (oz - z) / metresPerUnit];
}

/** Returns the world axis nearest to a direction: dragging in a frontal view means left and up, without a small change in depth. */
function nearestAxis(direction: Vector): Vector {
  const sizes = direction.map(Math.abs);
  const most = sizes.indexOf(Math.max(...sizes));
  const axis = (i: number): number => (i === most ? Math.sign(direction[i] ?? 1) : 0);
  return [axis(0), axis(1), axis(2)];
}

const tenths = (place: Vector3): Vector3 => [Math.round(place[0] * 10) / 10, Math.round(place[1] * 10) / 10, Math.round(place[2] * 10) / 10];

/** Returns the current wrist position, in EML coordinates: the initial value of a new key. */
export function wristNow(app: App, world: boolean): Vector3 | undefined {
  const wrist = app.pose?.joints.find((joint) => joint.name === `bone_${app.hand === 'left' ? 'l' : 'r'}_wrist`);
  return wrist && app.pose && tenths(toPlace(app.pose, wrist.position, world));
}

export function overlay(app: App): TemplateResult | typeof nothing {
  const { pose, phase, player } = app;
  const { clientWidth: width, clientHeight: height } = player;
  if (pose === undefined || phase === undefined || width === 0) return nothing;
  const spot = (place: Vector3, world: boolean): ScreenPoint | undefined => pose.camera.project(toWorld(pose, place, world), width, height);

  const paths = HANDS.flatMap((hand) => {
    const track = trackOf(phase, 'place', hand);
    if (track === undefined) return [];
    const other = mirrored(phase, track, hand);
    const spots = track.keys.flatMap(({ value }) => {
      const place = (other ? mirror(value) : value).place;
      const at = place && spot(place, track.world);
      return at ? [at] : [];
    });
    return svg`<g class=${hand === app.hand ? 'mine' : 'other'}>
      <polyline points=${spots.map(({ x, y }) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ')} />
      ${spots.map(({ x, y }) => svg`<circle cx=${x.toFixed(1)} cy=${y.toFixed(1)} r="4" />`)}
    </g>`;
  });
  const track = app.track('place');
  const grips = app.tab === 'place' && track !== undefined ? track.keys.map((_, i) => grip(app, pose, track, i, spot)) : nothing;
  return html`<svg viewBox="0 0 ${width} ${height}" aria-hidden="true">${paths}</svg>${grips}`;
}

/** Renders the handle of a position; the edited one is larger. */
function grip(app: App, pose: PoseNow, track: Track, index: number, spot: (place: Vector3, world: boolean) => ScreenPoint | undefined): TemplateResult | typeof nothing {
  const key = track.keys[index];
  const place = key?.value.place;
  const at = place && spot(place, track.world);
  if (key === undefined || place === undefined || at === undefined) return nothing;
  const { clientWidth: width, clientHeight: height } = app.player;
  const mine = (): boolean => index === app.keyIndex('place');
  /** Returns the current position: key presses may come faster than the page is rendered. */
  const live = (): Vector3 => app.track('place')?.keys[index]?.value.place ?? place;
  const set = (to: Vector3): void => app.setValue('place', { place: tenths(to) }, index);
  return handle({
    label: `Place ${index + 1} of ${track.keys.length}, ${place[0]} to the left, ${place[1]} up, ${place[2]} to the back. Arrow keys move it, page up and page down nearer and farther.`,
    classes: mine() ? 'place chosen' : 'place',
    left: (100 * at.x) / width,
    top: (100 * at.y) / height,
    drag: (to, _frame, event) => {
      if (!mine()) app.selectKey(app.phaseIndex, 'place', index);
      const { camera } = pose;
      const pressed = toWorld(pose, place, track.world);
      const ahead = nearestAxis(camera.forward);
      // In the plane across the view, through where it was; with the shift key away from it, upwards being farther.
      const point = event.shiftKey ? along(pressed, ahead, (at.y - to.y) / camera.pixelsPerMetre(pressed, height)) : camera.unproject(to, width, height, pressed, ahead);
      if (point !== undefined) set(toPlace(pose, point, track.world));
    },
    key: (right, up, nearer) => {
      if (!mine()) app.selectKey(app.phaseIndex, 'place', index);
      const { camera, metresPerUnit } = pose;
      const steps: [Vector, number][] = [
        [camera.right, right],
        [camera.up, up],
        [camera.forward, -nearer],
      ];
      const moved = steps.reduce((point, [axis, units]) => along(point, nearestAxis(axis), units * metresPerUnit), toWorld(pose, live(), track.world));
      set(toPlace(pose, moved, track.world));
      return true;
    },
    done: () => app.done(),
  });
}
