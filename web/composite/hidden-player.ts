/** A player that nobody sees, for pictures of faces that are not on stage. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Quality } from '../element/base/types.js';
import { HeadView, type Look } from '../pages/head-view.js';
import { REST_SECS, still } from './script.js';

/** What the hidden player shows, and how. */
export interface HiddenPlayerOptions {
  /** Called so by tools that look for hidden elements. */
  readonly label: string;
  /** The player of the stage: who shows the face, the library, the back end. */
  readonly like: RaconteurPlayer;
  readonly quality: Quality;
  readonly look: Look;
}

/** A hidden player that stands still with its head in the middle. */
export interface Hidden {
  readonly player: RaconteurPlayer;
  readonly view: HeadView;
  /** Gives back what it takes of the graphics card. */
  close(): void;
}

/** Opens a hidden player in a place that lies unseen in the page. */
export async function openHidden(place: HTMLElement, { label, like, quality, look }: HiddenPlayerOptions): Promise<Hidden> {
  const player = document.createElement('raconteur-player');
  player.label = label;
  player.assets = like.assets;
  player.backend = like.backend;
  player.setAttribute('quality', quality);
  player.loading = 'eager';
  player.figure = like.currentFigure;
  place.append(player);
  const close = (): void => player.remove();
  try {
    await player.rehearse(still, { motion: 0 });
    player.currentTime = REST_SECS;
    const view = new HeadView(player, look, () => undefined);
    view.look({});
    // Where the head is, is known once a picture was drawn.
    player.snapshot(view.view);
    view.centre();
    return { player, view, close };
  } catch (error) {
    close();
    throw error;
  }
}

/** Lets the page do other things for so many milliseconds. */
export const wait = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
