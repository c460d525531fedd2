/** Space that captions take on the stage. */

import type { LitElement } from 'lit';

/** Maximum share of the stage height for captions: a larger caption would make the head too small. */
const MAX_CAPTIONS = 0.2;

/** Space of a full caption on a stage, while captions are enabled. */
export class CaptionRoom {
  readonly #stage: LitElement;
  #place: Element | null = null;
  #share = 0;

  constructor(stage: LitElement) {
    this.#stage = stage;
  }

  /** Share of the stage's height at the last measurement. */
  get share(): number {
    return this.#share;
  }

  /** Measures the space if it differs from the previous one. */
  follow(): void {
    if (this.#found() !== this.#place) this.measure();
  }

  /** Measures the share of the stage, only if it may have changed, since measuring forces layout. */
  measure(): void {
    this.#place = this.#found();
    const { clientHeight } = this.#stage;
    this.#share = clientHeight > 0 ? Math.min(MAX_CAPTIONS, (this.#place?.clientHeight ?? 0) / clientHeight) : 0;
  }

  #found(): Element | null {
    return this.#stage.renderRoot.querySelector('.caption-room');
  }
}
