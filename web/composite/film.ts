/** A film of the face that turns once: a video where the browser can make one, otherwise an animated GIF. */

import type { Size, Studio, ShotObserver } from './shots.js';

/** One turn takes so long. */
const SECS = 4;
const VIDEO = { width: 720, height: 900, frames: 96 };
/** GIFs are large and slow to make, so there are fewer and smaller pictures. */
const GIF = { width: 360, height: 450, frames: 24 };

/** What a film is to be. */
export interface Plan extends Size {
  readonly secsPerFrame: number;
}

/** Makes the file of a film from its pictures. */
export interface FilmWriter {
  readonly extension: 'webm' | 'mp4' | 'gif';
  add(picture: HTMLCanvasElement): Promise<void>;
  finish(): Promise<Blob>;
  /** Lets go of a film that nobody wants any more. */
  cancel(): Promise<void>;
}

/** The turns of a film's pictures, radians: once around, and not the first again. */
export function turnsOf(frames: number): number[] {
  return Array.from({ length: frames }, (_, i) => (2 * Math.PI * i) / frames);
}

/** The film of the face as it is now. */
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

/** The libraries that write films are fetched only now. */
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
