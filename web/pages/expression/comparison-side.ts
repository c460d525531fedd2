/** Player of the page, and its text. */

import type { RaconteurPlayer } from '../../element/element.js';
import { SHOWN_SECS } from './write.js';

/** Time after which a moving control counts as at rest, ms. */
const REST_MS = 120;
/** Duration of the fade-in of the player's new picture, ms. */
const FADED_MS = 550;

export class ComparisonSide {
  #shown = '';
  #wanted = '';
  #timer: ReturnType<typeof setTimeout> | undefined;
  #still: HTMLCanvasElement | undefined;

  constructor(
    readonly player: RaconteurPlayer,
    changed: () => void,
  ) {
    for (const type of ['loadedmetadata', 'error', 'seeked', 'figurechange']) player.addEventListener(type, changed);
    for (const type of ['loadedmetadata', 'error']) player.addEventListener(type, () => this.#came());
  }

  /** Loads a text after a short delay. */
  take(eml: string): void {
    this.#wanted = eml;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#tell(), this.#shown === '' ? 0 : REST_MS);
  }

  /** Shows the time at which everything has settled. */
  stand(): void {
    this.player.currentTime = SHOWN_SECS;
  }

  /** Loads the text as a story between the tags: rehearsed content has room for edited hand positions, which would prevent close-ups. */
  #tell(): void {
    const { player } = this;
    if (this.#wanted === this.#shown) return;
    const { paused, currentTime, playbackRate } = player;
    this.#keepStill();
    this.#shown = player.textContent = this.#wanted;
    // The player has its new text by then.
    queueMicrotask(() => {
      player.currentTime = paused ? SHOWN_SECS : currentTime;
      player.playbackRate = playbackRate;
      if (!paused) player.play().catch(() => undefined);
    });
  }

  /** Keeps the previous frame over the player until the next one is available, to avoid a dark flash. */
  #keepStill(): void {
    const { player } = this;
    if (this.#still !== undefined || player.readyState < 2) return;
    const still = player.snapshot();
    if (still === undefined) return;
    still.className = 'still';
    still.dataset['side'] = player.id;
    still.setAttribute('aria-hidden', 'true');
    player.parentElement?.append(still);
    this.#still = still;
  }

  #came(): void {
    const still = this.#still;
    this.#still = undefined;
    if (still !== undefined) setTimeout(() => still.remove(), FADED_MS);
  }
}
