/** Events from a picture to its element. */

import type { Story } from '../base/types.js';

export interface PictureEvents {
  /** Provides a canvas that replaces the last one. */
  canvas(canvas: HTMLCanvasElement): void;
  /** Reports a lost picture; audio and captions continue. `recovering`: it is being restored. */
  lost(recovering: boolean): void;
  /** Reports a restored picture. */
  back(): void;
  /**
   * Reports a story with new times and separate diagnostics after animations have loaded. `live`: they belong to live clauses, the story stays. `anew`: the
   * story was read again, with all of its diagnostics.
   */
  retold(story: Story, live: boolean, anew: boolean): void;
  /** Reports a fatal engine error with its reason as a sentence; another engine replaces it. */
  failed(message: string): void;
}
