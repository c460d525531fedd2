/** Keeps the picture of a player between stories: device, pipelines and figure textures take longer to create than everything else. */

import type { StoryFiles } from '../engine/loader.js';
import { Picture } from './picture.js';
import type { PictureEvents } from './picture-events.js';
import type { Backend, Diagnostic, Story } from '../base/types.js';

/** Picture that shows a story. */
export interface OpenedPicture {
  readonly picture: Picture;
  readonly story: Story;
  /** Diagnostics about missing parts of the figure. */
  readonly missing: readonly Diagnostic[];
}

/** Owner of the picture of one player. */
export class PictureKeeper {
  #picture: Picture | undefined;
  /** Queue of work: stories in quick succession are read one after another, because there is only one stage. */
  #work: Promise<unknown> = Promise.resolve();
  /** Token replaced when everything is released. */
  #life = {};

  /**
   * Shows a story with the existing picture, or with a new one of the first available back end. Rejects if the story or its figure cannot be read, or if the
   * request is cancelled.
   */
  open(backends: readonly [Backend, ...Backend[]], files: StoryFiles, events: PictureEvents, signal: AbortSignal): Promise<OpenedPicture> {
    const life = this.#life;
    const opened = this.#work.then(async () => {
      signal.throwIfAborted();
      const made = (await this.#reuse(backends, files, events)) ?? (await Picture.open(backends, files, events));
      if (life !== this.#life) made.picture.close();
      else this.#picture = made.picture;
      signal.throwIfAborted();
      return made;
    });
    this.#work = opened.catch(() => undefined);
    return opened;
  }

  async #reuse(backends: readonly Backend[], files: StoryFiles, events: PictureEvents): Promise<OpenedPicture | undefined> {
    const picture = this.#picture;
    if (picture === undefined) return undefined;
    if (!picture.lost && backends.includes(picture.backend)) {
      const told = await picture.replaceStory(files, events);
      if (told !== undefined) return { picture, ...told };
    }
    picture.close();
    this.#picture = undefined;
    return undefined;
  }

  /** Releases the picture, including one still being created. */
  close(): void {
    this.#life = {};
    this.#picture?.close();
    this.#picture = undefined;
  }
}
