/** Small pictures of faces of the database, drawn by a player of their own, one after another. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FaceConstraint, Faces } from '../element/faces.js';
import { HeadView } from '../pages/head-view.js';
import { SETTLED_SECS } from '../pages/page-state.js';
import { still } from './script.js';

/** Pictures that are kept. */
const MOST = 240;
/** By then the picture of a look that was asked for is shown, milliseconds. */
const SHOWN_MS = 250;
/** So near that hair and chin are in the picture. */
const NEAR = 6.2;

export class Portraits {
  readonly #pictures = new Map<string, string>();
  #player: RaconteurPlayer | undefined;
  #wanted: readonly number[] = [];
  #held: readonly FaceConstraint[] = [];
  #heldKey = '[]';
  #drawing = false;

  /** `place` is where the player goes, unseen; `figure` tells who shows the faces; `drawn` hears of each new picture; `like` has the library and the back end. */
  constructor(
    private readonly faces: Faces,
    private readonly place: HTMLElement,
    private readonly figure: () => string | undefined,
    private readonly drawn: () => void,
    private readonly like: Pick<RaconteurPlayer, 'assets' | 'backend'>,
  ) {}

  /** The picture of a face that holds what is held, as a data URL; undefined until it was drawn. */
  of(index: number): string | undefined {
    return this.#pictures.get(this.#key(index));
  }

  #key(index: number): string {
    return `${this.figure() ?? ''} ${index} ${this.#heldKey}`;
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
    try {
      const player = (this.#player ??= await this.#open());
      for (let index = this.#next(); index !== undefined; index = this.#next()) {
        const key = this.#key(index);
        await player.setFace(this.#face(index));
        // Pages of a strict policy may show pictures that are data.
        const picture = player.snapshot()?.toDataURL('image/webp', 0.85);
        if (picture === undefined) throw new Error('there is no picture');
        this.#keep(key, picture);
        // The page goes on between two faces.
        await wait(0);
        this.drawn();
      }
    } catch {
      // Without pictures the faces are still there, by their words.
      this.#wanted = [];
    }
    this.#drawing = false;
    this.drawn();
  }

  /** A face of the database, as it would be taken over; the face that is edited stays as it is. */
  #face(index: number): ReturnType<Faces['face']> {
    const own = this.faces.keep();
    try {
      this.faces.example(index);
      if (this.#held.length > 0) this.faces.constrain(this.#held);
      return this.faces.face(this.figure() ?? '');
    } finally {
      this.faces.restore(own);
    }
  }

  #keep(key: string, picture: string): void {
    this.#pictures.set(key, picture);
    for (const old of this.#pictures.keys()) {
      if (this.#pictures.size <= MOST) break;
      this.#pictures.delete(old);
    }
  }

  async #open(): Promise<RaconteurPlayer> {
    const player = document.createElement('raconteur-player');
    player.label = 'Faces of the database';
    player.assets = this.like.assets;
    player.backend = this.like.backend;
    player.setAttribute('quality', 'low');
    player.loading = 'eager';
    player.figure = this.figure();
    this.place.replaceChildren(player);
    await player.rehearse(still);
    player.currentTime = SETTLED_SECS;
    const view = new HeadView(player, { turn: 0.25, tilt: 0.02, zoom: NEAR }, () => undefined);
    view.look({});
    await wait(SHOWN_MS);
    view.centre();
    await wait(SHOWN_MS);
    return player;
  }
}

const wait = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
