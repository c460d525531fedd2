/** Small pictures of faces of the database, drawn by a player of their own, one after another. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FaceConstraint } from '../element/face/faces.js';
import type { FigureFace } from '../element/base/face-types.js';
import type { App } from './app.js';
import { openHidden, wait } from './hidden-player.js';
import { BoundedMap } from './bounded-map.js';
import { lookOf } from './people.js';

/** Who looks at faces for so long wants their pictures, milliseconds; a player of its own is no small thing to open. */
const LOOKED_AT_MS = 150;
/** Pictures that are kept. */
const MAX_PORTRAITS = 240;
/** So near that hair and chin are in the picture. */
const LOOK = { turn: 0.25, tilt: 0.02, zoom: 6.2 };

export class Portraits {
  readonly #pictures = new BoundedMap<string, string>(MAX_PORTRAITS);
  #player: RaconteurPlayer | undefined;
  #wanted: readonly number[] = [];
  #held: readonly FaceConstraint[] = [];
  #heldKey = '[]';
  #drawing = false;

  /** `place` is where the player goes, unseen. */
  constructor(
    private readonly app: App,
    private readonly place: HTMLElement,
  ) {}

  /** The picture of a face that holds what is held, as a data URL; undefined until it was drawn. */
  of(index: number): string | undefined {
    return this.#pictures.get(this.#key(index));
  }

  #key(index: number): string {
    return `${this.app.player.currentFigure ?? ''} ${index} ${this.#heldKey}`;
  }

  get busy(): boolean {
    return this.#drawing;
  }

  /** How many of these are there. */
  done(indices: readonly number[]): number {
    return indices.filter((index) => this.of(index) !== undefined).length;
  }

  /** Draws what of these is not there yet, adapted to what is held; those asked for before are left out. */
  want(indices: readonly number[], held: readonly FaceConstraint[]): void {
    this.#wanted = indices;
    this.#held = held;
    this.#heldKey = JSON.stringify(held);
    if (!this.#drawing && this.#next() !== undefined) void this.#draw();
  }

  /** Nobody looks at faces now: none is drawn after the present one. */
  rest(): void {
    this.#wanted = [];
  }

  /** Lets go of the player; the next faces that are wanted get another. */
  release(): void {
    this.#player = undefined;
    this.place.replaceChildren();
  }

  #next(): number | undefined {
    return this.#wanted.find((index) => this.of(index) === undefined);
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
        // Pages of a strict policy may show pictures that are data.
        const picture = player.snapshot()?.toDataURL('image/webp', 0.85);
        if (picture === undefined) throw new Error('there is no picture');
        this.#pictures.set(key, picture);
        // The page goes on between two faces.
        await wait(0);
        this.app.redraw();
      }
    } catch {
      // Without pictures the faces are still there, by their words.
      this.#wanted = [];
    } finally {
      this.#drawing = false;
      this.app.redraw();
    }
  }

  /** A face of the database, as it would be taken over; the face that is edited stays as it is. */
  #face(index: number): FigureFace {
    const { faces, player } = this.app;
    const own = faces.keep();
    try {
      faces.example(index);
      if (this.#held.length > 0) faces.constrain(this.#held);
      const person = faces.pack.people[index];
      // A portrait does not move: what would be soft in it is left as it was.
      return { ...faces.face(player.currentFigure ?? ''), moves: true, look: person === undefined ? {} : lookOf(person, player.naturalHair()) };
    } finally {
      faces.restore(own);
    }
  }
}
