/** A film of the face that turns once: a video where the browser can make one, otherwise an animated GIF. */

import type { Size, Studio, ShotObserver } from './shots.js';

/** Duration of one turn, seconds. */
const SECS = 4;
const VIDEO = { width: 720, height: 900, frames: 96 };
/** Size and frame count of GIFs, which are large and slow to create, so they have fewer and smaller frames. */
const GIF = { width: 360, height: 450, frames: 24 };

/** Parameters of a film. */
export interface Plan extends Size {
  readonly secsPerFrame: number;
}

/** Writer of a film file from its frames. */
export interface FilmWriter {
  readonly extension: 'webm' | 'mp4' | 'gif';
  add(picture: HTMLCanvasElement): Promise<void>;
  finish(): Promise<Blob>;
  /** Discards an unwanted film. */
  cancel(): Promise<void>;
}

/** Returns the turns of a film's frames, radians: once around, without repeating the first. */
export function turnsOf(frames: number): number[] {
  return Array.from({ length: frames }, (_, i) => (2 * Math.PI * i) / frames);
}

/** Records a film of the current face. */
export async function turntable(studio: Studio, watch: ShotObserver): Promise<{ file: Blob; extension: FilmWriter['extension'] }> {
  const { writer, plan } = await open();
  try {
    for await (const picture of studio.shots(
      turnsOf(plan.frames).map((turn) => ({ turn })),
      plan,
      watch,
    ))
      await writer.add(picture);
  } catch (error) {
    await writer.cancel();
    throw error;
  }
  return { file: await writer.finish(), extension: writer.extension };
}

/** Fetches the libraries that write films, on demand. */
async function open(): Promise<{ writer: FilmWriter; plan: typeof VIDEO }> {
  if ('VideoEncoder' in globalThis) {
    const { openVideo } = await import('./film-video.js');
    const writer = await openVideo(planned(VIDEO));
    if (writer !== undefined) return { writer, plan: VIDEO };
  }
  const { openGif } = await import('./film-gif.js');
  return { writer: openGif(planned(GIF)), plan: GIF };
}

const planned = ({ width, height, frames }: typeof VIDEO): Plan => ({ width, height, secsPerFrame: SECS / frames });
