/** What a picture tells its element of. */

import type { Story } from '../base/types.js';

export interface PictureEvents {
  /** A canvas to show in place of the last one. */
  canvas(canvas: HTMLCanvasElement): void;
  /** The picture went away; sound and captions go on. `recovering`: it is being brought back. */
  lost(recovering: boolean): void;
  /** The picture is back. */
  back(): void;
  /** Animations have come: the story has other times, and problems that are listed apart. `live`: they are of live clauses, the story stays. `anew`: the story was read again, and tells all of its problems. */
  retold(story: Story, live: boolean, anew: boolean): void;
  /** The engine died, for the reason given as a sentence; another one takes its place. */
  failed(message: string): void;
}
