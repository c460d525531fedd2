/** The pictures on the figure: those of its file, decoded, and what is painted over them. */

import { showImages } from '../engine/figure.js';
import type { GivenFace } from '../face/given-face.js';
import type { StoryReader } from './story-reader.js';
import type { Engine } from '../base/engine.js';
import type { Diagnostic } from '../base/types.js';

/** The canvas keeps its last picture until those of the figure are decoded: a face without its skin is not shown. */
export class FigureImages {
  readonly #reader: StoryReader;
  readonly #given: GivenFace;
  /** Whether an engine is the one that draws. */
  readonly #draws: (engine: Engine) => boolean;
  #pending = false;
  #missing: Promise<Diagnostic[]> = Promise.resolve([]);
  #closed = false;

  constructor(reader: StoryReader, given: GivenFace, draws: (engine: Engine) => boolean) {
    this.#reader = reader;
    this.#given = given;
    this.#draws = draws;
  }

  /** They are still being decoded. */
  get pending(): boolean {
    return this.#pending;
  }

  /** What of the figure is missing, once they are decoded. */
  get missing(): Promise<Diagnostic[]> {
    return this.#missing;
  }

  /** Decodes those of the figure that an engine has read, and paints over them; what of the figure is missing. */
  decode(engine: Engine): Promise<Diagnostic[]> {
    return (this.#missing = this.#decode(engine));
  }

  async #decode(engine: Engine): Promise<Diagnostic[]> {
    const { figure } = this.#reader.files;
    const current = () => figure === this.#reader.files.figure && !this.#closed;
    this.#pending = true;
    const missing = await showImages(engine, current);
    if (current()) {
      this.#given.unpaint();
      await this.paint(engine);
    }
    // Those of a later figure may still be decoded; it lifts the hold itself.
    if (current()) this.#pending = false;
    return missing;
  }

  /** Paints what the face has got. */
  async paint(engine: Engine): Promise<void> {
    const { figure } = this.#reader.files;
    await this.#given.paint(engine, () => this.#draws(engine) && figure === this.#reader.files.figure);
  }

  /** Nobody waits for them any more. */
  close(): void {
    this.#closed = true;
  }
}
