/** The state of the face's page: what the controls say, the text that follows from it, and the picture that follows from that. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { Diagnostic, View } from '../../element/types.js';
import { readPose } from '../pose.js';
import { beginning, type State } from './state.js';
import { write } from './write.js';

export type Tab = 'emotion' | 'muscles' | 'direct' | 'visemes';

/** Steps that can be undone. */
const MOST_STEPS = 200;
/** By then everything that is set has come, seconds. */
export const SETTLED_SECS = 2;

/** Ways to look at the head: turns about it, radians. */
export const SIDES = { 'Three-quarter': 0.6, Front: 0, Left: Math.PI / 2, Right: -Math.PI / 2 } as const;
/** So near that the head fills the picture. */
const NEAR = 7;
/** From the skull's joint to the middle of the head, metres: left, up, front. */
const MIDDLE_M = [0, 0.025, 0.03] as const;

/** From where one looks at the head: how far around it and from how far above, radians, and how near. */
export type Look = Pick<View, 'turn' | 'tilt' | 'zoom'>;

export class App {
  state: State = beginning();
  tab: Tab = 'emotion';
  from: Look = { turn: SIDES['Three-quarter'], tilt: 0.02, zoom: NEAR };
  diagnostics: readonly Diagnostic[] = [];
  eml = write(this.state);
  /** What is being fetched or read that may take more than a moment; empty for nothing. */
  busy = '';
  readonly #past: string[] = [];
  readonly #future: string[] = [];
  /** The state that undo brings back. */
  #settled = JSON.stringify(this.state);
  #reading = false;
  #behind = false;
  #drawn = 0;
  #begins = false;
  /** The middle of the head, from what the shot of the whole figure looks at; until it is known, that of somebody of middle height. */
  #head: readonly [number, number, number] = [0, 0.72, 0.05];
  #view: View = { ...this.from, right: 0, up: 0 };

  constructor(
    readonly player: RaconteurPlayer,
    private readonly render: () => void,
    private readonly reread: () => void,
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

  /** Looks from elsewhere; the head stays in the middle. */
  look(look: Partial<Look>): void {
    const next = { ...this.from, ...look };
    this.from = {
      turn: Math.atan2(Math.sin(next.turn), Math.cos(next.turn)),
      tilt: Math.min(1.2, Math.max(-0.8, next.tilt)),
      zoom: Math.min(12, Math.max(1.5, next.zoom)),
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
    // After its eye, the camera tells what it looks at.
    const target = this.player.pose()?.numbers.slice(3, 6);
    const [tx, ty, tz] = target ?? [];
    if (skull === undefined || tx === undefined || ty === undefined || tz === undefined) return;
    const { turn, right, up } = this.#view;
    const shot = [tx - Math.cos(turn) * right, ty - up, tz + Math.sin(turn) * right] as const;
    const head = MIDDLE_M.map((m, i) => (skull.position[i] ?? 0) + m - (shot[i] ?? 0));
    this.#head = [head[0] ?? 0, head[1] ?? 0, head[2] ?? 0];
    this.#aim();
  }

  /** Says what is to be said, from its beginning; when the text is read. */
  fromStart(): void {
    this.#begins = true;
  }

  /** Draws the page soon; many changes are drawn once. */
  redraw(): void {
    if (this.#drawn !== 0) return;
    this.#drawn = requestAnimationFrame(() => {
      this.#drawn = 0;
      this.render();
    });
  }

  #follow(): void {
    this.eml = write(this.state);
    if ((this.player.src ?? '') !== this.state.story) this.player.src = this.state.story === '' ? undefined : this.state.story;
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
      if (this.player.paused && this.player.currentTime < SETTLED_SECS && this.state.speech.kind === 'none') this.player.currentTime = SETTLED_SECS;
    } catch {
      // The player shows what is wrong; where another story took the place of the one that was read, its text follows.
    }
    this.#reading = false;
    if (this.#begins && !this.#reading) {
      this.#begins = false;
      this.player.currentTime = 0;
      this.player.play().catch(() => undefined);
    }
    this.reread();
    this.redraw();
  }
}
