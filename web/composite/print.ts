/** A printable image of the face: a PNG file with its physical size. */

import type { Framing, Side, Studio, ShotObserver } from './shots.js';

/** 10 × 12.5 cm. */
export const PRINT_SIZE = { width: 1181, height: 1476 };
/** 300 dots per inch, in dots per metre. */
const PER_METRE = 11811;
/** Length of a PNG's signature and header, which come first. */
const HEAD_BYTES = 33;

/** Renders printable images from some sides. */
export async function printPictures(studio: Studio, sides: readonly Side[], watch: ShotObserver, framing: Framing): Promise<Blob[]> {
  const files: Blob[] = [];
  for await (const picture of studio.shots(sides, PRINT_SIZE, watch, framing)) {
    const png = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, 'image/png'));
    if (png === null) throw new Error('The browser could not write the picture.');
    files.push(new Blob([withDensity(new Uint8Array(await png.arrayBuffer()))], { type: 'image/png' }));
  }
  return files;
}

/** Returns a PNG with a pixel density chunk (pHYs; PNG 11.3.4.3). Browsers write none. */
export function withDensity(png: Uint8Array): Uint8Array<ArrayBuffer> {
  const chunk = new Uint8Array(21);
  const view = new DataView(chunk.buffer);
  view.setUint32(0, 9);
  chunk.set([0x70, 0x48, 0x59, 0x73], 4);
  view.setUint32(8, PER_METRE);
  view.setUint32(12, PER_METRE);
  chunk[16] = 1;
  view.setUint32(17, crc(chunk.subarray(4, 17)));
  const whole = new Uint8Array(png.length + chunk.length);
  whole.set(png.subarray(0, HEAD_BYTES));
  whole.set(chunk, HEAD_BYTES);
  whole.set(png.subarray(HEAD_BYTES), HEAD_BYTES + chunk.length);
  return whole;
}

/** Returns the checksum of a PNG chunk. */
function crc(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit += 1) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}
