/** The viewer's state: what the controls say, the text that follows from it, and the picture that follows from that. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { Diagnostic, View } from '../../element/types.js';
import { readPose, type PoseNow } from '../pose.js';
import { jointsNow } from './joints.js';
import { Paces } from './paces.js';
import { beginning, type LimbName, type State } from './state.js';
import { targetNow } from './turns.js';
import { SETTLED_SECS, write } from './write.js';

export type Tab = 'animations' | 'manipulators' | 'look';

/** Steps that can be undone. */
const MOST_STEPS = 200;

/** The whole figure from the front, with room for a hand over the head. */
export const FRONT: View = { turn: 0, tilt: 0.04, zoom: 1.18, right: 0, up: -0.12 };

export class App {
  state: State = beginning();
  tab: Tab = 'animations';
  limb: LimbName = 'rightArm';
  view: View = FRONT;
  diagnostics: readonly Diagnostic[] = [];
  eml = write(this.state);
  /** What the picture shows; undefined before the first. */
  pose: PoseNow | undefined;
  readonly #paces = new Paces(this.state);
  readonly #past: string[] = [];
  readonly #future: string[] = [];
  /** The state that undo brings back. */
  #settled = JSON.stringify(this.state);
  #reading = false;
  #behind = false;
  #drawn = 0;

  constructor(
    readonly player: RaconteurPlayer,
    private readonly render: () => void,
    private readonly renderOverlay: () => void,
  ) {}

  /** Changes a setting while a control moves. */
  change(edit: (state: State) => void): void {
    edit(this.state);
    this.#follow();
  }

  /** The control rests: what it did is one step of undo. */
  done(): void {
    const now = JSON.stringify(this.state);
    if (now === this.#settled) return;
    this.#past.push(this.#settled);
    if (this.#past.length > MOST_STEPS) this.#past.shift();
    this.#future.length = 0;
    this.#settled = now;
    this.redraw();
  }

  /** Changes a setting at once. */
  set(edit: (state: State) => void): void {
    this.change(edit);
    this.done();
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  get isNew(): boolean {
    return this.#settled === JSON.stringify(beginning());
  }

  undo(): void {
    this.#step(this.#past, this.#future);
  }

  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #step(from: string[], to: string[]): void {
    const next = from.pop();
    if (next === undefined) return;
    to.push(this.#settled);
    this.#settled = next;
    this.state = JSON.parse(next) as State;
    this.#follow();
  }

  /** Leads a limb by a target or its joints, beginning where it is. */
  lead(name: LimbName, lead: 'place' | 'joints'): void {
    const limb = this.state.limbs[name];
    this.limb = name;
    if (limb.lead === lead) return;
    limb.lead = lead;
    if (this.pose === undefined) return;
    if (lead === 'place') Object.assign(limb, targetNow(this.pose, name));
    else limb.joints = jointsNow(this.pose, name) ?? limb.joints;
  }

  /** Looks from elsewhere. */
  look(view: Partial<View>): void {
    const next = { ...this.view, ...view };
    this.view = {
      turn: Math.atan2(Math.sin(next.turn), Math.cos(next.turn)),
      tilt: Math.min(1.4, Math.max(-0.5, next.tilt)),
      zoom: Math.min(8, Math.max(0.6, next.zoom)),
      right: Math.min(1, Math.max(-1, next.right)),
      up: Math.min(1.2, Math.max(-1.2, next.up)),
    };
    this.player.look(this.view);
    this.redraw();
  }

  /** Begins at the beginning: every animation and every limb sets out again. */
  restart(): void {
    this.player.currentTime = 0;
  }

  /** Draws the page soon; many changes are drawn once. */
  redraw(): void {
    if (this.#drawn !== 0) return;
    this.#drawn = requestAnimationFrame(() => {
      this.#drawn = 0;
      this.pose = readPose(this.player) ?? this.pose;
      this.render();
    });
  }

  /** The figure has moved by itself: only what lies over the picture goes along. */
  goAlong(): void {
    if (this.#drawn !== 0) return;
    this.pose = readPose(this.player) ?? this.pose;
    this.renderOverlay();
  }

  /** The player has gone elsewhere in its script. */
  sought(): void {
    if (this.#paces.restart(this.player.currentTime)) this.#follow();
  }

  #follow(): void {
    this.#paces.follow(this.state, this.player.currentTime);
    this.eml = write(this.state, (track) => this.#paces.of(track));
    void this.rehearse();
    this.redraw();
  }

  /** Gives the text to the player; while it reads one, the next waits, and those between are never read. */
  async rehearse(): Promise<void> {
    if (this.#reading) {
      this.#behind = true;
      return;
    }
    this.#reading = true;
    try {
      do {
        this.#behind = false;
        this.diagnostics = await this.player.rehearse(this.eml);
      } while (this.#behind);
      // Who changes a standing picture wants to see where it leads.
      if (this.player.paused && this.player.currentTime < SETTLED_SECS) this.player.currentTime = SETTLED_SECS;
    } catch {
      // The player shows what is wrong; without a stage there is nothing to rehearse.
    }
    this.#reading = false;
    this.redraw();
  }
}
