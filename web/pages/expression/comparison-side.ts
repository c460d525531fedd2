/** One player of the page, and the text that it tells. */

import type { RaconteurPlayer } from '../../element/element.js';
import { SHOWN_SECS } from './write.js';

/** A control that moves has come to rest. */
const REST_MS = 120;
/** By then the player has faded its new picture in. */
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

  /** Tells a text, soon. */
  take(eml: string): void {
    this.#wanted = eml;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#tell(), this.#shown === '' ? 0 : REST_MS);
  }

  /** Shows the moment at which all has come. */
  stand(): void {
    this.player.currentTime = SHOWN_SECS;
  }

  /** As a story between the tags: a text that is rehearsed has the room that hands may need when it is edited, so that no shot of it is near. */
  #tell(): void {
    const { player } = this;
    if (this.#wanted === this.#shown) return;
    const { paused, currentTime, playbackRate } = player;
    this.#keepStill();
    this.#shown = player.textContent = this.#wanted;
    // The player has seen its new text by then.
    queueMicrotask(() => {
      player.currentTime = paused ? SHOWN_SECS : currentTime;
      player.playbackRate = playbackRate;
      if (!paused) player.play().catch(() => undefined);
    });
  }

  /** Leaves the picture of before over the player until the next one is there: nothing goes dark between them. */
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
