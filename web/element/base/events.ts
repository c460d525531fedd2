/** The events of the element, and what their listeners are given. */

import type { Answered, Score } from './answers.js';
import type { Cue } from './performance.js';
import type { Question } from './questions.js';
import type { Diagnostic, MindState, Word } from './types.js';

/** Events of a media element (HTML, 4.8.11.16). They do not bubble. */
export interface MediaEventMap {
  /** Fires when the player starts to load a story. */
  loadstart: Event;
  /** Fires when more data has arrived, at most three times per second. */
  progress: Event;
  /** Fires when no data has arrived for three seconds while the player still expects some. */
  stalled: Event;
  /** Fires when fetching stops: everything has arrived, or the story waits to be played. */
  suspend: Event;
  /** Fires when the story is discarded before it has fully loaded. */
  abort: Event;
  /** Fires when the player no longer has a story. */
  emptied: Event;
  /** Fires when the story cannot be played; the player's `error` gives the reason. */
  error: Event;
  /** Fires when `duration` changes. */
  durationchange: Event;
  /** Fires when the size of the rendered image changes. */
  resize: Event;
  /** Fires when the story is on stage and its duration is known. */
  loadedmetadata: Event;
  /** Fires when the first frame can be rendered. */
  loadeddata: Event;
  /** Fires when the story can be played. */
  canplay: Event;
  /** Fires when the story can be played to its end. */
  canplaythrough: Event;
  /** Fires when playback is requested. */
  play: Event;
  /** Fires when playback starts or resumes. */
  playing: Event;
  /** Fires when playback stops because data is missing. */
  waiting: Event;
  /** Fires when the story is paused. */
  pause: Event;
  /** Fires when a seek starts. */
  seeking: Event;
  /** Fires when the frame at the new time is rendered. */
  seeked: Event;
  /** Fires as time passes, about four times per second, and after a seek. */
  timeupdate: Event;
  /** Fires when the story reaches its end. */
  ended: Event;
  /** Fires when `playbackRate` or `defaultPlaybackRate` changes. */
  ratechange: Event;
  /** Fires when `volume` or `muted` changes. */
  volumechange: Event;
  /** Fires when the image enters a picture-in-picture window. */
  enterpictureinpicture: Event;
  /** Fires when the image leaves the picture-in-picture window. */
  leavepictureinpicture: Event;
}

/** Events of a storyteller. They bubble and cross shadow boundaries. */
export interface PlayerEventMap {
  /** Fires when a spoken word starts. */
  word: CustomEvent<{ word: Word; utterance: number; index: number }>;
  /** Fires when a spoken phone starts. */
  phone: CustomEvent<Extract<Cue, { kind: 'phone' }>>;
  /** Fires when an utterance starts or ends. */
  utterance: CustomEvent<Extract<Cue, { kind: 'utterance' }>>;
  /** Fires when a clause of the story starts or ends. */
  clause: CustomEvent<Extract<Cue, { kind: 'clause' }>>;
  /** Fires when the story sends an event to the page (`r:event`). */
  storyevent: CustomEvent<Extract<Cue, { kind: 'storyevent' }>>;
  /** Fires when the story halts and asks a question. */
  question: CustomEvent<Question>;
  /**
   * Fires when the story jumps automatically: over parts that a learner has not chosen, or to another part. `seeking`
   * and `seeked` follow.
   */
  leap: CustomEvent<{ fromSecs: number; toSecs: number }>;
  /** Fires when a question is answered. */
  answer: CustomEvent<Answered>;
  /** Fires when a question is answered for good; gives the points so far and the maximum. */
  score: CustomEvent<Score>;
  /** Fires when story, voice or figure has a problem; the rest still plays. */
  diagnostic: CustomEvent<Diagnostic>;
  /** Fires when the mind at `mind` connects or disconnects. */
  mindchange: CustomEvent<{ state: MindState }>;
  /** Fires as the page fetches a speech engine; gives the fetched share, 0 to 1. */
  voiceprogress: CustomEvent<{ share: number }>;
  /**
   * Fires when a speech source in the page starts to speak a text; gives its name, and a sentence that describes it.
   */
  voicechange: CustomEvent<{ name: string; about: string; license: string }>;
  /** Fires when another figure takes the stage. */
  figurechange: CustomEvent<{ figure: string }>;
}

/** Event map of the element: all of these events, and those of every element. */
export type ElementEventMap = Omit<HTMLElementEventMap, keyof MediaEventMap | keyof PlayerEventMap> & MediaEventMap & PlayerEventMap;

/** A listener for one of these events. */
export type Listener<Element, K extends keyof ElementEventMap> = (this: Element, event: ElementEventMap[K]) => unknown;
