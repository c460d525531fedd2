/** Thumbnails of the steps of the history, captured from the stage when idle. */

import type { App } from './app.js';
import { BoundedMap } from './bounded-map.js';
import { cropped } from './shots.js';

/** Maximum number of stored thumbnails; each takes about two thousand bytes. */
export const MAX_THUMBNAILS = 300;
/** Size of a thumbnail, pixels. */
const SIZE = { width: 72, height: 90 };
/** Time without changes after which the face counts as resting, milliseconds. */
const REST_MS = 500;
/** Time after which the page is assumed idle, milliseconds. */
const IDLE_MS = 2000;
/** Zoom from which the head fills the image height; at less zoom the head fills a smaller part. */
const NEAR = 7;

export class Thumbnails {
  readonly #pictures = new BoundedMap<number, string>(MAX_THUMBNAILS);
  #history: App['history'] | undefined;
  #waiting: ReturnType<typeof setTimeout> | undefined;

  /** Creates the collection; `drawn` is called for each new thumbnail. */
  constructor(
    private readonly app: Pick<App, 'history' | 'player' | 'resting'> & { readonly view: Pick<App['view'], 'zoom'> },
    private readonly drawn: (picture: string) => void,
  ) {}

  /** Returns the thumbnail of a step, as a data URL; undefined if there is none. */
  thumbnailOf(step: number): string | undefined {
    return this.#history === this.app.history ? this.#pictures.get(step) : undefined;
  }

  /** Stores the thumbnail of a step of the present history. */
  keep(step: number, picture: string): void {
    if (this.#history !== this.app.history) this.#pictures.clear();
    this.#history = this.app.history;
    this.#pictures.set(step, picture);
  }

  /** Called when the stage shows a face: its thumbnail is captured soon, unless another face follows. */
  shown(): void {
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => whenIdle(() => this.#take()), REST_MS);
  }

  #take(): void {
    const { history, player, resting, view } = this.app;
    if (!resting || !player.paused || this.thumbnailOf(history.here) !== undefined) return;
    const picture = player.snapshot();
    if (picture === undefined) return;
    const small = cropped(picture, SIZE, Math.min(1, view.zoom / NEAR)).toDataURL('image/webp', 0.8);
    this.keep(history.here, small);
    this.drawn(small);
  }
}

/** Calls a function when idle; not every browser reports idle time. */
function whenIdle(work: () => void): void {
  if ('requestIdleCallback' in globalThis) requestIdleCallback(work, { timeout: IDLE_MS });
  else work();
}
