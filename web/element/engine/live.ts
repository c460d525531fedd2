/** Utterances: the story's, and those of live fragments while they are remembered. */

import type { Performance } from '../base/performance.js';
import type { Utterance } from '../base/types.js';

/** Time for which the engine remembers ended fragments, seconds. */
const KEEP_SECS = 300;

/** Utterances by the index in cues. */
export class LiveScript implements Iterable<Utterance> {
  #story: readonly Utterance[];
  readonly #live = new Map<number, Utterance>();

  constructor(story: readonly Utterance[]) {
    this.#story = story;
  }

  utteranceAt(index: number): Utterance | undefined {
    return this.#story[index] ?? this.#live.get(index);
  }

  *[Symbol.iterator](): Iterator<Utterance> {
    yield* this.#story;
    yield* this.#live.values();
  }

  /** Adds a fragment's utterances and forgets those long over; everything by time. */
  add({ utterances, firstUtterance }: Performance, nowSecs: number): Utterance[] {
    for (const [index, { startSecs, durationSecs }] of this.#live) {
      if (startSecs + durationSecs < nowSecs - KEEP_SECS) this.#live.delete(index);
    }
    utterances.forEach((utterance, i) => this.#live.set(firstUtterance + i, utterance));
    return this.byTime();
  }

  /** Returns all utterances, sorted by time. */
  byTime(): Utterance[] {
    return [...this].sort((a, b) => a.startSecs - b.startSecs);
  }

  /** Ends the speech of fragments. Returns the replacement of each changed utterance: a shorter one, or undefined if it has not begun. */
  cut(atSecs: number): Map<Utterance, Utterance | undefined> {
    const changes = new Map<Utterance, Utterance | undefined>();
    for (const [index, utterance] of this.#live) {
      const { startSecs, durationSecs, words } = utterance;
      if (startSecs + durationSecs <= atSecs) continue;
      if (startSecs >= atSecs) {
        this.#live.delete(index);
        changes.set(utterance, undefined);
        continue;
      }
      const begun = words.filter((word) => word.startSecs < atSecs);
      const shorter = { ...utterance, cut: true, durationSecs: atSecs - startSecs, words: begun.map((word) => ({ ...word, endSecs: Math.min(word.endSecs, atSecs) })) };
      this.#live.set(index, shorter);
      changes.set(utterance, shorter);
    }
    return changes;
  }

  /** Forgets everything but the story. */
  forget(): void {
    this.#live.clear();
  }

  /** Replaces the text; an unchanged utterance keeps its audio. Returns true if any speech has changed. */
  replace(story: readonly Utterance[]): boolean {
    this.forget();
    const before = this.#story;
    const known = new Map(before.map((utterance) => [JSON.stringify(utterance), utterance]));
    this.#story = story.map((utterance) => known.get(JSON.stringify(utterance)) ?? utterance);
    return before.length !== story.length || before.some((utterance, i) => utterance !== this.#story[i]);
  }
}
