/** Images of the present face from any side and of any size, rendered by a hidden player; the stage is not affected. */

import type { RaconteurPlayer } from '../element/element.js';
import type { App } from './app.js';
import { LEVEL } from '../pages/head-view.js';
import { openHidden, wait } from './hidden-player.js';
import { beforeWall } from './plain.js';
import { REST_SECS, still, stillIn } from './script.js';

/** Framings of an image: zoom, and offset of the image centre below the middle of the head, metres. */
export const FRAMES = {
  head: { name: 'Head', zoom: 5.4, lower: 0 },
  shoulders: { name: 'Head and shoulders', zoom: 4.1, lower: 0.045 },
} as const;
/** Set that differs most from the curtain, for separating the face from its background. */
const OTHER_SET = 'garden';
/** Maximum time until another set is shown, milliseconds. */
const SHOWN_MS = 250;
/** The player draws no more pixels for a CSS pixel. */
const MAX_DPR = 2;

/** Direction from which a face is seen, radians; at eye height without a tilt. */
export interface Side {
  readonly turn: number;
  readonly tilt?: number;
}

/** Size of an image, pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Options for rendering images. */
export interface Framing {
  readonly frame: keyof typeof FRAMES;
  /** True for a plain wall as background and even light. */
  readonly plain: boolean;
}

export const HEAD: Framing = { frame: 'head', plain: false };

/** Observer of images in progress: receives the count, and may cancel. */
export interface ShotObserver {
  readonly signal: AbortSignal;
  progress(done: number, of: number): void;
}

/** Renderer of images. */
export class Studio {
  /** Creates the studio; `place` receives the invisible player. */
  constructor(
    private readonly app: App,
    private readonly place: HTMLElement,
  ) {}

  /** Renders images of the present face, one for each side. Throws the signal's reason once it is aborted. */
  async *shots(sides: readonly Side[], size: Size, { signal, progress }: ShotObserver, { frame, plain }: Framing = HEAD): AsyncGenerator<HTMLCanvasElement, void> {
    const { face, light, player: like } = this.app;
    const { zoom, lower } = FRAMES[frame];
    progress(0, sides.length);
    const { player, view, close } = await openHidden(this.place, {
      label: 'Pictures of the face',
      like,
      // A stage is rendered simply for speed. A still image takes its time, unless the page
      // requested a lower quality.
      quality: like.quality === 'auto' ? 'high' : like.quality,
      look: { turn: 0, tilt: LEVEL, ...sides[0], zoom },
    });
    try {
      signal.throwIfAborted();
      player.light(plain ? 'studio' : light.name, light.turn);
      await player.setFace(face);
      // The player is enlarged only now, so that earlier rendering costs little.
      await enlarge(player, size);
      const take = (side: Side): HTMLCanvasElement => {
        const picture = view.picture({ tilt: LEVEL, ...side }, lower);
        if (picture === undefined) throw new Error('There is no picture of the face.');
        return cropped(picture, size);
      };
      const others: HTMLCanvasElement[] = [];
      if (plain) {
        await place(player, stillIn(OTHER_SET));
        for (const side of sides) {
          others.push(take(side));
          await wait(0);
          signal.throwIfAborted();
        }
        await place(player, still);
      }
      for (const [i, side] of sides.entries()) {
        const picture = take(side);
        const other = others[i];
        yield other === undefined ? picture : beforeWall(picture, other);
        progress(i + 1, sides.length);
        // Lets the page handle input between two images.
        await wait(0);
        signal.throwIfAborted();
      }
    } finally {
      close();
    }
  }

  /** Returns all images of some sides. */
  async all(sides: readonly Side[], size: Size, watch: ShotObserver, framing?: Framing): Promise<HTMLCanvasElement[]> {
    const pictures: HTMLCanvasElement[] = [];
    for await (const picture of this.shots(sides, size, watch, framing)) pictures.push(picture);
    return pictures;
  }
}

/** Changes the set of a motionless figure, and waits until it is visible. */
async function place(player: RaconteurPlayer, script: string): Promise<void> {
  await player.rehearse(script, { motion: 0 });
  player.currentTime = REST_SECS;
  await wait(SHOWN_MS);
}

/** Sets the pixel size of a player to that of an image, and waits until it takes effect. */
export async function enlarge(player: RaconteurPlayer, { width, height }: Size): Promise<void> {
  const dpr = Math.min(MAX_DPR, devicePixelRatio || 1);
  await new Promise<void>((resolve) => {
    // Observers are called in the order of their creation, and the player's own is older.
    const seen = new ResizeObserver(([entry]) => {
      if ((entry?.contentRect.width ?? 0) < width / dpr - 1) return;
      seen.disconnect();
      resolve();
    });
    [player.style.width, player.style.height] = [`${Math.ceil(width / dpr)}px`, `${Math.ceil(height / dpr)}px`];
    seen.observe(player);
  });
}

/** Crops the middle of an image to another size: the largest part of that aspect, or a share of it. */
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
