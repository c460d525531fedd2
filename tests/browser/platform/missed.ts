/** Rows in which the player's answer differs from the specification. */

export interface Missed {
  readonly test: string;
  readonly why: string;
}

export const missed: readonly Missed[] = [
  { test: '/html/dom/reflection-embedded.html#audio.src: get', why: 'an empty address is no address: the story stands between the tags' },
  { test: 'error-codes/error.html#instanceof MediaError', why: 'scripts cannot make a MediaError' },
  { test: 'playing-the-media-resource/pause-remove-from-document-networkState.html', why: 'without an address the story between the tags is looked for, and there is none' },
  { test: 'specification#buffered and seekable', why: 'sound is fetched when it is to play' },
];
