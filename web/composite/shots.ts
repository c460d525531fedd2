/** Pictures of the present face from any side and of any size, by a hidden player: the stage is left alone. */

import type { RaconteurPlayer } from '../element/element.js';
import type { App } from './app.js';
import { openHidden, wait } from './hidden-player.js';

/** The eyes of who looks are as high as those of the face, and the whole head with its hair is in the picture. */
const TILT = 0.02;
const NEAR = 5.4;
/** The player draws no more pixels for a CSS pixel. */
const MOST_DPR = 2;

/** In pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Who waits for pictures: hears how many there are, and may not want them any more. */
export interface Watch {
  readonly signal: AbortSignal;
  progress(done: number, of: number): void;
}

/** Where pictures are taken. */
export class Studio {
  /** `place` is where the player goes, unseen. */
  constructor(
    private readonly app: App,
    private readonly place: HTMLElement,
  ) {}

  /** Pictures of the face as it is now, one for each turn about the head (radians). Throws the signal's reason once that is aborted. */
  async *shots(turns: readonly number[], size: Size, { signal, progress }: Watch): AsyncGenerator<HTMLCanvasElement, void> {
    const { face, light, player: like } = this.app;
    progress(0, turns.length);
    const { player, view, close } = await openHidden(this.place, {
      label: 'Pictures of the face',
      like,
      // Where the stage can be drawn but simply, so can this.
      quality: like.statistics?.quality === 'lowest' ? 'lowest' : 'high',
      look: { turn: turns[0] ?? 0, tilt: TILT, zoom: NEAR },
    });
    try {
      signal.throwIfAborted();
      player.light(light.name, light.turn);
      await player.setFace(face);
      // Large only now, so that what is drawn until here costs little.
      await enlarge(player, size);
      for (const [i, turn] of turns.entries()) {
        const picture = view.picture({ turn });
        if (picture === undefined) throw new Error('There is no picture of the face.');
        yield cropped(picture, size);
        progress(i + 1, turns.length);
        // The page goes on between two pictures.
        await wait(0);
        signal.throwIfAborted();
      }
    } finally {
      close();
    }
  }

  /** All pictures of some turns. */
  async all(turns: readonly number[], size: Size, watch: Watch): Promise<HTMLCanvasElement[]> {
    const pictures: HTMLCanvasElement[] = [];
    for await (const picture of this.shots(turns, size, watch)) pictures.push(picture);
    return pictures;
  }
}

/** Gives a player as many pixels as a picture is to have, and waits until it knows. */
export async function enlarge(player: RaconteurPlayer, { width, height }: Size): Promise<void> {
  const dpr = Math.min(MOST_DPR, devicePixelRatio || 1);
  await new Promise<void>((resolve) => {
    // Observers are told one after another, and the player's own is older.
    const seen = new ResizeObserver(([entry]) => {
      if ((entry?.contentRect.width ?? 0) < width / dpr - 1) return;
      seen.disconnect();
      resolve();
    });
    [player.style.width, player.style.height] = [`${Math.ceil(width / dpr)}px`, `${Math.ceil(height / dpr)}px`];
    seen.observe(player);
  });
}

/** The middle of a picture in another size: as much of it as has that shape, or a share of that. */
export function cropped(from: HTMLCanvasElement, { width, height }: Size, share = 1): HTMLCanvasElement {
  const to = document.createElement('canvas');
  [to.width, to.height] = [width, height];
  const scale = share * Math.min(from.width / width, from.height / height);
  const [w, h] = [width * scale, height * scale];
  const context = to.getContext('2d');
  if (context !== null) {
    context.imageSmoothingQuality = 'high';
    context.drawImage(from, (from.width - w) / 2, (from.height - h) / 2, w, h, 0, 0, width, height);
  }
  return to;
}
