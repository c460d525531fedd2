import { afterEach, describe, expect, it, vi } from 'vitest';
import { Animations, addressOf } from '../element/engine/animations.js';
import type { Engine } from '../element/base/engine.js';

const library = new URL('https://example.org/assets/');
const story = new URL('https://example.org/stories/rabbit/story.eml');
const address = (name: string) => addressOf(name, library, story)?.href;

describe('addresses of animations', () => {
  it('takes bare names from the library', () => {
    expect(address('step-march')).toBe('https://example.org/assets/animations/step-march.json');
  });
  it('takes paths from the folder of the story', () => {
    expect(address('moves/jump.json')).toBe('https://example.org/stories/rabbit/moves/jump.json');
    expect(address('dance.glb#Jump')).toBe('https://example.org/stories/rabbit/dance.glb#Jump');
  });
  it('does not leave the folder', () => {
    expect(address('../other/x.json')).toBeUndefined();
    expect(address('/x.json')).toBeUndefined();
    expect(address('https://elsewhere.example/x.json')).toBeUndefined();
    expect(address('//elsewhere.example/x.json')).toBeUndefined();
  });
});

/** Returns an engine that requests animations until it has them. */
function engine(...names: string[]) {
  const wanted = new Set(names);
  const given = new Map<string, string>();
  const made = {
    wantedAnimations: () => [...wanted],
    provideAnimations: (_eml: string, all: string[], texts: string[]) => {
      all.forEach((name, i) => {
        wanted.delete(name);
        given.set(name, texts[i] ?? '');
      });
      return {};
    },
  };
  return { engine: made as unknown as Engine, given };
}

/** Files of the fake server, by name; promises control the time of arrival. */
const server = new Map<string, Response | Promise<Response>>();
const requests: string[] = [];
vi.stubGlobal('fetch', (url: URL, { signal }: RequestInit) => {
  const file = url.pathname.split('/').at(-1) ?? '';
  requests.push(file);
  const silent = new Promise<never>((_, reject) => signal?.addEventListener('abort', () => reject(signal.reason as Error)));
  return Promise.race([server.get(file) ?? new Response('', { status: 404 }), silent]);
});

const never = new Promise<Response>(() => undefined);

describe('fetching animations', () => {
  afterEach(() => {
    server.clear();
    requests.length = 0;
    vi.useRealTimers();
  });

  it('tries again with the next story what has failed', async () => {
    const first = engine('lost');
    const here = new Animations(library, story, new AbortController().signal);
    await here.fetch(first.engine);
    here.provide(first.engine, '');
    // The engine reports it, and the same story does not request it again.
    expect([...first.given]).toEqual([['lost', '']]);
    expect(here.fetch(engine('lost').engine)).toBeUndefined();
    server.set('lost.json', new Response('{}'));
    const second = engine('lost');
    const next = new Animations(library, story, new AbortController().signal);
    await next.fetch(second.engine);
    next.provide(second.engine, '');
    expect([...second.given]).toEqual([['lost', '{}']]);
  });

  it('goes on without what does not come, and takes it when it does', async () => {
    vi.useFakeTimers();
    let come: (response: Response) => void = () => undefined;
    server.set('slow.json', new Promise((done) => (come = done)));
    server.set('quick.json', new Response('{}'));
    const { engine: told, given } = engine('slow', 'quick');
    const animations = new Animations(library, story, new AbortController().signal);
    const waited = animations.fetch(told);
    await vi.advanceTimersByTimeAsync(5000);
    await waited;
    animations.provide(told, '');
    expect([...given.keys()]).toEqual(['quick']);
    const next = animations.next(told);
    come(new Response('{"late":1}'));
    await next;
    animations.provide(told, '');
    expect(given.get('slow')).toBe('{"late":1}');
    expect(requests).toEqual(['slow.json', 'quick.json']);
  });

  it('waits no longer than the story is wanted, and ends the request', async () => {
    server.set('stuck.json', never);
    const abort = new AbortController();
    const { engine: told } = engine('stuck');
    const animations = new Animations(library, story, abort.signal);
    const waited = animations.fetch(told);
    abort.abort();
    await waited;
    expect(animations.next(told)).toBeUndefined();
  });

  it('counts one of which nothing comes as not found', async () => {
    vi.useFakeTimers();
    server.set('mute.json', never);
    const { engine: told, given } = engine('mute');
    const animations = new Animations(library, story, new AbortController().signal);
    const gone = animations.next(told);
    await vi.advanceTimersByTimeAsync(30_000);
    await gone;
    animations.provide(told, '');
    // As one that was not found.
    expect(given.get('mute')).toBe('');
  });

  it('reads no more than the limit, whatever length is told', async () => {
    let sent = 0;
    const endless = new ReadableStream<Uint8Array>({
      pull(controller) {
        sent += 1e6;
        controller.enqueue(new Uint8Array(1e6));
      },
    });
    server.set('endless.json', new Response(endless, { headers: { 'content-length': '10' } }));
    const { engine: told, given } = engine('endless');
    const animations = new Animations(library, story, new AbortController().signal);
    await animations.next(told);
    animations.provide(told, '');
    expect(given.get('endless')).toBe('');
    expect(sent).toBeLessThan(40e6);
  });
});
