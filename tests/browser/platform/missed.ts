/** Rows that the player does not answer as the specification expects. */

export interface Missed {
  readonly test: string;
  readonly why: string;
}

export const missed: readonly Missed[] = [
  { test: '/html/dom/reflection-embedded.html#audio.src: get', why: 'an empty address is no address: the story stands between the tags' },
  { test: '/html/dom/idlharness.https.html#HTMLMediaElement interface: calling canPlayType with too few arguments must throw TypeError', why: 'no argument is taken as a type' },
  { test: 'loading-the-media-resource/resource-selection-invoke-set-src-in-namespace.html', why: 'the browser tells a custom element of attributes of any namespace' },
  { test: 'loading-the-media-resource/resource-selection-remove-src.html', why: 'without an address the story is what stands between the tags' },
  { test: 'error-codes/error.html#instanceof MediaError', why: 'scripts cannot make a MediaError' },
  { test: 'playing-the-media-resource/loop.html#seek to end while paused', why: 'it rests at the end, as in Chromium' },
  { test: 'playing-the-media-resource/loop.html#seek to end while playing', why: 'both seeks are told to their end' },
  { test: 'playing-the-media-resource/pause-remove-from-document-networkState.html', why: 'without an address the story between the tags is looked for, and there is none' },
  { test: 'specification#buffered and seekable', why: 'sound is fetched when it is to play' },
];
