/** Films as animated GIFs, for browsers without an encoder of their own. */

import { applyPalette, GIFEncoder, quantize } from 'gifenc';
import type { FilmWriter, Plan } from './film.js';

/** Begins a film. */
export function openGif({ width, height, secsPerFrame }: Plan): FilmWriter {
  const gif = GIFEncoder();
  return {
    extension: 'gif',
    add: async (picture) => {
      const pixels = picture.getContext('2d')?.getImageData(0, 0, width, height).data;
      if (pixels === undefined) throw new Error('The film could not be written.');
      const palette = quantize(pixels, 256);
      gif.writeFrame(applyPalette(pixels, palette), width, height, { palette, delay: 1000 * secsPerFrame });
    },
    finish: async () => {
      gif.finish();
      return new Blob([gif.bytes()], { type: 'image/gif' });
    },
    cancel: async () => undefined,
  };
}
