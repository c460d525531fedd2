/** Replacement for the picture: the page's film, otherwise its poster. */

import type { PlayerContext } from './context.js';
import type { Film } from '../picture/film.js';

export class FallbackFilm {
  readonly #context: PlayerContext;
  #film: Film | undefined;
  /** Addresses of the film loaded or being fetched; undefined if none is needed. */
  #wanted: string | undefined;

  constructor(context: PlayerContext) {
    this.#context = context;
  }

  /** Film, once it is known to be needed; undefined if there is none. */
  get video(): HTMLVideoElement | undefined {
    return this.#film?.video;
  }

  /** Opens or closes the film as required; `lost`: there is no picture. */
  keep(lost: boolean): void {
    const { film } = this.#context.player;
    const wanted = lost && this.#context.show !== undefined ? film?.trim() || undefined : undefined;
    if (wanted === this.#wanted) return;
    this.#close();
    this.#wanted = wanted;
    if (wanted !== undefined) void this.#open(wanted);
  }

  /** Synchronises the film with the story. */
  follow(): void {
    const { show } = this.#context;
    if (show === undefined || this.#film === undefined) return;
    const { position, paused, waiting, rate } = show.transport;
    this.#film.follow({ secs: position, runs: !paused && !waiting && rate > 0, rate });
  }

  async #open(wanted: string): Promise<void> {
    try {
      const { Film } = await import('../picture/film.js');
      if (wanted !== this.#wanted) return;
      const addresses = wanted.split(/\s+/).flatMap((address) => (URL.canParse(address, document.baseURI) ? new URL(address, document.baseURI) : []));
      this.#film = new Film(addresses, () => this.#miss(wanted));
    } catch {
      this.#miss(wanted);
      return;
    }
    this.follow();
    this.#context.player.requestUpdate();
  }

  /** Falls back to the poster. */
  #miss(wanted: string): void {
    if (wanted !== this.#wanted) return;
    // The film stays selected, so that it is not requested repeatedly.
    this.#film?.close();
    this.#film = undefined;
    const message = `The film ${wanted} cannot be played; the story continues without a picture.`;
    this.#context.diagnostics.report({ code: 'film-missing', severity: 'warning', message, hints: ['Make one with “raconteur render --video”.'] });
  }

  #close(): void {
    this.#film?.close();
    this.#film = undefined;
    this.#wanted = undefined;
  }
}
