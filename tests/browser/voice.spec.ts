/** The sound of a story's voice, sample by sample, and the voice where there is no recording. */

import type { Page } from '@playwright/test';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { fileKey, SAMPLE_RATE, story, voiceFiles, type Made } from './fixture.js';
import { find, loudness } from './sought.js';
import { bundle, expect, test, type Stage } from './stage.js';
import { captured, decoded, tapInto, type Captured } from './tap.js';

const LOUD = 0.5;
const HZ = 210;
/** The most by which one sample of the tone differs from the next. */
const MAX_SLOPE = (LOUD * 2 * Math.PI * HZ) / SAMPLE_RATE;

/** Returns a tone with soft start and end, so clicks can only come from playback. */
function tone(secs: number): Float32Array {
  const ramp = 0.05 * SAMPLE_RATE;
  const length = Math.round(secs * SAMPLE_RATE);
  return Float32Array.from({ length }, (_, i) => {
    const soft = Math.min(1, i / ramp, (length - i) / ramp);
    return soft * LOUD * Math.sin((2 * Math.PI * HZ * i) / SAMPLE_RATE);
  });
}

/** Opens an invisible story: without rendering, the page is never too busy to record. */
async function open(stage: Stage, body: string, utterances: readonly Made[], attributes = ''): Promise<void> {
  await stage.open(`<raconteur-player src="story.eml" loading="eager" ${attributes}></raconteur-player>`, {
    'story.eml': story(body),
    'test.css': 'raconteur-player { width: 96px; height: 96px; margin-top: 3000px }',
    ...voiceFiles(utterances),
  });
  await stage.ready();
}

/** Returns the recording once the pending blocks have arrived. */
async function heard(page: Page): Promise<Captured> {
  const until = await page.evaluate(() => (window.tap.context?.currentTime ?? 0) + 0.1);
  await expect
    .poll(() =>
      page.evaluate(() => {
        const last = window.tap.blocks.at(-1);
        return last === undefined ? 0 : (last.from + last.samples.length) / (window.tap.context?.sampleRate ?? 1);
      }),
    )
    .toBeGreaterThan(until);
  return await captured(page);
}

/** Returns the largest step from one sample to the next. */
function steepest(samples: Float32Array): number {
  return samples.reduce((most, x, i) => Math.max(most, Math.abs(x - (samples[i - 1] ?? x)) || 0), 0);
}

test('utterances that follow each other join without a gap or a click, and those that overlap are added', async ({ stage, page }) => {
  await tapInto(page);
  // One tone in three recordings, and another sound that begins during the third. All times are
  // whole numbers of samples; the player rounds other times to samples.
  const whole = tone(1.84);
  const samplesAt = (secs: number) => Math.round(secs * SAMPLE_RATE);
  const part = (from: number, to: number) => whole.slice(samplesAt(from), samplesAt(to));
  // The first clause starts when the recorder has certainly begun, because it opens with the audio
  // itself.
  const body = `<voice-text time='1.4'>One</voice-text><voice-text time='1.91'>Two</voice-text>
    <voice-text time='2.6'>Three</voice-text><voice-text time='2.9'>Over</voice-text>`;
  await open(stage, body, [
    { text: 'One', msec: 510, samples: part(0, 0.51) },
    { text: 'Two', msec: 690, samples: part(0.51, 1.2) },
    { text: 'Three', msec: 640, samples: part(1.2, 1.84) },
    { text: 'Over', msec: 100, samples: new Float32Array(samplesAt(0.1)).fill(0.25) },
  ]);
  // Late decoding makes a gap: here there is time for it.
  await page.evaluate(() => {
    window.decoded = 0;
    const decode = BaseAudioContext.prototype.decodeAudioData;
    BaseAudioContext.prototype.decodeAudioData = async function (...args: [ArrayBuffer]) {
      const sound = await decode.apply(this, args);
      window.decoded += 1;
      return sound;
    };
  });
  await stage.seek(0);
  await page.waitForFunction(() => window.decoded === 4);
  await stage.play();
  await page.waitForFunction(() => document.querySelector('raconteur-player')?.ended);
  const { samples } = await heard(page);
  const expected = whole.slice();
  const over = samplesAt(1.5);
  for (let i = 0; i < samplesAt(0.1); i++) expected[over + i] = (expected[over + i] ?? 0) + 0.25;
  const found = find(expected, samples, 0, samples.length);
  let worst = 0;
  expected.forEach((x, i) => (worst = Math.max(worst, Math.abs(x - (samples[found.at + i] ?? 0)))));
  console.log(`likeness ${found.likeness.toFixed(6)}, worst sample ${worst.toExponential(1)}`);
  // The samples return with 16 bits.
  expect(worst).toBeLessThan(0.001);
});

test('pausing, seeking and changing the speed in the middle of a word do not click, and a seek lands exactly', async ({ stage, page }) => {
  await tapInto(page);
  await open(stage, "<voice-text time='0'>Ah</voice-text>", [{ text: 'Ah', msec: 8000, samples: tone(8) }]);
  await stage.play();
  await stage.until(0.6);
  await stage.pause();
  await stage.seek(2.34567);
  await page.evaluate(() => (window.record.starts = []));
  await stage.play();
  await stage.until(2.8);
  await stage.seek(5.1);
  await page.waitForTimeout(400);
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.playbackRate = 1.5));
  await page.waitForTimeout(400);
  await stage.pause();
  const starts = await page.evaluate(() => window.record.starts);
  expect(Math.abs((starts[0]?.offset ?? 0) - 2.34567)).toBeLessThan(1 / SAMPLE_RATE);
  const { samples } = await heard(page);
  expect(loudness(samples.filter((x) => !Number.isNaN(x)))).toBeGreaterThan(0.05);
  // A fade with a time constant of 2 ms adds its own slope, half the height over 88 samples: 1.38
  // of the tone's. The stretched tone may be out of phase by a little where windows cross.
  console.log(`steepest ${steepest(samples).toFixed(4)}, of the tone ${MAX_SLOPE.toFixed(4)}`);
  expect(steepest(samples)).toBeLessThan(MAX_SLOPE * 1.6);
});

test('what the browser decodes is as long as the bundle says, in each encoding and with the same start', async ({ stage, page }) => {
  await tapInto(page);
  await stage.load('hello-world', '');
  const rate = 48_000;
  for (const { audio, duration_secs } of [...bundle('hello-world'), ...bundle('white-rabbit').slice(0, 4)]) {
    const sounds: Float32Array[] = [];
    for (const { file } of audio) {
      const name = (await stage.page.request.get(`/assets/stories/hello-world/voice/${file}`)).ok() ? 'hello-world' : 'white-rabbit';
      sounds.push(
        decoded(
          await page.evaluate(
            async ([url, sampleRate]) => {
              const bytes = await (await fetch(url)).arrayBuffer();
              return window.coded((await new OfflineAudioContext(1, 1, sampleRate).decodeAudioData(bytes)).getChannelData(0));
            },
            [`/assets/stories/${name}/voice/${file}`, rate] as const,
          ),
        ),
      );
    }
    const [opus, mp3] = sounds;
    if (opus === undefined || mp3 === undefined) throw new Error('a recording has one encoding only');
    const pieces = Array.from({ length: Math.floor(opus.length / 12_000) }, (_, i) => i * 12_000);
    const loudest = pieces.sort((a, b) => loudness(opus.subarray(b, b + 12_000)) - loudness(opus.subarray(a, a + 12_000)))[0] ?? 0;
    const found = find(opus.subarray(loudest, loudest + 12_000), mp3, loudest - 4800, loudest + 4800);
    const delay = (found.at - loudest) / rate;
    console.log(
      `${duration_secs} s: ${sounds.map((s) => ((s.length / rate - duration_secs) * 1000).toFixed(1)).join(' and ')} ms more, the second ${(delay * 1000).toFixed(2)} ms later`,
    );
    // Neither ends before its last phone, and neither plays at another time.
    for (const sound of sounds) expect(sound.length / rate).toBeGreaterThan(duration_secs - 0.005);
    expect(Math.abs(delay)).toBeLessThan(0.002);
  }
});

test('utterances, words and phones are told with their times', async ({ stage, page }) => {
  await open(stage, "<null time='0.3'/><voice-text time='0.3'>One two</voice-text>", [{ text: 'One two', msec: 600 }]);
  await stage.play();
  await page.waitForFunction(() => document.querySelector('raconteur-player')?.ended);
  const told = await page.evaluate(() =>
    window.record.events.filter((e) => ['utterance', 'word', 'phone'].includes(e.type)).map((e) => ({ type: e.type, ...(e.detail as object) })),
  );
  const said = { utterance: 0, text: 'One two', startSecs: 0.3, endSecs: expect.closeTo(0.9, 9), kind: 'utterance', type: 'utterance' };
  const phone = { type: 'phone', kind: 'phone', utterance: 0, symbol: 'aa', phoneSet: 'mrpa' };
  const near = expect.closeTo(0.6, 9);
  expect(told).toEqual([
    { ...said, phase: 'start', timeSecs: 0.3 },
    { type: 'word', utterance: 0, index: 0, word: { text: 'One', startSecs: 0.3, endSecs: near, emphasized: false } },
    { ...phone, timeSecs: 0.3, endSecs: near },
    { type: 'word', utterance: 0, index: 1, word: { text: 'two', startSecs: near, endSecs: expect.closeTo(0.9, 9), emphasized: false } },
    { ...phone, timeSecs: near, endSecs: expect.closeTo(0.9, 9) },
    { ...said, phase: 'end', timeSecs: expect.closeTo(0.9, 9) },
  ]);
});

test('voice-say: what is waited for, what is not, and what is only made ready', async ({ stage, page }) => {
  const body = `<seq time='0'>
    <voice-say time='0' voiceOperation='text'>Aloud</voice-say>
    <voice-say time='0' voiceOperation='asynchronousText'>Beside</voice-say>
    <voice-say time='0' voiceOperation='preprocessText'>Later on</voice-say>
    <voice-say time='0' voiceOperation='preprocessFile'>later.txt</voice-say>
    <voice-say time='0' voiceOperation='file'>tale.txt</voice-say>
    <voice-say time='0' voiceOperation='asynchronousFile' type='sable'>song.sable</voice-say></seq>`;
  await open(
    stage,
    body,
    [
      { text: 'Aloud', msec: 310 },
      { text: 'Beside', msec: 320 },
      { text: 'Later on', msec: 330 },
      { text: 'Not yet', msec: 340, key: fileKey('later.txt') },
      { text: 'A tale told', msec: 350, key: fileKey('tale.txt') },
      { text: 'A song', msec: 360, key: fileKey('song.sable', 'sable') },
    ],
    'captions',
  );
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics)).toEqual([]);
  await stage.play();
  await page.waitForFunction(() => document.querySelector('raconteur-player')?.ended);
  const lengths = () => page.evaluate(() => window.record.starts.map((s) => Math.round(s.secs * 1000)).sort());
  expect(await lengths()).toEqual([310, 320, 350, 360]);
  const words = () =>
    page.evaluate(() =>
      window.record.events
        .filter((e) => e.type === 'word')
        .map((e) => (e.detail as { word: { text: string } }).word.text)
        .sort(),
    );
  expect(await words()).toEqual(['A', 'A', 'Aloud', 'Beside', 'song', 'tale', 'told']);
  const times = await page.evaluate(() =>
    window.record.events
      .filter((e) => e.type === 'utterance')
      .map((e) => e.detail as { text: string; phase: string; startSecs: number })
      .filter((u) => u.phase === 'start')
      .map((u) => [u.text, Math.round(u.startSecs * 1000)] as const),
  );
  expect(Object.fromEntries(times)).toEqual({ Aloud: 0, Beside: 310, 'A tale told': 310, 'A song': 660 });
  // Speech prepared in advance is available when a live clause needs it.
  const answers = await stage.player.evaluate((p: RaconteurPlayer) => p.perform("<voice-text time='0'>Later on</voice-text>"));
  expect(answers.map((a) => a.kind)).toEqual(['accepted']);
  await stage.play();
  await expect.poll(lengths).toContain(330);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics)).toEqual([]);
});

declare global {
  interface Window {
    /** Number of decoded recordings. */
    decoded: number;
    /** The utterances that the browser got, and their events. */
    said: { text: string; voice: string; lang: string; rate: number; volume: number; end: string; secs: number }[];
  }
}

/** Runs before the page's own scripts: simulates a browser with these voices, with a given time per character. */
function speakers({ voices, msec }: { voices: { name: string; lang: string }[]; msec: number }): void {
  window.said = [];
  let under: (() => void) | undefined;
  class Speech extends EventTarget {
    voice: { name: string } | null = null;
    lang = '';
    rate = 1;
    volume = 1;
    onstart?: () => void;
    onend?: () => void;
    onerror?: (event: { error: string }) => void;
    constructor(readonly text: string) {
      super();
    }
  }
  const synthesis = Object.assign(new EventTarget(), {
    getVoices: () => voices.map((v) => ({ ...v, localService: true, default: false })),
    speak: (speech: Speech) => {
      const note = { text: speech.text, voice: speech.voice?.name ?? '', lang: speech.lang, rate: speech.rate, volume: speech.volume, end: '', secs: performance.now() / 1000 };
      window.said.push(note);
      setTimeout(() => speech.onstart?.());
      const timer = setTimeout(
        () => {
          note.end = 'over';
          under = undefined;
          speech.onend?.();
        },
        (speech.text.length * msec) / speech.rate,
      );
      under = () => {
        clearTimeout(timer);
        note.end = 'cancelled';
        under = undefined;
        setTimeout(() => speech.onerror?.({ error: 'interrupted' }));
      };
    },
    cancel: () => under?.(),
  });
  Object.defineProperty(window, 'speechSynthesis', { value: synthesis, configurable: true });
  Object.assign(window, { SpeechSynthesisUtterance: Speech });
}

const TWO = "<voice-text time='0' timeId='v'>Once upon a time there was a rabbit.<tm name='e'/></voice-text><voice-text time='e+0.2s'>It hopped away.</voice-text>";
const missing = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => p.diagnostics.filter((d) => d.code === 'voice-missing').map((d) => d.message));

async function openSilent(stage: Stage, attributes = ''): Promise<void> {
  await stage.open(`<raconteur-player src="story.eml" quality="lowest" loading="eager" captions ${attributes}></raconteur-player>`, {
    'story.eml': story(TWO),
    // Outside the viewport, because a page that renders in software is too busy to measure the
    // browser's speech.
    'test.css': 'raconteur-player { width: 96px; height: 96px; margin-top: 3000px }',
  });
  await stage.ready();
  await expect.poll(() => missing(stage)).toHaveLength(1);
}

test('without a recording the browser speaks, and the story waits where it is late', async ({ stage, page }) => {
  await page.addInitScript(speakers, {
    voices: [
      { name: 'Max', lang: 'de-DE' },
      { name: 'Ann', lang: 'en-GB' },
    ],
    msec: 110,
  });
  await openSilent(stage);
  expect((await missing(stage))[0]).toContain('“Ann” speaks it');
  await stage.play();
  await page.waitForFunction(() => document.querySelector('raconteur-player')?.ended, undefined, { timeout: 60_000 });
  const said = await page.evaluate(() => window.said);
  expect(said.map((s) => [s.text, s.voice, s.end])).toEqual([
    ['Once upon a time there was a rabbit.', 'Ann', 'over'],
    ['It hopped away.', 'Ann', 'over'],
  ]);
  // 3.96 s for 36 characters is more than was guessed.
  expect(await stage.events()).toContain('waiting');
  expect(said[1]?.rate).toBeGreaterThan(1);
  expect((await page.evaluate(() => window.record.events.filter((e) => e.type === 'word'))).length).toBe(11);
});

test("the browser's voice follows pause, seek, speed and mute", async ({ stage, page }) => {
  await page.addInitScript(speakers, {
    voices: [
      { name: 'Rui', lang: 'pt-PT' },
      { name: 'Ann', lang: 'en-GB' },
    ],
    msec: 60,
  });
  await openSilent(stage, 'lang="pt" playback-rate="0.5"');
  expect((await missing(stage))[0]).toContain('“Rui”');
  await stage.play();
  await stage.until(0.3);
  await stage.pause();
  const word = await stage.player.evaluate((p: RaconteurPlayer) => p.currentTime);
  expect(word).toBeLessThan(2);
  expect(await page.evaluate(() => window.said.map((s) => [s.text, s.rate, s.end]))).toEqual([['Once upon a time there was a rabbit.', 0.5, 'cancelled']]);
  await stage.seek(1.2);
  await stage.play();
  await expect.poll(() => page.evaluate(() => window.said.length)).toBe(2);
  // It continues with a word from the middle.
  expect(await page.evaluate(() => window.said[1]?.text)).toMatch(/^(?!Once).* rabbit\.$/);
  await stage.player.evaluate((p: RaconteurPlayer) => void (p.muted = true));
  await expect.poll(() => page.evaluate(() => window.said[1]?.end)).toBe('cancelled');
  await stage.player.evaluate((p: RaconteurPlayer) => Object.assign(p, { muted: false, volume: 0.5 }));
  await expect.poll(() => page.evaluate(() => window.said[2]?.volume)).toBe(0.5);
});

test('with no voice at all, or none of the language, the captions tell the story', async ({ stage, page }) => {
  await page.addInitScript(speakers, { voices: [{ name: 'Max', lang: 'de-DE' }], msec: 60 });
  await openSilent(stage);
  expect((await missing(stage))[0]).toContain('captions show its text');
  await stage.play();
  await page.waitForFunction(() => window.record.events.some((e) => e.type === 'word'));
  expect(await page.evaluate(() => window.said)).toEqual([]);
  // The browser itself: headless Chromium has no voices on a machine without any.
  const bare = await page.context().newPage();
  await bare.goto('/');
  expect(await bare.evaluate(() => typeof speechSynthesis)).toBe('object');
  await bare.close();
});
