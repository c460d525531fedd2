/** Tests of the other outputs of a player's image, audio and captions: streams, frame callbacks, text tracks, devices. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { SAMPLE_RATE, story, voiceFiles } from './fixture.js';
import { expect, test, type Stage } from './stage.js';

const SECS = 6;

/** Opens a story that hums, so silence can be distinguished from audio. */
async function open(stage: Stage): Promise<void> {
  const samples = Float32Array.from({ length: SECS * SAMPLE_RATE }, (_, i) => 0.4 * Math.sin((2 * Math.PI * 220 * i) / SAMPLE_RATE));
  const files = voiceFiles([{ text: 'One two three', msec: SECS * 1000, samples }]);
  await stage.open('<raconteur-player src="story.eml" quality="lowest"></raconteur-player>', { 'story.eml': story("<voice-text time='0'>One two three</voice-text>"), ...files });
  await stage.ready();
}

test('a stream has the picture and the sound', async ({ stage }) => {
  await open(stage);
  const told = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const stream = p.captureStream();
    await p.play();
    const audio = new AudioContext();
    await audio.resume();
    const ear = audio.createAnalyser();
    audio.createMediaStreamSource(stream).connect(ear);
    const video = Object.assign(document.createElement('video'), { srcObject: new MediaStream(stream.getVideoTracks()), muted: true });
    await video.play();
    let loudest = 0;
    for (let i = 0; i < 40 && loudest < 0.2; i++) {
      await new Promise((done) => setTimeout(done, 50));
      const wave = new Float32Array(ear.fftSize);
      ear.getFloatTimeDomainData(wave);
      loudest = Math.max(loudest, ...wave);
    }
    const kinds = stream.getTracks().map(({ kind }) => kind);
    return { kinds: kinds.sort(), loudest, width: video.videoWidth, own: p.videoWidth };
  });
  expect(told.kinds).toEqual(['audio', 'video']);
  expect(told.loudest).toBeGreaterThan(0.2);
  expect(told.width).toBe(told.own);
  expect(told.own).toBeGreaterThan(0);
});

test('frames are told with their times, once for each call', async ({ stage }) => {
  await open(stage);
  const frames = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const called: { secs: number; width: number }[] = [];
    p.cancelVideoFrameCallback(p.requestVideoFrameCallback(() => called.push({ secs: NaN, width: 0 })));
    await p.play();
    for (let i = 0; i < 4; i++) await new Promise<void>((done) => p.requestVideoFrameCallback((_, { mediaTime, width }) => done(void called.push({ secs: mediaTime, width }))));
    return called;
  });
  expect(frames).toHaveLength(4);
  expect(frames.map(({ secs }) => secs)).toEqual(frames.map(({ secs }) => secs).sort((a, b) => a - b));
  expect(frames[3]?.secs).toBeGreaterThan(frames[0]?.secs ?? Infinity);
});

test('captions are a track, and tracks of a page have their cues told', async ({ stage }) => {
  await open(stage);
  const told = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const events: string[] = [];
    const [story] = p.textTracks;
    if (story === undefined) return undefined;
    const before = story.cues;
    story.mode = 'hidden';
    story.oncuechange = () => events.push(`story ${story.activeCues?.length}`);
    const own = p.addTextTrack('metadata', 'Slides');
    const cue = new VTTCue(0.3, 0.6, 'slide');
    cue.onenter = () => events.push('enter');
    cue.onexit = () => events.push('exit');
    cue.pauseOnExit = true;
    own.addCue(cue);
    const paused = new Promise((done) => p.addEventListener('pause', done, { once: true }));
    await p.play();
    await paused;
    const shown = p.captions;
    story.mode = 'showing';
    return {
      before,
      text: (story.cues?.[0] as VTTCue | undefined)?.text,
      events,
      secs: p.currentTime,
      shown: [shown, p.captions],
      tracks: [...p.textTracks].map(({ kind }) => kind),
    };
  });
  expect(told).toMatchObject({ before: null, text: 'One two three', shown: [false, true], tracks: ['captions', 'metadata'] });
  expect(told?.events).toEqual(['story 1', 'enter', 'exit']);
  expect(told?.secs).toBeGreaterThanOrEqual(0.6);
});

test('another device plays, and one that there is not is refused', async ({ stage, page }) => {
  await page.context().grantPermissions(['microphone']);
  await open(stage);
  await stage.play();
  const refused = await stage.player.evaluate((p: RaconteurPlayer) => p.setSinkId('no such device').catch((error: Error) => error.name));
  expect(refused).toBe('NotFoundError');
  const at = await stage.time();
  await stage.until(at + 0.3);
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.sinkId)).toBe('');
});

test('nothing is fetched before a player without preload is to play', async ({ stage, page }) => {
  const asked: string[] = [];
  page.on('request', (request) => asked.push(new URL(request.url()).pathname));
  await stage.open('<raconteur-player src="story.eml" quality="lowest" preload="none" loading="eager"></raconteur-player>', {
    'story.eml': story("<voice-text time='0'>One two three</voice-text>"),
    ...voiceFiles([{ text: 'One two three', msec: 1500 }]),
  });
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  await page.waitForTimeout(500);
  const state = () => stage.player.evaluate((p: RaconteurPlayer) => [p.readyState, p.networkState === p.NETWORK_IDLE, new URL(p.currentSrc).pathname]);
  expect(await state()).toEqual([0, true, '/test/story.eml']);
  expect(asked.filter((path) => /story\.eml|glb|wasm/.test(path))).toEqual([]);
  // It can be played all the same.
  await stage.player.getByRole('button', { name: /play/i }).first().click();
  await stage.until(0.2);
});
