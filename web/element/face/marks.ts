/** Scars, moles, birthmarks and tattoos, freckles and stubble, painted into the skin texture; fetched only by pages that paint some. */

import { hexOf } from '../base/colour.js';
import type { SkinPaint } from './face-look.js';
import { Speckles } from './speckles.js';
import type { Engine } from '../base/engine.js';
import type { FaceMark, TattooShape } from '../base/face-types.js';

/** Two-dimensional context of an `OffscreenCanvas`. */
type Context = OffscreenCanvasRenderingContext2D;

/** Blend mode of the paint: the texture multiplies the colour of the skin, so paint is the remaining share of each colour. */
const MULTIPLY = 'multiply';
/** Softness of the scalp's border, share of the texture's width. */
const SOFT = 0.01;
/** Half the side of the skin square that gives a bare scalp its mean colour, share of the texture's width. */
const LIKE = 0.012;
/** JPEG quality of a texture in a figure's file. */
const JPEG_QUALITY = 0.92;

const SHAPES: Readonly<Record<Exclude<TattooShape, 'text'>, (context: Context) => void>> = {
  star: (context) => {
    for (let i = 0; i < 10; i += 1) {
      const [far, turn] = [i % 2 === 0 ? 0.5 : 0.2, (Math.PI * i) / 5];
      context.lineTo(far * Math.sin(turn), -far * Math.cos(turn));
    }
    context.closePath();
    context.fill();
  },
  heart: (context) => {
    context.moveTo(0, 0.42);
    context.bezierCurveTo(-0.62, 0.02, -0.46, -0.5, -0.2, -0.42);
    context.bezierCurveTo(-0.08, -0.4, 0, -0.3, 0, -0.2);
    context.bezierCurveTo(0, -0.3, 0.08, -0.4, 0.2, -0.42);
    context.bezierCurveTo(0.46, -0.5, 0.62, 0.02, 0, 0.42);
    context.fill();
  },
  cross: (context) => {
    context.fillRect(-0.07, -0.5, 0.14, 1);
    context.fillRect(-0.32, -0.24, 0.64, 0.14);
  },
  anchor: (context) => {
    context.lineWidth = 0.08;
    context.arc(0, -0.4, 0.08, 0, 2 * Math.PI);
    context.moveTo(0, -0.32);
    context.lineTo(0, 0.44);
    context.moveTo(-0.2, -0.18);
    context.lineTo(0.2, -0.18);
    context.moveTo(-0.38, 0.12);
    context.quadraticCurveTo(-0.3, 0.44, 0, 0.46);
    context.quadraticCurveTo(0.3, 0.44, 0.38, 0.12);
    context.stroke();
  },
  dots: (context) => {
    for (const [x, y] of [
      [0, -0.3],
      [-0.28, 0.18],
      [0.28, 0.18],
    ] as const) {
      context.moveTo(x + 0.12, y);
      context.arc(x, y, 0.12, 0, 2 * Math.PI);
    }
    context.fill();
  },
};

/** Letters in a tattoo, at most. */
const MAX_LETTERS = 24;

function tattoo(context: Context, { shape = 'star', text = '' }: FaceMark): void {
  context.globalCompositeOperation = MULTIPLY;
  context.fillStyle = context.strokeStyle = 'rgb(40 52 70 / 0.88)';
  if (shape !== 'text') {
    SHAPES[shape](context);
    return;
  }
  // Browsers set type in whole pixels, so it is drawn large and scaled down.
  context.font = '600 100px serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const letters = text.slice(0, MAX_LETTERS);
  const share = 1 / Math.max(100, context.measureText(letters).width);
  context.scale(share, share);
  context.fillText(letters, 0, 0);
}

/** Draws a round spot, darker in its middle. */
function spot(context: Context, middle: string, edge: string, half: number): void {
  const gradient = context.createRadialGradient(0, 0, 0, 0, 0, half);
  gradient.addColorStop(0, middle);
  gradient.addColorStop(0.65, middle);
  gradient.addColorStop(1, edge);
  context.fillStyle = gradient;
  context.beginPath();
  context.arc(0, 0, half, 0, 2 * Math.PI);
  context.fill();
}

function mole(context: Context): void {
  context.globalCompositeOperation = MULTIPLY;
  spot(context, 'rgb(96 62 50)', 'rgb(255 255 255)', 0.5);
}

/** Draws a birthmark: several spots around each other, like a port-wine stain. */
function birthmark(context: Context): void {
  context.globalCompositeOperation = MULTIPLY;
  const places = [
    [0, 0, 1],
    [0.22, 0.1, 0.7],
    [-0.2, 0.14, 0.75],
    [0.08, -0.24, 0.6],
    [-0.12, -0.16, 0.55],
    [0.3, -0.12, 0.4],
  ] as const;
  for (const [x, y, size] of places) {
    context.save();
    context.translate(x, y);
    context.scale(size, size);
    spot(context, 'rgb(232 184 182)', 'rgb(255 255 255)', 0.32);
    context.restore();
  }
}

/** Draws a healed cut: a paler ridge in reddened skin, with the shade that the ridge casts. */
function scar(context: Context): void {
  const line = (colour: string, width: number, off: number, mode: GlobalCompositeOperation): void => {
    context.globalCompositeOperation = mode;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineCap = 'round';
    context.beginPath();
    context.moveTo(-0.5, off + 0.02);
    context.quadraticCurveTo(-0.05, off - 0.07, 0.5, off + 0.03);
    context.stroke();
  };
  line('rgb(255 236 232)', 0.17, 0, MULTIPLY);
  line('rgb(246 205 198)', 0.09, 0, MULTIPLY);
  line('rgb(196 146 138)', 0.025, 0.03, MULTIPLY);
  line('rgb(255 240 235 / 0.6)', 0.035, -0.008, 'soft-light');
}

const DRAW: Readonly<Record<FaceMark['kind'], (context: Context, mark: FaceMark) => void>> = { scar, mole, birthmark, tattoo };

/** Skin texture of a figure, and a canvas to paint over it. */
export class PaintedSkin {
  readonly #bare: ImageBitmap;
  readonly #context: Context;
  readonly #index: number;
  readonly #speckles = new Speckles();

  constructor(bare: ImageBitmap, context: Context, index: number) {
    this.#bare = bare;
    this.#context = context;
    this.#index = index;
  }

  /** Paints freckles, stubble and marks over the bare skin, and displays the result. Marks at positions that the skin does not have are skipped. */
  paint(engine: Engine, marks: readonly FaceMark[], paint: SkinPaint): void {
    const context = this.#context;
    const { width, height } = context.canvas;
    context.resetTransform();
    context.globalCompositeOperation = 'copy';
    context.drawImage(this.#bare, 0, 0);
    const scalp = engine.scalp();
    if (scalp !== undefined) this.#scalp(scalp);
    this.#speckles.draw(context, engine, paint);
    for (const mark of marks) {
      const chart = engine.faceChart(Float64Array.from([...mark.corners, ...mark.shares]));
      if (chart === undefined) continue;
      const [u = 0, v = 0, rightU = 0, rightV = 0, upU = 0, upV = 0] = chart;
      context.save();
      // One is a metre of skin, x to the right and y downwards; then as long as the mark.
      context.setTransform(rightU * width, rightV * height, -upU * width, -upV * height, u * width, v * height);
      context.rotate(mark.turn);
      context.scale(mark.size, mark.size);
      context.globalAlpha = mark.strength ?? 1;
      context.beginPath();
      DRAW[mark.kind](context, mark);
      context.restore();
    }
    engine.setImage(this.#index, width, height, context.getImageData(0, 0, width, height).data);
  }

  /** Colours the skin under hair, with a soft border; bare areas look like the forehead. */
  #scalp([r = 0, g = 0, b = 0, u = 0, v = 0, count = 0, ...places]: Float32Array): void {
    const { width, height } = this.#context.canvas;
    const bare = places.slice(2 * count);
    if (bare.length > 0) {
      const half = Math.ceil(width * LIKE);
      const { data } = this.#context.getImageData(Math.round(u * width) - half, Math.round(v * height) - half, 2 * half, 2 * half);
      const mean = [0, 1, 2].map((i) => {
        let sum = 0;
        for (let k = i; k < data.length; k += 4) sum += data[k] ?? 0;
        return Math.round((4 * sum) / data.length);
      });
      this.#fill(bare, `rgb(${mean.join(' ')})`);
    }
    this.#fill(places.slice(0, 2 * count), hexOf([r, g, b]));
  }

  #fill(corners: readonly number[], colour: string): void {
    const context = this.#context;
    const { width, height } = context.canvas;
    context.beginPath();
    corners.forEach((u, i) => {
      if (i % 2 === 1) return;
      const [x, y] = [u * width, (corners[i + 1] ?? 0) * height];
      if (i % 6 === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    context.globalCompositeOperation = 'source-over';
    context.filter = `blur(${width * SOFT}px)`;
    context.fillStyle = colour;
    context.fill();
    context.filter = 'none';
  }

  /** Returns the painted texture as a JPEG. */
  async file(): Promise<Uint8Array> {
    const blob = await this.#context.canvas.convertToBlob({ type: 'image/jpeg', quality: JPEG_QUALITY });
    return new Uint8Array(await blob.arrayBuffer());
  }
}

/** Side of a texture painted for speed, pixels. */
const SOON_PX = 512;

/** Opens the skin of the figure that an engine has read for painting, at full or at reduced resolution; undefined if it has no skin texture. */
export async function openSkin(engine: Engine, isFine: boolean): Promise<PaintedSkin | undefined> {
  const index = engine.skinImage();
  if (index === undefined) return undefined;
  const file = new Blob([engine.imageBytes(index) as Uint8Array<ArrayBuffer>], { type: engine.imageType(index) });
  const size = isFine ? {} : { resizeWidth: SOON_PX, resizeHeight: SOON_PX };
  const bare = await createImageBitmap(file, { colorSpaceConversion: 'none', premultiplyAlpha: 'none', ...size });
  const context = new OffscreenCanvas(bare.width, bare.height).getContext('2d', { willReadFrequently: true });
  return context === null ? undefined : new PaintedSkin(bare, context, index);
}
