/** Loading of a player's story: near the viewport, or immediately, and again after attribute changes. */

import type { PlayerContext } from './context.js';
import type { FigureLoader } from './figure-loader.js';
import type { StoryLoader } from './story-loader.js';

export class Arrival {
  readonly #context: PlayerContext;
  readonly #stories: StoryLoader;
  readonly #figures: FigureLoader;
  readonly #renew: () => void;

  /** Creates the loading logic; `renew` unloads the story for another one. */
  constructor(context: PlayerContext, stories: StoryLoader, figures: FigureLoader, renew: () => void) {
    this.#context = context;
    this.#stories = stories;
    this.#figures = figures;
    this.#renew = renew;
  }

  /** Handles changed properties: loads the story, or changes the figure, as required. */
  change(changed: ReadonlyMap<PropertyKey, unknown>): void {
    const { player, show } = this.#context;
    // A mind without a story has a stage, too.
    const minded = changed.has('mind') && !player.src && show === undefined;
    const replaced = minded || ['src', 'backend', 'assets'].some((name) => changed.has(name));
    const figure = (changed.has('figure') || changed.has('handedness')) && player.hasUpdated;
    if (figure && !replaced && show !== undefined) {
      void this.#figures.change(show).then(() => this.#stories.giveVoice());
    } else if ((replaced || figure) && player.hasUpdated) {
      if (replaced) this.#renew();
      else this.#stories.close();
      this.#come();
    } else if (['loading', 'preload', 'autoplay'].some((name) => changed.has(name))) {
      this.#come();
    }
  }

  /** Handles a changed text between the tags. */
  changeOwn(): void {
    if (this.#context.player.src || this.#context.text !== undefined) return;
    this.#renew();
    this.#come();
  }

  /** Handles the player entering or leaving the area near the viewport. */
  appear(isNear: boolean): void {
    this.#context.onScreen = isNear;
    if (isNear && this.#stories.hasStory) void this.#stories.come();
    this.#context.keepTime();
  }

  #come(): void {
    const { player, onScreen } = this.#context;
    if ((onScreen || player.loading === 'eager') && this.#stories.hasStory) void this.#stories.come();
  }
}
