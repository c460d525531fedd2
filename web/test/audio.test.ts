import { afterEach, expect, test, vi } from 'vitest';
import { RecordedVoice } from '../element/sound/audio.js';
import { LiveScript } from '../element/engine/live.js';
import { latency } from '../element/sound/outlet.js';
import type { Utterance } from '../element/base/types.js';

afterEach(() => {
  vi.unstubAllGlobals();
});

test('the output is as late as the browser says, as far as an output can be', () => {
  expect(latency({ outputLatency: 0.25, baseLatency: 0.01 })).toBe(0.25);
  expect(latency({ outputLatency: 3.978, baseLatency: 0.01 })).toBe(0.01);
  expect(latency({ outputLatency: 0, baseLatency: 0.01 })).toBe(0.01);
});

test('browsers that know neither figure are taken as immediate', () => {
  const unknown = undefined as unknown as number;
  expect(latency({ outputLatency: unknown, baseLatency: unknown })).toBe(0);
});

/** Recorded calls of a sound: start, fades and stop. */
interface Sound {
  start?: number;
  stop?: number;
  fades: { at: number; constant: number }[];
}

/** Creates a fake browser with a stopped clock, in which every sound takes 3 s; returns the scheduled sounds. */
function browser(): Sound[] {
  const sounds: Sound[] = [];
  class FakeContext {
    readonly state = 'running';
    readonly currentTime = 100;
    readonly sampleRate = 1000;
    readonly destination = {};
    decodeAudioData = () => Promise.resolve({ duration: 3 });
    createGain() {
      const sound: Sound = { fades: [] };
      // The first gain is the one of all sounds.
      sounds.push(sound);
      const gain = {
        value: 1,
        setValueAtTime: () => undefined,
        linearRampToValueAtTime: () => undefined,
        cancelScheduledValues: () => undefined,
        setTargetAtTime: (_: number, at: number, constant: number) => sound.fades.push({ at, constant }),
      };
      return { context: this, gain, sound, connect: () => undefined, disconnect: () => undefined };
    }
    createBufferSource() {
      let sound: Sound | undefined;
      return {
        playbackRate: {},
        connect: (to: { sound: Sound }) => void (sound = to.sound),
        start: (at: number) => sound && (sound.start = at),
        stop: (at: number) => sound && (sound.stop = at),
      };
    }
  }
  vi.stubGlobal('AudioContext', FakeContext);
  vi.stubGlobal('document', { createElement: () => ({ canPlayType: () => 'probably' }) });
  return sounds;
}

test('what is interrupted fades out within 60 ms, what has not begun is not heard, and so again when it is sought', async () => {
  const sounds = browser();
  const heard = () => sounds.filter(({ start }) => start !== undefined);
  const audio = [{ file: 'a.wav', mime: 'audio/wav' }];
  const say = (startSecs: number): Utterance => ({ startSecs, durationSecs: 3, audio, words: [], estimated: false });
  const script = new LiveScript([say(0)]);
  script.add({ events: [], utterances: [say(3), say(6)], questions: [], firstUtterance: 1, endSecs: 9 }, 0);
  const voice = new RecordedVoice(script, { folder: new URL('https://a.example/voice/'), credentials: 'same-origin', device: '' }, () => undefined);
  voice.give(new Map([['a.wav', new Uint8Array(1)]]));
  voice.start(1, 1, 100);
  await vi.waitFor(() => expect(heard()).toHaveLength(3));
  voice.cut(script.cut(4.5), 4.5);
  const [story, cut, dropped] = heard();
  expect(story?.fades).toEqual([]);
  expect(cut?.fades).toHaveLength(1);
  const [{ at, constant } = { at: 0, constant: 1 }] = cut?.fades ?? [];
  expect(at).toBeCloseTo(103.5);
  // The remainder after 60 ms is not audible as a click.
  expect(Math.exp(-0.06 / constant)).toBeLessThan(0.01);
  expect(cut?.stop).toBeGreaterThan(at + 0.06);
  expect(dropped?.stop).toBeLessThan(dropped?.start ?? 0);
  // Nothing is scheduled twice, and seeking back plays the same audio.
  voice.prepare(4.5);
  expect(heard()).toHaveLength(3);
  voice.start(3.2, 1, 100);
  await vi.waitFor(() => expect(heard()).toHaveLength(4));
  expect(heard()[3]?.fades[0]?.at).toBeCloseTo(101.3);
});
