/** The events of the element, and what their listeners are given. */

import type { Answered, Score } from './answers.js';
import type { Cue } from './performance.js';
import type { Question } from './questions.js';
import type { Diagnostic, MindState, Word } from './types.js';

/** Those of a media element (HTML, 4.8.11.16), which do not bubble. */
export interface MediaEventMap {
  /** A story is looked for. */
  loadstart: Event;
  /** Something of it has come; at most three times a second. */
  progress: Event;
  /** Nothing has come for three seconds, and it is waited for. */
  stalled: Event;
  /** Nothing more is fetched: all has come, or the story waits to be played. */
  suspend: Event;
  /** The story was let go before all of it had come. */
  abort: Event;
  /** There is no story any more. */
  emptied: Event;
  /** The story cannot be played; the player's `error` tells why. */
  error: Event;
  /** `duration` is another. */
  durationchange: Event;
  /** The picture has another size. */
  resize: Event;
  /** The story is on stage, and its duration known. */
  loadedmetadata: Event;
  /** Its first picture can be drawn. */
  loadeddata: Event;
  /** It can be played. */
  canplay: Event;
  /** It can be played to its end. */
  canplaythrough: Event;
  /** It is to be played. */
  play: Event;
  /** It plays, for the first time or again. */
  playing: Event;
  /** It is to be played, and waits for what has not come yet. */
  waiting: Event;
  /** It was paused. */
  pause: Event;
  /** Another time was set. */
  seeking: Event;
  /** The picture of that time is there. */
  seeked: Event;
  /** Time has passed; about four times a second, and after a seek. */
  timeupdate: Event;
  /** It has come to its end. */
  ended: Event;
  /** `playbackRate` or `defaultPlaybackRate` is another. */
  ratechange: Event;
  /** `volume` or `muted` is another. */
  volumechange: Event;
  /** The picture is in a window of its own. */
  enterpictureinpicture: Event;
  /** It is back. */
  leavepictureinpicture: Event;
}

/** Those of a storyteller, which bubble and leave shadow trees. */
export interface PlayerEventMap {
  /** A word begins to be said. */
  word: CustomEvent<{ word: Word; utterance: number; index: number }>;
  /** A phone begins to be said. */
  phone: CustomEvent<Extract<Cue, { kind: 'phone' }>>;
  /** An utterance begins or ends. */
  utterance: CustomEvent<Extract<Cue, { kind: 'utterance' }>>;
  /** A clause of the story begins or ends. */
  clause: CustomEvent<Extract<Cue, { kind: 'clause' }>>;
  /** The story says something to the page (`r:event`). */
  storyevent: CustomEvent<Extract<Cue, { kind: 'storyevent' }>>;
  /** The story rests and asks something. */
  question: CustomEvent<Question>;
  /** The story goes on elsewhere by itself: over what a learner has not chosen, or to another part. `seeking` and `seeked` follow. */
  leap: CustomEvent<{ fromSecs: number; toSecs: number }>;
  /** Somebody has answered. */
  answer: CustomEvent<Answered>;
  /** A question was answered for good: points so far, and the most that there are. */
  score: CustomEvent<Score>;
  /** Something is wrong with story, voice or figure; the rest is played. */
  diagnostic: CustomEvent<Diagnostic>;
  /** The mind at `mind` came or went. */
  mindchange: CustomEvent<{ state: MindState }>;
  /** How much of what speaks here is fetched, 0 to 1. */
  voiceprogress: CustomEvent<{ share: number }>;
  /** Something in the page begins to speak a text: its name, and what it is in a sentence. */
  voicechange: CustomEvent<{ name: string; about: string; license: string }>;
  /** Another figure took the stage. */
  figurechange: CustomEvent<{ figure: string }>;
}

/** All of them, and those of every element. */
export type ElementEventMap = Omit<HTMLElementEventMap, keyof MediaEventMap | keyof PlayerEventMap> & MediaEventMap & PlayerEventMap;

/** A listener for one of them. */
export type Listener<Element, K extends keyof ElementEventMap> = (this: Element, event: ElementEventMap[K]) => unknown;
