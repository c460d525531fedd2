/**
 * The audio clock and the story's: the sound is recorded where it leaves Web Audio, and found
 * again in the story's recordings.
 */

import type { RaconteurPlayer } from '../../web/element/element.js';
import type { PlayerEventMap } from '../../web/element/base/events.js';
import { stretch } from '../../web/element/sound/stretch.js';
import { isLong, sized } from '../../web/test/tier.js';
import { find, loudness } from './sought.js';
import { bundle, expect, test } from './stage.js';
import { captured, decoded, tapInto } from './tap.js';

/** Number of seeks; together with the playback after each they take a minute, of which the gate plays a part. */
const SEEKS = sized(6, 20);
const PLAYED_MS = 3000;
/** Maximum deviation of the engine from the audio, on the audio clock, seconds. */
const MAX_SECS = 0.01;
/** Length of the audio piece to search, seconds; about two phones. */
const PIECE_SECS = 0.16;
/** Range of the search for a piece around its time in the story; over ten times the bound. */
const SEARCH_SECS = 0.3;
/** Time from a seek to audio entirely from the new position: lead and fade, seconds. */
const SETTLED_SECS = 0.06;
/** Minimum correlation of matching pieces, which are the same audio except for the last bits of mixing; a position one period away correlates less. */
const LIKENESS = 0.999;

declare global {
  interface Window {
    /** Times that the engine evaluated: on the audio clock, less its latency. */
    asked: number[];
    /** Phones of its events, with the time evaluated before. */
    phones: { clock: number; utterance: number; startSecs: number; endSecs: number; symbol: string }[];
    /** Times at which the audio changed its position or rate. */
    turns: { type: string; clock: number; rate: number }[];
    /** Story time at times of the audio clock. */
    positions: { clock: number; position: number }[];
    /** Story time of the face in a frame, at times of the audio clock. */
    pictures: { clock: number; position: number }[];
  }
}

/** Runs before the page's own scripts. */
function listen(): void {
  window.asked = [];
  window.phones = [];
  window.positions = [];
  window.pictures = [];
  window.turns = [];
  // A busy machine may run other work between two readings of the clock, so the test records the
  // engine's own reading.
  const last = { currentTime: NaN, outputLatency: NaN };
  // Listeners evaluate too: the first evaluation of a frame counts.
  let task = 0;
  const begins =
    <A extends unknown[]>(work: (...args: A) => void) =>
    (...args: A) => {
      task = window.asked.length;
      work(...args);
    };
  const [frame, interval] = [window.requestAnimationFrame, window.setInterval];
  window.requestAnimationFrame = (work) => frame.call(window, begins(work));
  window.setInterval = ((work: () => void, ms: number) => interval.call(window, begins(work), ms)) as typeof window.setInterval;
  // The context of these tests is made of the browser's own.
  const own = Object.getPrototypeOf(AudioContext.prototype) as AudioContext;
  for (const [prototype, name] of [
    [BaseAudioContext.prototype, 'currentTime'],
    [own, 'outputLatency'],
  ] as const) {
    const { get } = Object.getOwnPropertyDescriptor(prototype, name) ?? {};
    Object.defineProperty(prototype, name, {
      configurable: true,
      get(this: AudioContext) {
        return (last[name] = get?.call(this) as number);
      },
    });
  }
  const stamp = AudioContext.prototype.getOutputTimestamp;
  AudioContext.prototype.getOutputTimestamp = function () {
    window.asked.push(last.currentTime - last.outputLatency);
    return stamp.call(this);
  };
  for (const type of ['seeking', 'ratechange', 'waiting', 'playing']) {
    document.addEventListener(
      type,
      () => window.turns.push({ type, clock: window.tap.context?.currentTime ?? 0, rate: document.querySelector('raconteur-player')?.playbackRate ?? 1 }),
      true,
    );
  }
  // The engine evaluates and renders the frame of a time: lips, tissue and all.
  const { instantiate } = WebAssembly;
  WebAssembly.instantiate = (async (source: WebAssembly.Module, imports?: WebAssembly.Imports) => {
    const made = (await instantiate.call(WebAssembly, source, imports)) as unknown as WebAssembly.Instance;
    const tick = made.exports['player_tick'] as ((player: number, secs: number) => unknown) | undefined;
    if (tick === undefined) return made;
    const noted = (player: number, secs: number): unknown => {
      window.pictures.push({ clock: window.asked[task] ?? NaN, position: secs });
      return tick(player, secs);
    };
    return Object.create(WebAssembly.Instance.prototype, { exports: { value: { ...made.exports, player_tick: noted } } }) as WebAssembly.Instance;
  }) as typeof WebAssembly.instantiate;
  document.addEventListener('phone', (event) => {
    const { timeSecs, endSecs, utterance, symbol } = (event as PlayerEventMap['phone']).detail;
    window.phones.push({ clock: window.asked[task] ?? NaN, utterance, startSecs: timeSecs, endSecs, symbol });
  });
}

/** Returns a generator of numbers from 0 to 1, the same in each run. */
function random(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 1_103_515_245 + 12_345) % 2 ** 31) / 2 ** 31;
}

test('over many seeks, the phone that the engine thinks is heard is heard', async ({ stage, page }) => {
  test.setTimeout(400_000);
  await tapInto(page);
  await page.addInitScript(listen);
  // The test searches the audible sound for the speech, which music would mask.
  await page.route('**/white-rabbit/story.eml', async (route) => {
    const response = await route.fetch();
    const quiet = (await response.text()).replace("set='fireside'", "set='fireside' music='false'");
    await route.fulfill({ response, body: quiet });
  });
  // A small stage, so that frames rendered in software come often.
  await stage.open('<raconteur-player src="/assets/stories/white-rabbit/story.eml" quality="lowest"></raconteur-player>', {
    'test.css': 'raconteur-player { width: 48px; height: 48px; aspect-ratio: auto }',
  });
  await stage.ready();
  const duration = await stage.player.evaluate((p: RaconteurPlayer) => p.duration);
  await stage.play();
  await page.waitForFunction(() => window.tap.ready);
  await page.evaluate(() => {
    const player = document.querySelector('raconteur-player');
    setInterval(() => {
      const { context } = window.tap;
      if (context === undefined || player === null || player.paused || player.readyState < 4) return;
      const position = player.currentTime;
      window.positions.push({ clock: window.asked.at(-1) ?? NaN, position });
    }, 50);
  });

  // --- a minute of playing ---
  const next = random(6);
  for (let i = 0; i < SEEKS; i++) {
    const rate = [1, 4, 1, 1.5, 0.25, 1, 0.75, 1, 1, 2, 1, 1, 0.5, 1][i % 14] ?? 1;
    const to = next() * (duration - 2 * (PLAYED_MS / 1000) * rate);
    await stage.player.evaluate(
      (p: RaconteurPlayer, [secs, speed]) => {
        p.currentTime = secs;
        p.playbackRate = speed;
      },
      [to, rate] as const,
    );
    await page.waitForTimeout(PLAYED_MS);
  }
  await stage.pause();
  await page.waitForTimeout(300);

  // --- audible sound ---
  const heard = await captured(page);
  expect(heard.samples.length / heard.sampleRate).toBeGreaterThan((SEEKS * PLAYED_MS) / 1000);
  const { phones, positions, pictures, turns } = await page.evaluate(() => ({
    phones: window.phones,
    positions: window.positions,
    pictures: window.pictures,
    turns: window.turns,
  }));
  expect(turns.filter((t) => t.type === 'seeking')).toHaveLength(SEEKS);
  const utterances = bundle('white-rabbit');
  const starts = await page.evaluate(() =>
    window.record.events.filter((e) => e.type === 'utterance').map((e) => e.detail as { utterance: number; startSecs: number; phase: string }),
  );
  const startOf = new Map(starts.map((s) => [s.utterance, s.startSecs]));
  const sounds = new Map<string, Float32Array>();
  const soundOf = async (index: number, rate: number): Promise<Float32Array> => {
    const file = utterances[index]?.audio[0]?.file ?? '';
    const whole =
      sounds.get(file) ??
      decoded(
        await page.evaluate(
          async ([url, sampleRate]) => {
            const bytes = await (await fetch(url)).arrayBuffer();
            const sound = await new OfflineAudioContext(1, 1, sampleRate).decodeAudioData(bytes);
            return window.coded(sound.getChannelData(0));
          },
          [`/assets/stories/white-rabbit/voice/${file}`, heard.sampleRate] as const,
        ),
      );
    sounds.set(file, whole);
    const key = `${file} ${rate}`;
    const sound = sounds.get(key) ?? (rate === 1 ? whole : stretch(whole, heard.sampleRate, rate));
    sounds.set(key, sound);
    return sound;
  };
  /** Returns the position in an utterance that left Web Audio at a time of the clock; undefined in pauses and near seeks. */
  const truth = async (clock: number, utterance: number, guess: number): Promise<{ at: number; rate: number } | undefined> => {
    const run = turns.findLast((t) => t.clock < clock);
    const first = Math.round(clock * heard.sampleRate) - heard.first;
    const half = Math.round((PIECE_SECS / 2) * heard.sampleRate);
    const following = turns.find((t) => t.clock >= clock);
    if (run === undefined || clock - PIECE_SECS / 2 < run.clock + SETTLED_SECS || (following?.clock ?? Infinity) < clock + PIECE_SECS / 2 + SETTLED_SECS) return undefined;
    const piece = heard.samples.subarray(first - half, first + half);
    if (piece.length < 2 * half || loudness(piece) < 0.01) return undefined;
    const sound = await soundOf(utterance, run.rate);
    const middle = (guess / run.rate) * heard.sampleRate - half;
    const search = SEARCH_SECS * heard.sampleRate;
    const found = find(piece, sound, Math.round(middle - search), Math.round(middle + search));
    return found.likeness < LIKENESS ? undefined : { at: ((found.at + half) / heard.sampleRate) * run.rate, rate: run.rate };
  };

  // --- last phone before each time that the engine evaluated ---
  const told = phones.filter((p, i) => phones[i + 1]?.clock !== p.clock);
  const amiss: number[] = [];
  for (const { clock, utterance, startSecs, endSecs } of told) {
    const start = startOf.get(utterance);
    if (start === undefined) continue;
    const there = await truth(clock, utterance, startSecs - start);
    if (there !== undefined) amiss.push(Math.max(0, startSecs - start - there.at, there.at - (endSecs - start)) / there.rate);
  }
  // --- and the story's time itself, as pages read it ---
  const off = async (readings: readonly { clock: number; position: number }[]) => {
    const drifts: { clock: number; secs: number }[] = [];
    for (const { clock, position } of readings) {
      const utterance = [...startOf].filter(([, start]) => start <= position).sort((a, b) => b[1] - a[1])[0];
      if (utterance === undefined) continue;
      const there = await truth(clock, utterance[0], position - utterance[1]);
      if (there !== undefined) drifts.push({ clock, secs: (position - utterance[1] - there.at) / there.rate });
    }
    return drifts;
  };
  const drifts = await off(positions);
  // --- time that a frame shows: face and lips, compared with the audio at the time of drawing ---
  const every = Math.max(1, Math.floor(pictures.length / 400));
  const shown = await off(pictures.filter((_, i) => i % every === 0));
  const sorted = (numbers: readonly number[]) => [...numbers].sort((a, b) => a - b);
  const median = (numbers: readonly number[]) => sorted(numbers)[numbers.length >> 1] ?? NaN;
  const third = Math.floor(drifts.length / 3);
  const drift = median(drifts.slice(-third).map((d) => d.secs)) - median(drifts.slice(0, third).map((d) => d.secs));
  const sizes = (all: readonly { secs: number }[]) => sorted(all.map((d) => Math.abs(d.secs)));
  const [read, drawn] = [sizes(drifts), sizes(shown)];
  const ms = (secs: number | undefined) => ((secs ?? NaN) * 1000).toFixed(2);
  console.log(
    `${amiss.length} of ${told.length} phones found, worst ${ms(Math.max(...amiss))} ms beyond the phone; ` +
      `${drifts.length} of ${positions.length} times found: median ${ms(median(drifts.map((d) => d.secs)))} ms, 95 % ${ms(read[Math.floor(read.length * 0.95)])} ms, worst ${ms(read.at(-1))} ms, drift ${ms(drift)} ms; ` +
      `${drawn.length} of ${pictures.length} pictures: lips 95 % ${ms(drawn[Math.floor(drawn.length * 0.95)])} ms, worst ${ms(drawn.at(-1))} ms`,
  );
  expect(amiss.length).toBeGreaterThan(5 * SEEKS);
  expect(Math.max(...amiss)).toBeLessThan(MAX_SECS);
  expect(drifts.length).toBeGreaterThan(15 * SEEKS);
  expect(read.at(-1)).toBeLessThan(MAX_SECS);
  expect(drawn.length).toBeGreaterThan(5 * SEEKS);
  expect(drawn.at(-1)).toBeLessThan(MAX_SECS);
  // Of some seconds the medians of a few readings differ by more than a drift would make.
  if (isLong) expect(Math.abs(drift)).toBeLessThan(0.001);
});
