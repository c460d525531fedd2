/** The state of the face's page: its settings, and from where one looks at the head. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { View } from '../../element/types.js';
import { leastTilt } from '../pad.js';
import { PageState } from '../page-state.js';
import { minus, readPose } from '../../element/pose.js';
import { beginning, type State } from './state.js';
import { write } from './write.js';

export type Tab = 'emotion' | 'muscles' | 'direct' | 'visemes';

/** Ways to look at the head: turns about it, radians. */
export const SIDES = { 'Three-quarter': 0.6, Front: 0, Left: Math.PI / 2, Right: -Math.PI / 2 } as const;
/** So near that the head fills the picture. */
const NEAR = 7;
/** From the skull's joint to the middle of the head, metres: left, up, front. */
const MIDDLE_M = [0, 0.025, 0.03] as const;

/** From where one looks at the head: how far around it and from how far above, radians, and how near. */
export type Look = Pick<View, 'turn' | 'tilt' | 'zoom'>;

export class App extends PageState<State> {
  tab: Tab = 'emotion';
  from: Look = { turn: SIDES['Three-quarter'], tilt: 0.02, zoom: NEAR };
  /** The running fetch or read that may take more than a moment; empty for none. */
  busy = '';
  #begins = false;
  /** The middle of the head, from what the shot of the whole figure looks at; until it is known, that of somebody of middle height. */
  #head: readonly [number, number, number] = [0, 0.72, 0.05];
  /** How high the middle of the head is, and how far the camera of the whole figure from what that looks at, metres. */
  #height = 1.6;
  #distance = 5;
  #view: View = { ...this.from, right: 0, up: 0 };

  constructor(
    player: RaconteurPlayer,
    private readonly render: () => void,
    private readonly reread: () => void,
  ) {
    super(player, beginning, write);
  }

  /** How near one looks. */
  get zoom(): number {
    return this.from.zoom;
  }

  /** Looks from elsewhere; the head stays in the middle. */
  look(look: Partial<Look>): void {
    const next = { ...this.from, ...look };
    const zoom = Math.min(12, Math.max(1.5, next.zoom));
    this.from = {
      turn: Math.atan2(Math.sin(next.turn), Math.cos(next.turn)),
      tilt: Math.min(1.2, Math.max(-0.8, leastTilt(this.#height, this.#distance / zoom), next.tilt)),
      zoom,
    };
    this.#aim();
    this.redraw();
  }

  /** Turns the camera: its middle moves in the plane of the picture, which turns with it. */
  #aim(): void {
    const { turn } = this.from;
    const [x, y, z] = this.#head;
    this.#view = { ...this.from, right: x * Math.cos(turn) - z * Math.sin(turn), up: y };
    this.player.look(this.#view);
  }

  /** Finds where the head is, and brings it into the middle: figures are of different height. Read it when a picture has been drawn since the last look. */
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
  }

  /** Speaks from the beginning, once the text is read. */
  fromStart(): void {
    this.#begins = true;
  }

  protected override draw(): void {
    this.render();
  }

  protected override follow(): string {
    const { story } = this.state;
    if ((this.player.src ?? '') !== story) this.player.src = story === '' ? undefined : story;
    return write(this.state);
  }

  /** Speech is shown from its heard time. */
  protected override get showsEnd(): boolean {
    return this.state.speech.kind === 'none';
  }

  protected override read(): void {
    if (this.#begins) {
      this.#begins = false;
      this.player.currentTime = 0;
      this.player.play().catch(() => undefined);
    }
    this.reread();
  }
}
