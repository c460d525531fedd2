/** How much of the stage captions take. */

import type { LitElement } from 'lit';

/** A caption that takes more of the stage would make the head too small: a fifth of the height is its due. */
const MAX_CAPTIONS = 0.2;

/** The place of a whole caption on a stage, while there are captions. */
export class CaptionRoom {
  readonly #stage: LitElement;
  #place: Element | null = null;
  #share = 0;

  constructor(stage: LitElement) {
    this.#stage = stage;
  }

  /** Its share of the stage's height when it was measured last. */
  get share(): number {
    return this.#share;
  }

  /** Measures a place that is another one than before. */
  follow(): void {
    if (this.#found() !== this.#place) this.measure();
  }

  /** Looks how much of the stage it takes: where that may have changed, as to look lays the stage out. */
  measure(): void {
    this.#place = this.#found();
    const { clientHeight } = this.#stage;
    this.#share = clientHeight > 0 ? Math.min(MAX_CAPTIONS, (this.#place?.clientHeight ?? 0) / clientHeight) : 0;
  }

  #found(): Element | null {
    return this.#stage.renderRoot.querySelector('.caption-room');
  }
}
