/** Fetches the figure that performs, and replaces it while the story plays. */

import { captionsOf } from '../captions/captions.js';
import { castFigure, USUAL_FIGURE } from './cast.js';
import { credentialsOf, fire, languageOf, libraryOf, type PlayerContext } from './context.js';
import { lendersOf, type DonorHair } from '../face/face-look.js';
import type { FigureFile } from '../engine/figure.js';
import { fetchFigure, type RequestedFiles } from '../engine/loader.js';
import type { Show } from './show.js';
import { updateMusic } from './sound.js';
import type { FigureFace } from '../base/face-types.js';
import { PlayerError, type Backend } from '../base/types.js';

/** Names in the library have no other letters. */
const LIBRARY_NAME = /^[\w-]+$/;

export class FigureLoader {
  readonly #context: PlayerContext;
  /** Controller of the figure being loaded. */
  #coming: AbortController | undefined;
  /** File supplied by the user, whose name is in `figure`. */
  given: File | undefined;

  constructor(context: PlayerContext) {
    this.#context = context;
  }

  /** True while another figure is being fetched. */
  get busy(): boolean {
    return this.#coming !== undefined;
  }

  /** Fetches the wanted figure: one of the library, of an address, or the user's own file; otherwise the story's choice. */
  async fetch(eml: Promise<string>, backend: Promise<Backend>, wanted: RequestedFiles): Promise<FigureFile> {
    const { player, diagnostics } = this.#context;
    const { figure, handedness } = player;
    const wish = { figure, handedness, given: this.given, library: libraryOf(player), story: new URL(player.src, document.baseURI) };
    return await castFigure(wish, eml, backend, { ...wanted, credentials: credentialsOf(player) }, (d) => diagnostics.report(d));
  }

  /** Files of the library with the hair that a face has. */
  async lent(face: FigureFace | undefined): Promise<DonorHair> {
    const names = face === undefined ? [] : lendersOf(face);
    const library = libraryOf(this.#context.player);
    const files = names.map(async (name): Promise<[string, Uint8Array]> => {
      // A look may come from an untrusted file: a URL would cause a request.
      if (!LIBRARY_NAME.test(name)) throw new PlayerError(`“${name}” is no name of hair of the library.`);
      const { glb } = await fetchFigure(name, library, { signal: new AbortController().signal, progress: () => undefined }, new URL(`hair/${name}.glb`, library));
      return [name, glb];
    });
    return new Map(await Promise.all(files));
  }

  /** Fetches and reads another figure while the current one performs; errors become diagnostics. */
  async change(show: Show): Promise<void> {
    const { player, diagnostics, say } = this.#context;
    this.cancel();
    show.choice = show.story.performer.figure;
    // Back to the figure that is still on stage.
    if ((player.figure || show.choice || USUAL_FIGURE) === show.figure && player.handedness === show.files.figure.handedness) return;
    const { signal } = (this.#coming = new AbortController());
    try {
      const figure = await this.fetch(Promise.resolve(show.files.eml), Promise.resolve(show.picture.backend), { signal, progress: () => undefined });
      signal.throwIfAborted();
      // The substitute for the figure that the story chose is already loaded.
      if (figure.name === show.figure && figure.handedness === show.files.figure.handedness) return;
      await this.#replace(show, figure, signal);
    } catch (error) {
      if (signal.aborted) return;
      const message = error instanceof Error ? error.message : String(error);
      diagnostics.report({ code: 'figure-unusable', severity: 'error', message, hints: ['The previous figure stays on stage.'] });
      say(message);
    } finally {
      if (!signal.aborted) this.#coming = undefined;
      player.requestUpdate();
    }
  }

  async #replace(show: Show, figure: FigureFile, signal: AbortSignal): Promise<void> {
    const { player, diagnostics, say, advance } = this.#context;
    const { story, missing } = await show.picture.setFigure(figure);
    signal.throwIfAborted();
    Object.assign(show, { story, figure: figure.name, files: { ...show.files, figure } });
    // Live clauses ended with the figure that performed them.
    show.script.forget();
    show.captions = captionsOf(story.utterances, languageOf(player, story));
    updateMusic(this.#context, show);
    // Diagnostics of the previous figure are removed with it.
    diagnostics.keepSound();
    for (const diagnostic of [...story.diagnostics, ...figure.diagnostics, ...missing]) diagnostics.report(diagnostic);
    say('Another storyteller is on stage');
    fire(player, 'figurechange', { figure: figure.name });
    advance();
  }

  /** Cancels the figure being fetched. */
  cancel(): void {
    this.#coming?.abort();
    this.#coming = undefined;
  }
}
