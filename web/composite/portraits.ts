/** Thumbnails of database faces, rendered by a separate player, one after another. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FaceConstraint } from '../element/face/faces.js';
import type { FigureFace } from '../element/base/face-types.js';
import type { App } from './app.js';
import { openHidden, wait } from './hidden-player.js';
import { BoundedMap } from './bounded-map.js';
import { lookOf } from './people.js';

/** Time for which faces must be in view before their images are rendered, milliseconds, since opening a separate player is expensive. */
const LOOKED_AT_MS = 150;
/** Maximum number of stored images. */
const MAX_PORTRAITS = 240;
/** Zoom at which hair and chin are in the image. */
const LOOK = { turn: 0.25, tilt: 0.02, zoom: 6.2 };

export class Portraits {
  readonly #pictures = new BoundedMap<string, string>(MAX_PORTRAITS);
  #player: RaconteurPlayer | undefined;
  #wanted: readonly number[] = [];
  #held: readonly FaceConstraint[] = [];
  #heldKey = '[]';
  #drawing = false;

  /** Creates the renderer; `place` receives the invisible player. */
  constructor(
    private readonly app: App,
    private readonly place: HTMLElement,
  ) {}

  /** Returns the image of a face with the constraints applied, as a data URL; undefined until it is rendered. */
  portraitOf(index: number): string | undefined {
    return this.#pictures.get(this.#key(index));
  }

  #key(index: number): string {
    return `${this.app.player.currentFigure ?? ''} ${index} ${this.#heldKey}`;
  }

  get busy(): boolean {
    return this.#drawing;
  }

  /** Returns the number of these that are rendered. */
  done(indices: readonly number[]): number {
    return indices.filter((index) => this.portraitOf(index) !== undefined).length;
  }

  /** Renders the missing ones of these, with the constraints applied; earlier requests are dropped. */
  want(indices: readonly number[], held: readonly FaceConstraint[]): void {
    this.#wanted = indices;
    this.#held = held;
    this.#heldKey = JSON.stringify(held);
    if (!this.#drawing && this.#next() !== undefined) void this.#draw();
  }

  /** Stops rendering after the present face, since no faces are in view. */
  rest(): void {
    this.#wanted = [];
  }

  /** Releases the player; the next request opens another. */
  release(): void {
    this.#player = undefined;
    this.place.replaceChildren();
  }

  #next(): number | undefined {
    return this.#wanted.find((index) => this.portraitOf(index) === undefined);
  }

  async #draw(): Promise<void> {
    this.#drawing = true;
    await wait(LOOKED_AT_MS);
    try {
      if (this.#next() === undefined) return;
      const player = (this.#player ??= (await openHidden(this.place, { label: 'Faces of the database', like: this.app.player, quality: 'lowest', look: LOOK })).player);
      for (let index = this.#next(); index !== undefined; index = this.#next()) {
        const key = this.#key(index);
        await player.setFace(this.#face(index));
        // Pages with a strict policy may show images as data URLs.
        const picture = player.snapshot()?.toDataURL('image/webp', 0.85);
        if (picture === undefined) throw new Error('there is no picture');
        this.#pictures.set(key, picture);
        // Lets the page handle input between two faces.
        await wait(0);
        this.app.redraw();
      }
    } catch {
      // Without portraits the faces are still available, as words.
      this.#wanted = [];
    } finally {
      this.#drawing = false;
      this.app.redraw();
    }
  }

  /** Returns a face of the database, as it would be taken over; the edited face stays unchanged. */
  #face(index: number): FigureFace {
    const { faces, player } = this.app;
    const own = faces.keep();
    try {
      faces.example(index);
      if (this.#held.length > 0) faces.constrain(this.#held);
      const person = faces.pack.people[index];
      // A portrait does not move, so its soft tissue stays unchanged.
      return { ...faces.face(player.currentFigure ?? ''), moves: true, look: person === undefined ? {} : lookOf(person, player.naturalHair()) };
    } finally {
      faces.restore(own);
    }
  }
}
