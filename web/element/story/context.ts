/** What the parts of a player share: the element makes one context and hands it to each of them. */

import type { LitElement } from 'lit';
import { controlWords, type ControlWords } from '../controls/control-words.js';
import type { Diagnostics } from '../base/diagnostics.js';
import type { PlayerEventMap } from '../base/events.js';
import type { Credentials } from '../base/fetching.js';
import type { MindEvent } from '../base/mind-events.js';
import type { Show } from './show.js';
import type { Question } from '../base/questions.js';
import type { Backend, Hand, PoseNumbers, Story, View } from '../base/types.js';

/** The element as its parts know it: attributes they read, and what they have it do. */
export interface PlayerHost extends LitElement {
  readonly src: string;
  readonly figure: string | undefined;
  readonly handedness: Hand | undefined;
  readonly mind: string | undefined;
  readonly speech: 'here' | 'browser';
  readonly assets: string;
  readonly film: string | undefined;
  readonly backend: Backend | undefined;
  readonly captions: boolean;
  readonly autoplay: boolean;
  readonly preload: string;
  readonly loading: 'lazy' | 'eager';
  readonly crossOrigin: string | null;
  readonly sinkId: string;
  readonly paused: boolean;
  readonly ended: boolean;
  readonly currentTime: number;
  readonly playbackRate: number;
  play(): Promise<void>;
  /** The moment that was shown last, as numbers. */
  pose(): PoseNumbers | undefined;
}

/** The questions of a story as what plays it knows them; `lesson/questioner.ts` asks them. */
export interface StoryQuestions {
  readonly lesson: {
    /** What is asked now. */
    readonly asked: Question | undefined;
    /** Asks what was not in the story. */
    add(questions: readonly Question[]): void;
  };
  readonly form: {
    /** What is read of the last answer. */
    readonly feedback: string;
    /** The bone that the learner looks at; empty where there is none. */
    readonly lookedAt: string;
    focus(): void;
    /** Puts marks where what they mark is seen. */
    place(): unknown;
  };
  /** Whether the story is being moved by what was answered. */
  readonly isTurning: boolean;
  /** The text on stage is another, or has other times. */
  take(story: Story, secs: number): void;
  /** The story goes, and what was answered to it. */
  clear(): void;
  /** Fragments were interrupted. */
  interrupted(): void;
  /** The story was brought to another time. */
  sought(secs: number): void;
  /** The story has come to a time; whether it may be shown. `drain` passes what lies up to a time. */
  pass(show: Show, secs: number, drain: (secs: number) => void): boolean;
}

export interface PlayerContext {
  readonly player: PlayerHost;
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
  readonly questioner: StoryQuestions;
  /** The picture is in a window of its own, or in a stream that is taken. */
  isWatchedElsewhere(): boolean;
  /** Starts and stops the loops that draw, as the state of the player needs them. */
  keepTime(): void;
}

/** Dispatches an event of the player's own. */
export function fire<K extends keyof PlayerEventMap>(player: PlayerHost, type: K, detail: PlayerEventMap[K]['detail']): void {
  player.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
}

/** The language of what a player itself says, its controls: its own, or that of the page around it. */
export const controlLanguage = (player: PlayerHost): string => player.lang || languageAround(player);

/** What the controls of a player say. */
export const wordsFor = (player: PlayerHost): ControlWords => controlWords(controlLanguage(player));

/** The language of the page around a player, a tag of BCP 47; that of who reads where the page tells none. */
export function languageAround(player: PlayerHost): string {
  return player.closest<HTMLElement>('[lang]')?.lang || navigator.language;
}

/** What tells no language is said, and read, in this one. */
export function languageOf(player: PlayerHost, story: Story): string {
  return player.lang || story.performer.language || languageAround(player);
}

/** To whom the files of a player's story are asked for with cookies and the like. */
export function credentialsOf({ crossOrigin }: PlayerHost): Credentials {
  return crossOrigin === 'use-credentials' ? 'include' : 'same-origin';
}

/** Where the asset library of a player is. */
export function libraryOf({ assets }: PlayerHost): URL {
  return new URL(assets.endsWith('/') ? assets : `${assets}/`, document.baseURI);
}
