/** What is shown where no picture can be drawn: the film that the page names, else its poster. */

import type { PlayerContext } from './context.js';
import type { Film } from '../picture/film.js';

export class FallbackFilm {
  readonly #context: PlayerContext;
  #film: Film | undefined;
  /** The addresses of the film that is there or being fetched; undefined where none is wanted. */
  #wanted: string | undefined;

  constructor(context: PlayerContext) {
    this.#context = context;
  }

  /** The film, once it is known that one is needed; undefined where there is none. */
  get video(): HTMLVideoElement | undefined {
    return this.#film?.video;
  }

  /** Opens or closes the film as the player needs it now: `lost`, there is no picture. */
  keep(lost: boolean): void {
    const { film } = this.#context.player;
    const wanted = lost && this.#context.show !== undefined ? film?.trim() || undefined : undefined;
    if (wanted === this.#wanted) return;
    this.#close();
    this.#wanted = wanted;
    if (wanted !== undefined) void this.#open(wanted);
  }

  /** Goes where the story is. */
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

  /** The poster stands in for it. */
  #miss(wanted: string): void {
    if (wanted !== this.#wanted) return;
    // It stays the one that is wanted, so that it is not asked for again and again.
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
