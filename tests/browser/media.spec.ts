/** Tests that compare the element with a media element of the browser: both receive the same calls. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { isLong } from '../../web/test/tier.js';
import { story, voiceFiles } from './fixture.js';
import { ask, openKit, type Kit, type Question, type Tag } from './media-kit.js';
import { expect, test, type Stage } from './stage.js';

/** Questions to both elements; the answers must be the same. */
const QUESTIONS: { [name: string]: (kit: Kit) => unknown } = {
  'before there is anything': ({ media }) => [
    media.paused,
    media.ended,
    media.readyState,
    media.networkState,
    media.currentTime,
    Number.isNaN(media.duration),
    media.error,
    media.playbackRate,
    media.volume,
    media.muted,
  ],
  constants: ({ media }) =>
    ['NETWORK_EMPTY', 'NETWORK_IDLE', 'NETWORK_LOADING', 'NETWORK_NO_SOURCE', 'HAVE_NOTHING', 'HAVE_METADATA', 'HAVE_CURRENT_DATA', 'HAVE_FUTURE_DATA', 'HAVE_ENOUGH_DATA'].map(
      (name) => [(media as unknown as Record<string, number>)[name], (media.constructor as unknown as Record<string, number>)[name]],
    ),
  'speeds that cannot be': ({ media, thrown, fast }) =>
    [fast, -fast, NaN, Infinity, 'quick' as unknown as number, undefined as unknown as number].map((rate) => [thrown(() => (media.playbackRate = rate)), media.playbackRate]),
  'speeds that can': ({ media, thrown }) => [0.5, 1.25, 2, '1.5' as unknown as number].map((rate) => [thrown(() => (media.playbackRate = rate)), media.playbackRate]),
  'a speed is kept when another is refused': ({ media, thrown, fast }) => {
    media.playbackRate = 1.5;
    return [thrown(() => (media.playbackRate = fast)), media.playbackRate, thrown(() => (media.playbackRate = NaN)), media.playbackRate];
  },
  'a speed is told': async ({ media, event }) => {
    const told = event('ratechange');
    media.playbackRate = 1.5;
    return (await told) !== undefined;
  },
  loudness: ({ media, thrown }) => [0.5, 2, -1, NaN, Infinity, 'loud' as unknown as number, 0, 1].map((volume) => [thrown(() => (media.volume = volume)), media.volume]),
  'loading tells what is known, in order': async ({ media, good, event, events }) => {
    const there = event('canplaythrough');
    media.src = good;
    const before = [media.readyState, media.paused];
    await there;
    const told = [events(), media.readyState];
    // A busy browser may still fetch when it could play through.
    for (let i = 0; i < 50 && media.networkState === media.NETWORK_LOADING; i++) {
      await new Promise((done) => setTimeout(done, 100));
    }
    return [before, ...told, media.networkState, media.paused, media.currentTime];
  },
  'nothing is known before it is there': async ({ media, good, event }) => {
    const seen: number[] = [];
    const there = event('loadedmetadata');
    media.addEventListener('loadstart', () => seen.push(media.readyState, media.networkState));
    media.src = good;
    await there;
    return [seen, media.readyState >= 1];
  },
  'play() before there is anything is kept': async ({ media, good, settle }) => {
    media.src = good;
    const played = media.play();
    const at = [media.paused, media.readyState];
    return [at, await settle(played), media.paused, media.readyState >= 3];
  },
  'play() and pause() before there is anything': async ({ media, good, settle, event }) => {
    media.src = good;
    const played = media.play();
    media.pause();
    const at = media.paused;
    const there = event('canplay');
    const became = await settle(played);
    await there;
    await new Promise((done) => setTimeout(done, 300));
    return [at, became, media.paused, media.currentTime];
  },
  'play() and pause() once it is there': async ({ media, good, settle, event, events }) => {
    const there = event('canplaythrough');
    media.src = good;
    await there;
    await media.play();
    const rests = event('pause');
    media.pause();
    await rests;
    events();
    // Playback starts immediately, so the promise resolves.
    const first = media.play();
    media.pause();
    const became = await settle(first);
    const second = await settle(media.play());
    media.pause();
    // Events fire a little later.
    await new Promise((done) => setTimeout(done, 100));
    return [became, second, media.paused, events()];
  },
  'play() many times is kept many times': async ({ media, good, settle }) => {
    media.src = good;
    const both = await Promise.all([settle(media.play()), settle(media.play())]);
    return [...both, await settle(media.play()), media.paused];
  },
  'play() and load()': async ({ media, good, settle, events }) => {
    media.src = good;
    const played = settle(media.play());
    media.load();
    return [await played, media.paused, media.currentTime, events().includes('emptied')];
  },
  'another source while it plays': async ({ media, good, other, settle, event, events }) => {
    media.src = good;
    await media.play();
    events();
    const there = event('canplay');
    const gone = event('emptied');
    media.src = other;
    await gone;
    const at = media.paused;
    await there;
    return [at, events().slice(0, 3), media.paused, media.currentTime, await settle(media.play())];
  },
  'what is not there': async ({ media, absent, settle, event }) => {
    const failed = event('error');
    media.src = absent;
    const became = await settle(media.play());
    await failed;
    return [became, media.error !== null, media.networkState, media.readyState, await settle(media.play())];
  },
  'load() after an error': async ({ media, absent, good, settle, event }) => {
    const failed = event('error');
    media.src = absent;
    media.load();
    await failed;
    const again = event('error');
    media.load();
    const between = media.error;
    await again;
    media.src = good;
    return [between, await settle(media.play()), media.error, media.paused];
  },
  'pausing keeps the place, and events come in their order': async ({ media, good, event, events }) => {
    const there = event('canplaythrough');
    media.src = good;
    await there;
    events();
    await media.play();
    while (media.currentTime === 0) await new Promise((done) => setTimeout(done, 50));
    const told = event('pause');
    media.pause();
    await told;
    const at = media.currentTime;
    await new Promise((done) => setTimeout(done, 200));
    return [media.currentTime === at, at > 0, events()];
  },
  'seeking is told, and the place is there at once': async ({ media, good, event, events }) => {
    const there = event('canplaythrough');
    media.src = good;
    await there;
    events();
    const sought = event('seeked');
    media.currentTime = 0.5;
    const at = media.currentTime;
    await sought;
    return [at, events()];
  },
  'it ends, and plays again from the start': async ({ media, good, event, events }) => {
    const there = event('canplaythrough');
    media.src = good;
    await there;
    media.currentTime = media.duration - 0.1;
    await media.play();
    events();
    const over = event('ended');
    await over;
    const at = [media.paused, media.ended, media.currentTime === media.duration];
    const told = events();
    await media.play();
    return [at, told, media.paused, media.ended, media.currentTime < 0.5];
  },
};

test.describe('as a media element', () => {
  const names = Object.keys(QUESTIONS);
  // Rendering takes longer than the rest of the test, so the gate tests only every fourth case with
  // a rendered frame.
  const seen = names.filter((_, i) => isLong || i % 4 === 0);
  for (const { name, hasPicture } of [...names.map((name) => ({ name, hasPicture: false })), ...seen.map((name) => ({ name, hasPicture: true }))]) {
    test(hasPicture ? `${name}, with a picture` : name, async ({ stage }) => {
      await openKit(stage, { [name]: QUESTIONS[name] as Question }, { hasPicture });
      const asked = (tag: Tag) => ask(stage.page, tag, { name, backend: stage.backend });
      const expected = await asked('audio');
      expect(await asked('raconteur-player')).toEqual(expected);
    });
  }
});

/** Opens a small story with a voice, audible and not visible. */
async function play(stage: Stage): Promise<void> {
  await stage.page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
  const made = [{ text: 'One two three', msec: 20_000, samples: new Float32Array(882_000) }];
  await stage.open('<raconteur-player src="story.eml" quality="lowest"></raconteur-player>', {
    'test.css': 'raconteur-player { width: 48px; height: 48px; aspect-ratio: auto }',
    'story.eml': story("<voice-text time='0'>One two three</voice-text>"),
    ...voiceFiles(made),
  });
  await stage.ready();
}

const state = (stage: Stage) => stage.player.evaluate((p: RaconteurPlayer) => [p.paused, p.readyState] as const);

test('a context that is suspended is waited for', async ({ stage, page }) => {
  await play(stage);
  await stage.play();
  await page.evaluate(() => window.record.contexts[0]?.suspend());
  await expect.poll(() => state(stage)).toEqual([false, 2]);
  expect((await stage.events()).filter((e) => e === 'playing' || e === 'waiting').at(-1)).toBe('waiting');
  const at = await stage.time();
  await page.evaluate(() => window.record.contexts[0]?.resume());
  await expect.poll(() => state(stage)).toEqual([false, 4]);
  await stage.until(at + 0.2);
});

test('a context that is closed is replaced, at rest and in play', async ({ stage, page }) => {
  await play(stage);
  await stage.play();
  await stage.until(0.3);
  const at = await stage.time();
  await page.evaluate(() => window.record.contexts[0]?.close());
  await stage.until(at + 0.3);
  expect(await page.evaluate(() => window.record.contexts.map((c) => c.state))).toEqual(['closed', 'running']);
  // Playback continues at the same position, with audio.
  const starts = await page.evaluate(() => window.record.starts);
  expect(starts.at(-1)?.offset).toBeGreaterThanOrEqual(at - 0.05);
  await stage.pause();
  await page.evaluate(() => window.record.contexts[1]?.close());
  const later = await stage.time();
  await stage.play();
  await stage.until(later + 0.2);
  expect(await page.evaluate(() => window.record.contexts.length)).toBe(3);
});

test('a browser that forbids sound rejects play(), and nothing has happened', async ({ stage, page }) => {
  await page.addInitScript(() => {
    // Simulates an audio context before any user activation: suspended, with a resume() that stays
    // pending.
    const own = window.AudioContext;
    window.AudioContext = class extends own {
      override get state(): AudioContextState {
        return 'suspended';
      }
      override resume(): Promise<void> {
        return new Promise(() => undefined);
      }
    };
  });
  await play(stage);
  const name = await stage.player.evaluate((p: RaconteurPlayer) =>
    p.play().then(
      () => 'kept',
      (error: Error) => error.name,
    ),
  );
  expect(name).toBe('NotAllowedError');
  expect(await stage.player.evaluate((p: RaconteurPlayer) => p.paused)).toBe(true);
  expect((await stage.events()).filter((e) => e === 'playing')).toEqual([]);
  // And one that is paused meanwhile is not started later.
  const broken = await stage.player.evaluate((p: RaconteurPlayer) => {
    const played = p.play().then(
      () => 'kept',
      (error: Error) => error.name,
    );
    p.pause();
    return played;
  });
  expect(broken).toBe('AbortError');
});

test('an attribute that is no speed or loudness counts as none', async ({ stage }) => {
  await stage.open('<raconteur-player playback-rate="9" volume="-3"></raconteur-player>');
  const read = () => stage.player.evaluate((p: RaconteurPlayer) => [p.playbackRate, p.volume] as const);
  await expect.poll(read).toEqual([1, 1]);
  await stage.player.evaluate((p) => {
    p.setAttribute('playback-rate', '1.5');
    p.setAttribute('volume', '0.25');
  });
  expect(await read()).toEqual([1.5, 0.25]);
  await stage.player.evaluate((p: RaconteurPlayer) => (p.playbackRate = 2));
  await expect(stage.player).toHaveAttribute('playback-rate', '1.5');
  await stage.player.evaluate((p) => {
    p.setAttribute('playback-rate', 'quick');
    p.removeAttribute('volume');
  });
  expect(await read()).toEqual([1, 1]);
});
