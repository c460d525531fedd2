/** Small pictures of the steps of the history, taken of the stage when nothing else is to be done. */

import type { App } from './app.js';
import { BoundedMap } from './bounded-map.js';
import { cropped } from './shots.js';

/** Pictures that are kept; each takes about two thousand bytes. */
export const MAX_THUMBNAILS = 300;
/** In pixels. */
const SIZE = { width: 72, height: 90 };
/** Who goes on within this time has not come to rest. */
const REST_MS = 500;
/** The page is taken to be idle by then. */
const IDLE_MS = 2000;
/** From here the head fills the picture's height; from farther away less of the picture is the head. */
const NEAR = 7;

export class Thumbnails {
  readonly #pictures = new BoundedMap<number, string>(MAX_THUMBNAILS);
  #history: App['history'] | undefined;
  #waiting: ReturnType<typeof setTimeout> | undefined;

  /** `drawn` hears of each new picture. */
  constructor(
    private readonly app: Pick<App, 'history' | 'player' | 'resting'> & { readonly view: Pick<App['view'], 'zoom'> },
    private readonly drawn: (picture: string) => void,
  ) {}

  /** The picture of a step, as a data URL; undefined where there is none. */
  of(step: number): string | undefined {
    return this.#history === this.app.history ? this.#pictures.get(step) : undefined;
  }

  /** Keeps the picture of a step of the present history. */
  keep(step: number, picture: string): void {
    if (this.#history !== this.app.history) this.#pictures.clear();
    this.#history = this.app.history;
    this.#pictures.set(step, picture);
  }

  /** The stage shows a face: soon its picture is taken, unless another face comes before. */
  shown(): void {
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => whenIdle(() => this.#take()), REST_MS);
  }

  #take(): void {
    const { history, player, resting, view } = this.app;
    if (!resting || !player.paused || this.of(history.here) !== undefined) return;
    const picture = player.snapshot();
    if (picture === undefined) return;
    const small = cropped(picture, SIZE, Math.min(1, view.zoom / NEAR)).toDataURL('image/webp', 0.8);
    this.keep(history.here, small);
    this.drawn(small);
  }
}

/** Not every browser tells when it is idle. */
function whenIdle(work: () => void): void {
  if ('requestIdleCallback' in globalThis) requestIdleCallback(work, { timeout: IDLE_MS });
  else work();
}
