/** What the parts of a player share: the element makes one context and hands it to each of them. */

import { controlWords, type ControlWords } from './control-words.js';
import type { Diagnostics } from './diagnostics.js';
import type { RaconteurPlayer } from './element.js';
import type { PlayerEventMap } from './events.js';
import type { Credentials } from './fetching.js';
import type { MindEvent } from './mind.js';
import type { Questioner } from './questioner.js';
import type { Show } from './show.js';
import type { Story, View } from './types.js';

export interface PlayerContext {
  readonly player: RaconteurPlayer;
  readonly diagnostics: Diagnostics;
  /** The loaded story and its playback. */
  show: Show | undefined;
  /** A text that takes the place of the story's file. */
  text: string | undefined;
  /** From where a page looks that shows the whole figure. */
  view: View | undefined;
  /** The story was played or sought since it was opened. */
  started: boolean;
  /** The player is in the window, or near it. */
  onScreen: boolean;
  /** Tells screen readers what has changed. */
  say(text: string): void;
  /** Tells the mind, if one is connected. */
  tell(event: MindEvent): void;
  /** What is shown instead of a picture goes where the story is. */
  follow(): void;
  /** A picture of a moment was drawn, or another canvas, voice or size is there. */
  drawn(secs?: number): void;
  /** Draws the picture and the caption of the present audio time. */
  advance(): void;
  /** The questions of the story. */
  readonly questioner: Questioner;
  /** The picture is in a window of its own, or in a stream that is taken. */
  isWatchedElsewhere(): boolean;
  /** Starts and stops the loops that draw, as the state of the player needs them. */
  keepTime(): void;
}

/** Dispatches an event of the player's own. */
export function fire<K extends keyof PlayerEventMap>(player: RaconteurPlayer, type: K, detail: PlayerEventMap[K]['detail']): void {
  player.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
}

/** The language of what a player itself says, its controls: its own, or that of the page around it. */
export const controlLanguage = (player: RaconteurPlayer): string => player.lang || languageAround(player);

/** What the controls of a player say. */
export const wordsFor = (player: RaconteurPlayer): ControlWords => controlWords(controlLanguage(player));

/** The language of the page around a player, a tag of BCP 47; that of who reads where the page tells none. */
export function languageAround(player: RaconteurPlayer): string {
  return player.closest<HTMLElement>('[lang]')?.lang || navigator.language;
}

/** What tells no language is said, and read, in this one. */
export function languageOf(player: RaconteurPlayer, story: Story): string {
  return player.lang || story.performer.language || languageAround(player);
}

/** To whom the files of a player's story are asked for with cookies and the like. */
export function credentialsOf({ crossOrigin }: RaconteurPlayer): Credentials {
  return crossOrigin === 'use-credentials' ? 'include' : 'same-origin';
}

/** Where the asset library of a player is. */
export function libraryOf({ assets }: RaconteurPlayer): URL {
  return new URL(assets.endsWith('/') ? assets : `${assets}/`, document.baseURI);
}
