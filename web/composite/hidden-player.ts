/** Invisible player for images of faces that are not on stage. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Quality } from '../element/base/types.js';
import { HeadView, type Look } from '../pages/head-view.js';
import { REST_SECS, still } from './script.js';

/** Content of the hidden player. */
export interface HiddenPlayerOptions {
  /** Name for tools that list hidden elements. */
  readonly label: string;
  /** The player of the stage: its figure, library and back end are used. */
  readonly like: RaconteurPlayer;
  readonly quality: Quality;
  readonly look: Look;
}

/** A hidden, paused player with its head in the centre. */
export interface Hidden {
  readonly player: RaconteurPlayer;
  readonly view: HeadView;
  /** Releases its graphics resources. */
  close(): void;
}

/** Opens a hidden player in an invisible part of the page. */
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
    // The position of the head is known only after a frame was rendered.
    player.snapshot(view.view);
    view.centre();
    return { player, view, close };
  } catch (error) {
    close();
    throw error;
  }
}

/** Waits for a number of milliseconds, so the page can do other work. */
export const wait = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
