/**
 * Full-quality rendering of a resting face with software rendering: the stage renders simply to be fast, and a full-quality image replaces it once the face
 * rests.
 */

import type { App } from './app.js';
import { openHidden, type Hidden } from './hidden-player.js';
import { enlarge } from './shots.js';

/** Time without changes after which the face counts as resting, milliseconds. */
const REST_MS = 1200;
/** Qualities at which the stage lacks lines and fine hair. */
const SIMPLE: readonly string[] = ['lowest', 'low'];

export class FineDetail {
  #hidden: Promise<Hidden> | undefined;
  #figure: string | undefined;
  #waiting: ReturnType<typeof setTimeout> | undefined;
  /** Change counter: an outdated image is not shown. */
  #changes = 0;
  #drawing = false;

  /** Creates the view: `place` receives its player, `over` lies over the stage; it waits while others are `busy` rendering. */
  constructor(
    private readonly app: App,
    private readonly place: HTMLElement,
    private readonly over: HTMLCanvasElement,
    private readonly busy: () => boolean,
  ) {}

  /** Called when the stage shows something else. */
  changed(): void {
    this.#changes += 1;
    this.over.hidden = true;
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => void this.#draw(), REST_MS);
  }

  /** Releases the player. */
  release(): void {
    clearTimeout(this.#waiting);
    void this.#hidden?.then(({ close }) => close()).catch(() => undefined);
    this.#hidden = undefined;
    this.over.hidden = true;
  }

  async #draw(): Promise<void> {
    const { app } = this;
    const { player } = app;
    if (this.busy()) {
      this.changed();
      return;
    }
    if (this.#drawing || !app.resting || !player.paused || !player.isConnected || player.quality !== 'auto' || !SIMPLE.includes(player.statistics?.quality ?? '')) return;
    this.#drawing = true;
    const before = this.#changes;
    try {
      const picture = await this.#picture();
      if (before === this.#changes && picture !== undefined) this.#show(picture);
    } catch (error) {
      // The stage itself is there.
      console.warn('raconteur: no fine picture', error);
    }
    this.#drawing = false;
    if (before !== this.#changes) this.changed();
  }

  async #picture(): Promise<HTMLCanvasElement | undefined> {
    const { app, place } = this;
    const { player } = app;
    if (this.#figure !== player.currentFigure) this.release();
    this.#figure = player.currentFigure;
    this.#hidden ??= openHidden(place, { label: 'The face at rest', like: player, quality: 'high', look: app.view.from });
    const { player: hidden } = await this.#hidden;
    hidden.light(app.light.name, app.light.turn);
    await hidden.setFace(app.shown);
    const dpr = devicePixelRatio || 1;
    await enlarge(hidden, { width: player.clientWidth * dpr, height: player.clientHeight * dpr });
    return hidden.snapshot(app.view.view);
  }

  #show(picture: HTMLCanvasElement): void {
    const { over } = this;
    [over.width, over.height] = [picture.width, picture.height];
    over.getContext('2d')?.drawImage(picture, 0, 0);
    over.hidden = false;
  }
}
