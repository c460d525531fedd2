/** Player without rendering and with a manual clock, with the questions of a story; and its user. */

import { setMaxListeners } from 'node:events';
import type { RaconteurPlayer } from '../element/element.js';
import { Lesson } from '../element/lesson/lesson.js';
import type { Answered, Score } from '../element/base/answers.js';
import { Ranges, united, type Span } from '../element/base/ranges.js';
import type { Question } from '../element/base/questions.js';
import type { PlayerState } from '../element/base/types.js';

// Node reports more listeners on one signal as a leak; browsers do not.
setMaxListeners(50);

export class FakePlayer extends EventTarget {
  readyState = 4;
  duration = 60;
  currentTime = 0;
  paused = true;
  readonly lesson = new Lesson();
  questions: readonly Question[] = [];
  #spans: Span[] = [];

  /** Player for functions that require the real type. */
  get real(): RaconteurPlayer {
    return this as unknown as RaconteurPlayer;
  }

  get played(): TimeRanges {
    return new Ranges(this.#spans);
  }

  get ended(): boolean {
    return this.currentTime >= this.duration;
  }

  get optional(): readonly Span[] {
    return this.lesson.optional;
  }

  ask(questions: readonly Question[]): void {
    this.questions = questions;
    this.lesson.setStory(questions, []);
  }

  get score(): Score {
    return this.lesson.score;
  }

  state(): PlayerState {
    return { placeSecs: this.currentTime, ...this.lesson.state() };
  }

  restore({ placeSecs, ...state }: PlayerState): void {
    if (Number.isNaN(placeSecs)) {
      this.lesson.join(state, this.currentTime);
      return;
    }
    this.lesson.restore(state);
    this.currentTime = placeSecs;
    this.lesson.seek(placeSecs);
    this.dispatchEvent(new Event('seeked'));
  }

  play(): Promise<void> {
    return Promise.resolve();
  }

  /** Answers the question at a time. */
  answer(secs: number, given: readonly string[]): Answered | undefined {
    this.currentTime = secs;
    this.lesson.pass(secs);
    this.dispatchEvent(new Event('question'));
    const taken = this.lesson.answer(given);
    if (taken === undefined) return undefined;
    this.dispatchEvent(Object.assign(new Event('answer'), { detail: taken.answered }));
    return taken.answered;
  }

  pass(secs: number): void {
    const from = this.ended ? 0 : this.currentTime;
    this.currentTime = Math.min(this.duration, from + secs);
    this.#spans = united([...this.#spans, [from, this.currentTime]]);
    this.dispatchEvent(new Event('timeupdate'));
    if (this.ended) this.dispatchEvent(new Event('ended'));
  }

  seek(secs: number): void {
    this.currentTime = secs;
    this.dispatchEvent(new Event('seeked'));
  }
}
