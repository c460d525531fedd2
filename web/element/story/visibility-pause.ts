/**
 * A player that is in no page: it plays as a media element does there, and where it rests it gives back after a while what it
 * holds of the machine. Where it was and what was answered stay, for the time that it plays again or is put back.
 */

import type { PlayerState } from '../base/types.js';

/** So long a player that rests outside a page keeps its story. */
const AWAY_MS = 6000;

/** The player, as far as this is about it. */
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

  /** `release` lets go of the story and of the picture. */
  constructor(player: Player, release: () => void) {
    this.#player = player;
    this.#release = release;
  }

  /** It was taken out, came to rest, or has a story now: where it is in no page, it is given a while. */
  count(): void {
    clearTimeout(this.#timer);
    if (!this.#player.isConnected) this.#timer = setTimeout(() => this.#give(), AWAY_MS);
  }

  /** What was answered in the same story before it was given back. */
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
