/**
 * Player outside a document: it plays like a media element there, and after a time at rest it releases its resources. Its position and answers are kept until
 * it plays again or is reinserted.
 */

import type { PlayerState } from '../base/types.js';

/** Time for which a player at rest outside a document keeps its story, ms. */
const AWAY_MS = 6000;

/** Subset of the player used here. */
interface Player {
  readonly isConnected: boolean;
  readonly paused: boolean;
  currentTime: number;
  state(): PlayerState;
}

export class VisibilityPause {
  readonly #player: Player;
  readonly #release: () => void;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #kept: PlayerState | undefined;

  /** Creates the timer; `release` unloads the story and the picture. */
  constructor(player: Player, release: () => void) {
    this.#player = player;
    this.#release = release;
  }

  /** Starts the timer after removal, coming to rest, or loading, if the player is outside a document. */
  count(): void {
    clearTimeout(this.#timer);
    if (!this.#player.isConnected) this.#timer = setTimeout(() => this.#give(), AWAY_MS);
  }

  /** Returns the answers in the same story from before its release. */
  take(): PlayerState | undefined {
    const kept = this.#kept;
    this.#kept = undefined;
    return kept;
  }

  #give(): void {
    const player = this.#player;
    if (player.isConnected || !player.paused || this.#kept !== undefined) return;
    const state = player.state();
    this.#release();
    this.#kept = state;
    player.currentTime = state.placeSecs;
  }
}
