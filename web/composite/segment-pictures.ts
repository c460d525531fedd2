/** Thumbnails of a face with one segment highlighted, for selecting segments. */

import type { Faces } from '../element/face/faces.js';

/** Size of a thumbnail, pixels, and its extent on the head: left and right of the middle, and heights, metres. */
const WIDTH = 84;
const HEIGHT = 108;
const HALF_M = 0.092;
const BOTTOM_M = -0.115;
/** Radius covered by a vertex, pixels, so there are no holes. */
const REACH = 2;
/** Light falls from above and from the left. */
const LIGHT = { x: -0.5, y: 0.85, strength: 14 };
const NOBODY = -1;

/** Colours of skin that is not chosen and that is; bytes. */
const PLAIN = [216, 208, 200] as const;
const LIT = [204, 92, 44] as const;

/** A face from the front: the vertex that each pixel shows, and how bright it is. */
export interface Relief {
  readonly vertices: Int32Array;
  readonly bright: Float32Array;
}

/** Draws the vertices of a skin from the front. */
export function reliefOf(skin: Float64Array): Relief {
  const vertices = new Int32Array(WIDTH * HEIGHT).fill(NOBODY);
  const depth = new Float32Array(WIDTH * HEIGHT).fill(-Infinity);
  const scale = WIDTH / (2 * HALF_M);
  for (let v = 0; 3 * v < skin.length; v += 1) {
    const [x = 0, y = 0, z = 0] = skin.subarray(3 * v, 3 * v + 3);
    const [column, row] = [Math.round((x + HALF_M) * scale), Math.round(HEIGHT - (y - BOTTOM_M) * scale)];
    for (let r = row - REACH; r <= row + REACH; r += 1) {
      for (let c = column - REACH; c <= column + REACH; c += 1) {
        // A vertex farther from its position has lower priority.
        const near = z - 0.0006 * (Math.abs(r - row) + Math.abs(c - column));
        if (r < 0 || c < 0 || r >= HEIGHT || c >= WIDTH || near <= (depth[r * WIDTH + c] ?? 0)) continue;
        depth[r * WIDTH + c] = near;
        vertices[r * WIDTH + c] = v;
      }
    }
  }
  return { vertices, bright: shaded(depth, scale) };
}

/** Brightness from how the depth changes. */
function shaded(depth: Float32Array, scale: number): Float32Array {
  const at = (i: number, other: number): number => {
    const z = depth[i] ?? -Infinity;
    return Number.isFinite(z) ? z : other;
  };
  return depth.map((z, i) => {
    if (!Number.isFinite(z)) return 0;
    const across = (at(i + 2, z) - at(i - 2, z)) * scale * 0.25;
    const down = (at(i + 2 * WIDTH, z) - at(i - 2 * WIDTH, z)) * scale * 0.25;
    const slope = 1 / Math.hypot(1, across, down);
    // Towards the light it rises to the left and falls upwards.
    return Math.min(1.1, 0.45 + 0.6 * slope + 0.03 * LIGHT.strength * slope * (LIGHT.x * -across + LIGHT.y * down) * 0.5);
  });
}

/** Returns the image of a relief with the vertices of a mask highlighted, as a data URL, which pages with a strict policy may show. */
function picture({ vertices, bright }: Relief, mask: Float64Array, canvas: HTMLCanvasElement): string {
  const context = canvas.getContext('2d');
  const image = new ImageData(WIDTH, HEIGHT);
  vertices.forEach((v, i) => {
    if (v === NOBODY) return;
    const colour = (mask[v] ?? 0) > 0 ? LIT : PLAIN;
    colour.forEach((part, k) => (image.data[4 * i + k] = part * (bright[i] ?? 0)));
    image.data[4 * i + 3] = 255;
  });
  context?.putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}

/** Thumbnails of all segments, rendered on the first request. */
export class SegmentPictures {
  #pictures: ReadonlyMap<string, string> | undefined;

  constructor(private readonly faces: Faces) {}

  /** Returns the thumbnail of a segment, of the face at the time of the first request. */
  pictureOf(name: string): string | undefined {
    this.#pictures ??= this.#draw();
    return this.#pictures.get(name);
  }

  #draw(): ReadonlyMap<string, string> {
    const relief = reliefOf(this.faces.skin());
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [WIDTH, HEIGHT];
    return new Map(this.faces.pack.segments.map(({ name }) => [name, picture(relief, this.faces.mask([name]), canvas)]));
  }
}
