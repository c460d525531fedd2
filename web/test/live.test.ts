import { expect, test } from 'vitest';
import { captionAt, captionsOf } from '../element/captions/captions.js';
import { LiveScript } from '../element/engine/live.js';
import type { Utterance } from '../element/base/types.js';

/** Returns an utterance of half a second per word. */
function say(text: string, startSecs: number): Utterance {
  const words = text.split(' ').map((word, i) => ({ text: word, startSecs: startSecs + i * 0.5, endSecs: startSecs + i * 0.5 + 0.5, emphasized: false }));
  return { startSecs, durationSecs: words.length * 0.5, audio: [], words, estimated: false };
}

const story = say('once upon a time', 0);
const fragments = [say('long over', 2), say('this is being said', 4), say('never', 7)];

function performed(): LiveScript {
  const script = new LiveScript([story]);
  script.add({ events: [], utterances: fragments, questions: [], firstUtterance: 1, endSecs: 10 }, 0);
  return script;
}

test('whenever fragments are interrupted, they say nothing after, and what was said before stays', () => {
  for (let at = 1.5; at < 9; at += 0.3) {
    const script = performed();
    const changes = script.cut(at);
    const live = script.byTime().filter((utterance) => utterance !== story);
    for (const { startSecs, durationSecs, words } of live) {
      expect(startSecs + durationSecs).toBeLessThanOrEqual(Math.max(at, startSecs + 1e-9) + 1e-9);
      for (const word of words) expect(word.endSecs).toBeLessThanOrEqual(at + 1e-9);
    }
    // Each of them is either as it was, or shorter, or gone.
    for (const before of fragments) {
      const after = changes.has(before) ? changes.get(before) : before;
      expect(after === undefined || live.includes(after)).toBe(true);
      expect(after === undefined).toBe(before.startSecs >= at);
      const spoken = before.words.filter((word) => word.startSecs < at).map((word) => word.text);
      expect(after?.words.map((word) => word.text) ?? []).toEqual(spoken);
    }
    expect(script.utteranceAt(0)).toBe(story);
    // Its caption is removed in time.
    const shorter = [...changes.values()].find((utterance) => utterance !== undefined);
    if (shorter !== undefined) expect(captionAt(captionsOf(script.byTime(), 'en'), at + 0.01)).toBeUndefined();
  }
});

test('nothing that is over changes', () => {
  const script = performed();
  expect(script.cut(20).size).toBe(0);
  expect(script.byTime()).toEqual([story, ...fragments]);
});
