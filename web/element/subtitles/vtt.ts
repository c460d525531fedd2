/** WebVTT files, fetched by a player only where a page has subtitles. */

import { parseText } from 'media-captions';

/** First line of a file; a byte order mark is gone after decoding. */
const HEADER = /^WEBVTT(?=[ \t\r\n]|$)/;

/**
 * Returns the cues of a file; undefined if it is not WebVTT. The browser's own reader needs an address of the file that the policy `media-src 'self'` does not
 * allow for data in memory. Settings of a cue's place are dropped: subtitles are where the story's captions are.
 */
export async function cuesOf(text: string): Promise<VTTCue[] | undefined> {
  if (!HEADER.test(text)) return undefined;
  const { cues } = await parseText(text, { type: 'vtt' });
  return cues.map((cue) => Object.assign(new VTTCue(cue.startTime, cue.endTime, cue.text), { id: cue.id }));
}
