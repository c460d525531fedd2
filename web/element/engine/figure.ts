/** Performing figure: the bytes of a figure file, and its images once it is read. */

import type { Engine } from '../base/engine.js';
import { PlayerError, type Diagnostic, type Hand } from '../base/types.js';

/** A fetched figure, ready for an engine. */
export interface FigureFile {
  /** Name used by the page: a library name, an address, or the name of a user's file. */
  readonly name: string;
  /** Origin of the file, for messages. */
  readonly where: string;
  readonly glb: Uint8Array;
  /** Problems of an imported avatar. */
  readonly diagnostics: readonly Diagnostic[];
  /** The dominant hand, where the page chooses it. */
  readonly handedness?: Hand | undefined;
}

/** A figure is not one that can be used. */
export class FigureError extends PlayerError {}

/** Returns the error for an unusable figure, with the file's name. */
export function unusable(where: string, error: unknown): FigureError {
  const reason = (error instanceof Error ? error.message : String(error)).replace(/[.\s]+$/, '');
  return new FigureError(`The figure ${where} cannot be used: ${reason}.`, { cause: error });
}

const GLB_MAGIC = 0x46546c67;

/** Returns true if the file is textual glTF: a brace, optionally after a byte order mark and white space. The engine reads only the binary form. */
function isText(bytes: Uint8Array): boolean {
  const mark = bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf ? 3 : 0;
  const first = bytes.subarray(mark).find((byte) => byte !== 0x20 && (byte < 0x09 || byte > 0x0d));
  return first === 0x7b;
}

/** Returns true if the engine reads these bytes itself; an imported avatar has other bones. The engine reports broken files. */
export function isNative(bytes: Uint8Array): boolean {
  if (isText(bytes)) return false;
  const header = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || header.getUint32(0, true) !== GLB_MAGIC) return true;
  const json = bytes.subarray(20, 20 + header.getUint32(12, true));
  return new TextDecoder().decode(json).includes('"bone_sacroiliac"');
}

/** Makes a figure of a file's bytes; an avatar made elsewhere is converted by a part that is fetched only then. */
export async function prepareFigure(name: string, where: string, bytes: Uint8Array): Promise<FigureFile> {
  if (isNative(bytes)) return { name, where, glb: bytes, diagnostics: [] };
  const { convertAvatar } = await import('../face/avatar.js').catch((error: unknown) => {
    throw new PlayerError('The part that reads imported avatars could not be fetched: is the network available?', { cause: error });
  });
  try {
    return { name, where, ...(await convertAvatar(where, bytes)) };
  } catch (error) {
    throw unusable(where, error);
  }
}

/**
 * Decodes the images of the figure that an engine has read, and hands them over while that figure is the `current` one; returns diagnostics for broken ones.
 */
export async function showImages(engine: Engine, current: () => boolean): Promise<Diagnostic[]> {
  const broken: Diagnostic[] = [];
  const images = Array.from({ length: engine.imageCount() }, (_, i) => i);
  await Promise.all(
    images.map(async (i) => {
      try {
        const picture = new Blob([engine.imageBytes(i) as Uint8Array<ArrayBuffer>], { type: engine.imageType(i) });
        // Normal maps contain numbers, not colours, so conversion and premultiplication are
        // disabled.
        const bitmap = await createImageBitmap(picture, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
        const { width, height } = bitmap;
        const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
        if (context === null) throw new Error('this browser decodes no pictures');
        context.drawImage(bitmap, 0, 0);
        bitmap.close();
        if (current()) engine.setImage(i, width, height, context.getImageData(0, 0, width, height).data);
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        broken.push({ code: 'picture-unreadable', severity: 'warning', message: `Picture ${i + 1} of the figure cannot be shown: ${why}`, hints: [] });
      }
    }),
  );
  return broken;
}
