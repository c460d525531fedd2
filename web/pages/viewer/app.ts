/** State of the viewer: its settings, the selected limb, and the view. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { View } from '../../element/base/types.js';
import { PageState } from '../page-state.js';
import { leastTilt } from '../pad.js';
import { minus, readPose, type PoseNow } from '../../element/engine/pose.js';
import { jointsNow } from './joints.js';
import { SpeedHistory } from './paces.js';
import { beginning, type LimbName, type State } from './state.js';
import { targetNow } from './turns.js';
import { write } from './write.js';

export type Tab = 'animations' | 'manipulators' | 'look';

/** The whole figure from the front, with room for a hand over the head. */
export const FRONT: View = { turn: 0, tilt: 0.04, zoom: 1.18, right: 0, up: -0.12 };

/** Time after which the picture shows the new view, ms. */
const SHOWN_MS = 250;

export class App extends PageState<State> {
  tab: Tab = 'animations';
  limb: LimbName = 'rightArm';
  view: View = FRONT;
  /** Pose of the picture; undefined before the first frame. */
  pose: PoseNow | undefined;
  readonly #paces = new SpeedHistory(this.state);
  /** Reference shot of the view: height of its centre and camera distance, metres. Until known, those of a person of medium height. */
  #shot = { height: 0.9, distance: 5 };
  #lookedMs = -Infinity;

  constructor(
    player: RaconteurPlayer,
    private readonly render: () => void,
    private readonly renderOverlay: () => void,
  ) {
    super(player, beginning, write);
  }

  /** Controls a limb by a target or by its joints, from its current position. */
  lead(name: LimbName, lead: 'place' | 'joints'): void {
    const limb = this.state.limbs[name];
    this.limb = name;
    if (limb.lead === lead) return;
    limb.lead = lead;
    if (this.pose === undefined) return;
    if (lead === 'place') Object.assign(limb, targetNow(this.pose, name));
    else limb.joints = jointsNow(this.pose, name) ?? limb.joints;
  }

  /** Zoom of the view. */
  get zoom(): number {
    return this.view.zoom;
  }

  /** Changes the view. */
  look(view: Partial<View>): void {
    const next = { ...this.view, ...view };
    const zoom = Math.min(8, Math.max(0.6, next.zoom));
    const up = Math.min(1.2, Math.max(-1.2, next.up));
    const least = leastTilt(this.#shot.height + up, this.#shot.distance / zoom);
    this.view = {
      turn: Math.atan2(Math.sin(next.turn), Math.cos(next.turn)),
      tilt: Math.min(1.4, Math.max(-0.5, least, next.tilt)),
      zoom,
      right: Math.min(1, Math.max(-1, next.right)),
      up,
    };
    this.#lookedMs = performance.now();
    this.player.look(this.view);
    this.redraw();
  }

  /** Begins at the beginning: every animation and every limb sets out again. */
  restart(): void {
    this.player.currentTime = 0;
  }

  protected override draw(): void {
    this.#readPose();
    this.render();
  }

  #readPose(): void {
    this.pose = readPose(this.player) ?? this.pose;
    if (this.pose === undefined || performance.now() - this.#lookedMs < SHOWN_MS) return;
    const { eye, target } = this.pose.camera;
    this.#shot = { height: target[1] - this.view.up, distance: Math.hypot(...minus(eye, target)) * this.view.zoom };
  }

  /** Updates only the overlay after the figure has moved by itself. */
  goAlong(): void {
    if (this.drawing) return;
    this.#readPose();
    this.renderOverlay();
  }

  /** Handles a seek of the player to another time of its script. */
  sought(): void {
    if (this.#paces.restart(this.player.currentTime)) this.update();
  }

  protected override follow(): string {
    this.#paces.follow(this.state, this.player.currentTime);
    return write(this.state, (track) => this.#paces.of(track));
  }
}
