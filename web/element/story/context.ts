/** Shared context of a player's parts: the element creates one and passes it to each of them. */

import type { LitElement } from 'lit';
import { controlWords, type ControlWords } from '../controls/control-words.js';
import type { Diagnostics } from '../base/diagnostics.js';
import type { PlayerEventMap } from '../base/events.js';
import type { Credentials } from '../base/fetching.js';
import type { MindEvent } from '../base/mind-events.js';
import type { Show } from './show.js';
import type { Question } from '../base/questions.js';
import type { Backend, Hand, PoseNumbers, Story, View } from '../base/types.js';

/** Element as seen by its parts: attributes that they read, and methods that they call. */
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
  /** Returns the pose at the last shown time, as numbers. */
  pose(): PoseNumbers | undefined;
}

/** Questions of a story, as seen by the playback; implemented by `lesson/questioner.ts`. */
export interface StoryQuestions {
  readonly lesson: {
    /** Current question. */
    readonly asked: Question | undefined;
    /** Adds questions outside the story. */
    add(questions: readonly Question[]): void;
  };
  readonly form: {
    /** Feedback on the last answer. */
    readonly feedback: string;
    /** Bone that the learner focuses; empty if there is none. */
    readonly lookedAt: string;
    focus(): void;
    /** Moves markers to the displayed positions of their objects. */
    place(): unknown;
  };
  /** True while an answer moves the story. */
  readonly isTurning: boolean;
  /** Handles another text on stage, or other times of its questions. */
  take(story: Story, secs: number): void;
  /** Clears the answers of an unloaded story. */
  clear(): void;
  /** Fragments were interrupted. */
  interrupted(): void;
  /** Handles a seek to another time. */
  sought(secs: number): void;
  /** Advances to a time; returns true if it may be shown. `drain` processes the cues up to a time. */
  pass(show: Show, secs: number, drain: (secs: number) => void): boolean;
}

export interface PlayerContext {
  readonly player: PlayerHost;
  readonly diagnostics: Diagnostics;
  /** The loaded story and its playback. */
  show: Show | undefined;
  /** Text that replaces the story's file. */
  text: string | undefined;
  /** View of a page that shows the whole figure. */
  view: View | undefined;
  /** True if the story was played or sought since it was opened. */
  started: boolean;
  /** The player is in the window, or near it. */
  onScreen: boolean;
  /** Announces a change to screen readers. */
  say(text: string): void;
  /** Sends an event to the mind, if one is connected. */
  notify(event: MindEvent): void;
  /** Synchronises the content shown instead of a picture with the story. */
  follow(): void;
  /** Handles a rendered frame of a time, or a change of canvas, voice or size. */
  drawn(secs?: number): void;
  /** Renders the picture and the caption at the current audio time. */
  advance(): void;
  /** The questions of the story. */
  readonly questioner: StoryQuestions;
  /** Returns true if the picture is in a picture-in-picture window, or in a captured stream. */
  isWatchedElsewhere(): boolean;
  /** Starts and stops the loops that draw, as the state of the player needs them. */
  keepTime(): void;
}

/** Dispatches an event of the player's own. */
export function fire<K extends keyof PlayerEventMap>(player: PlayerHost, type: K, detail: PlayerEventMap[K]['detail']): void {
  player.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
}

/** Returns the language of a player's controls: its own, or that of the surrounding page. */
export const controlLanguage = (player: PlayerHost): string => player.lang || languageAround(player);

/** Returns the texts of a player's controls. */
export const wordsFor = (player: PlayerHost): ControlWords => controlWords(controlLanguage(player));

/** Returns the language of the page around a player, a BCP 47 tag; the user's if the page does not specify one. */
export function languageAround(player: PlayerHost): string {
  return player.closest<HTMLElement>('[lang]')?.lang || navigator.language;
}

/** Returns the language for speech and text without their own. */
export function languageOf(player: PlayerHost, story: Story): string {
  return player.lang || story.performer.language || languageAround(player);
}

/** Returns the origins to which requests for a player's files include credentials. */
export function credentialsOf({ crossOrigin }: PlayerHost): Credentials {
  return crossOrigin === 'use-credentials' ? 'include' : 'same-origin';
}

/** Returns the location of a player's asset library. */
export function libraryOf({ assets }: PlayerHost): URL {
  return new URL(assets.endsWith('/') ? assets : `${assets}/`, document.baseURI);
}
