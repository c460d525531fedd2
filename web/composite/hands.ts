/** Pointer actions on the face: turning the head, selecting and moving segments, and placing marks. */

import { readPose } from '../element/engine/pose.js';
import { lookAround } from '../pages/head-view.js';
import type { App } from './app.js';
import { place } from './marks-panel.js';

/** A press that moves less far chooses, pixels. */
const STILL_PX = 5;
/** Pixels of a drag that multiply the size by e. */
const SCALE_PX = 200;
/** A turn of a segment, radians for each pixel. */
const TURN_PER_PX = 0.006;
/** A drag moves no farther, metres; nor larger or smaller than by this factor. */
const MAX_M = 0.02;
const MAX_BYTES = 1.6;

type Vector3 = readonly [number, number, number];

/** Change of the segments by a drag. */
interface Change {
  readonly scale: Vector3;
  readonly turn: Vector3;
  readonly way: Vector3;
}

const within = (x: number, most: number): number => Math.min(most, Math.max(-most, x));

/** Returns the metres of the head per image pixel. */
function metresPerPixel({ player }: App): number {
  const camera = readPose(player)?.camera;
  return camera === undefined ? 0 : 1 / camera.pixelsPerMetre(camera.target, Math.max(1, player.clientHeight));
}

/** Returns the change that a drag makes, seen from `turn` radians around the head. */
export function changeOf(drag: Exclude<App['drag'], 'view'>, right: number, up: number, turn: number, metres: number): Change {
  const still: Change = { scale: [1, 1, 1], turn: [0, 0, 0], way: [0, 0, 0] };
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  if (drag === 'move') {
    const [x, y] = [within(right * metres, MAX_M), within(up * metres, MAX_M)];
    return { ...still, way: [x * cos, y, -x * sin] };
  }
  if (drag === 'turn') {
    // About the axis of the head that is nearest to the line of sight; to the right is clockwise.
    const angle = within(right * TURN_PER_PX, 0.6);
    return Math.abs(sin) > Math.SQRT1_2 ? { ...still, turn: [-Math.sign(sin) * angle, 0, 0] } : { ...still, turn: [0, 0, -Math.sign(cos) * angle] };
  }
  const factor = (pixels: number): number => Math.exp(within(pixels / SCALE_PX, Math.log(MAX_BYTES)));
  return { ...still, scale: Math.abs(sin) > Math.SQRT1_2 ? [1, factor(up), factor(right)] : [factor(right), factor(up), 1] };
}

/** Selects the segment at a position of the window; `more` adds to the selection. */
function choose(app: App, event: PointerEvent): void {
  const spot = app.player.pickFace(event.clientX, event.clientY);
  const nearest = spot?.corners[spot.shares.indexOf(Math.max(...spot.shares))];
  const name = nearest === undefined ? undefined : app.faces.segmentAt(nearest);
  const more = event.shiftKey || event.ctrlKey || event.metaKey;
  const was = name !== undefined && app.segments.has(name);
  if (!more) app.segments.clear();
  if (name !== undefined && was && more) app.segments.delete(name);
  else if (name !== undefined && !(was && !more)) app.segments.add(name);
  app.chosen();
}

/** Connects the pointer pad over the image with the face. */
export function handle(app: App, pad: HTMLElement): void {
  const changes = (): boolean => app.tab === 'parts' && app.drag !== 'view' && (app.segments.size > 0 || app.half !== undefined);
  lookAround(app.view, pad, () => !changes() && app.placing === undefined);
  pad.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    const from = { x: event.clientX, y: event.clientY };
    if (app.placing !== undefined) {
      placeAt(app, from.x, from.y);
      return;
    }
    const { drag, region, tab } = app;
    const metres = metresPerPixel(app);
    const end = new AbortController();
    pad.setPointerCapture(event.pointerId);
    let far = false;
    const move = (now: PointerEvent): void => {
      const [right, up] = [now.clientX - from.x, from.y - now.clientY];
      far ||= Math.hypot(right, up) > STILL_PX;
      if (far && drag !== 'view' && changes()) app.move({ kind: 'transform', ...changeOf(drag, right, up, app.view.from.turn, metres), region });
    };
    const up = (now: PointerEvent): void => {
      end.abort();
      if (far) app.done();
      else if (tab === 'parts') choose(app, now);
    };
    pad.addEventListener('pointermove', move, end);
    pad.addEventListener('pointerup', up, end);
    pad.addEventListener(
      'pointercancel',
      () => {
        end.abort();
        app.done();
      },
      end,
    );
  });
  pad.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && app.placing !== undefined) {
      app.placing = undefined;
      app.redraw();
    } else if (event.key === 'Enter' && app.placing !== undefined) {
      const { left, top, width, height } = app.player.getBoundingClientRect();
      placeAt(app, left + width / 2, top + height / 2);
    } else return;
    event.preventDefault();
  });
}

function placeAt(app: App, x: number, y: number): void {
  const spot = app.player.pickFace(x, y);
  if (spot === undefined) app.showMessage('That is outside the head: click on the skin.');
  else place(app, spot);
}
