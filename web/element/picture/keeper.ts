/** Keeps the picture of a player from one story to the next: a device, its pipelines and the figure's pictures take longer to make than all the rest. */

import type { StoryFiles } from '../engine/loader.js';
import { Picture } from './picture.js';
import type { PictureEvents } from './picture-events.js';
import type { Backend, Diagnostic, Story } from '../base/types.js';

/** A picture that shows a story. */
export interface OpenedPicture {
  readonly picture: Picture;
  readonly story: Story;
  /** What of the figure could not be shown. */
  readonly missing: readonly Diagnostic[];
}

/** Owns the picture of one player. */
export class PictureKeeper {
  #picture: Picture | undefined;
  /** Stories that come quickly after each other are read one after another: there is one stage. */
  #work: Promise<unknown> = Promise.resolve();
  /** Changes when everything is given back. */
  #life = {};

  /**
   * Shows a story with the picture that is there, or with a new one of the first back end that gives
   * one. Rejects when the story or its figure cannot be read, and when it is not wanted any more.
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

  /** Releases the picture, also one that is still being made. */
  close(): void {
    this.#life = {};
    this.#picture?.close();
    this.#picture = undefined;
  }
}
