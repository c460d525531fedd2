/** Images of the figure: those of its file, decoded, and the paint over them. */

import { showImages } from '../engine/figure.js';
import type { GivenFace } from '../face/given-face.js';
import type { StoryReader } from './story-reader.js';
import type { Engine } from '../base/engine.js';
import type { Diagnostic } from '../base/types.js';

/** Loads the images of a figure. The canvas keeps its last frame until they are decoded, so that a face without skin is never shown. */
export class FigureImages {
  readonly #reader: StoryReader;
  readonly #given: GivenFace;
  /** Returns true if an engine is the one that renders. */
  readonly #draws: (engine: Engine) => boolean;
  #pending = false;
  #missing: Promise<Diagnostic[]> = Promise.resolve([]);
  #closed = false;

  constructor(reader: StoryReader, given: GivenFace, draws: (engine: Engine) => boolean) {
    this.#reader = reader;
    this.#given = given;
    this.#draws = draws;
  }

  /** True while the images are still being decoded. */
  get pending(): boolean {
    return this.#pending;
  }

  /** Diagnostics about missing images, after decoding. */
  get missing(): Promise<Diagnostic[]> {
    return this.#missing;
  }

  /** Decodes the images of the figure that an engine has read, and applies the paint; returns diagnostics about missing images. */
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
    // Images of a later figure may still be decoding; that figure clears the flag itself.
    if (current()) this.#pending = false;
    return missing;
  }

  /** Applies the paint of the face. */
  async paint(engine: Engine): Promise<void> {
    const { figure } = this.#reader.files;
    await this.#given.paint(engine, () => this.#draws(engine) && figure === this.#reader.files.figure);
  }

  /** Cancels loading. */
  close(): void {
    this.#closed = true;
  }
}
