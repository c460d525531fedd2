/** Films by the browser's own encoder (WebCodecs), in a container that mediabunny writes. */

import { BufferTarget, getFirstEncodableVideoCodec, Mp4OutputFormat, Output, QUALITY_HIGH, VideoSample, VideoSampleSource, WebMOutputFormat } from 'mediabunny';
import type { FilmWriter, Plan } from './film.js';

/** Begins a film; undefined where the browser has no encoder for it. */
export async function openVideo({ width, height, secsPerFrame }: Plan): Promise<FilmWriter | undefined> {
  const codec = await getFirstEncodableVideoCodec(['vp9', 'vp8', 'avc'], { width, height, bitrate: QUALITY_HIGH });
  if (codec === null) return undefined;
  const isMp4 = codec === 'avc';
  const target = new BufferTarget();
  const output = new Output({ format: isMp4 ? new Mp4OutputFormat() : new WebMOutputFormat(), target });
  const source = new VideoSampleSource({ codec, bitrate: QUALITY_HIGH });
  output.addVideoTrack(source, { frameRate: 1 / secsPerFrame });
  await output.start();
  let frame = 0;
  return {
    extension: isMp4 ? 'mp4' : 'webm',
    add: async (picture) => {
      const sample = new VideoSample(picture, { timestamp: frame * secsPerFrame, duration: secsPerFrame });
      frame += 1;
      try {
        await source.add(sample);
      } finally {
        sample.close();
      }
    },
    finish: async () => {
      await output.finalize();
      if (target.buffer === null) throw new Error('The film could not be written.');
      return new Blob([target.buffer], { type: isMp4 ? 'video/mp4' : 'video/webm' });
    },
    cancel: () => output.cancel(),
  };
}
