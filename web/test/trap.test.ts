/** The error of a dead engine names the current operation and the panic message. */

import { afterEach, expect, test, vi } from 'vitest';

const engine = vi.hoisted(() => ({ doing: 0, panic: undefined as string | undefined }));
vi.mock('../element/engine/backend.js', () => ({ doingOf: () => engine.doing, panicOf: () => engine.panic }));
vi.stubGlobal('location', { origin: 'https://example.org' });
const { Doing, trapError } = await import('../element/engine/trap.js');

const files = {
  story: new URL('https://example.org/tales/story.eml'),
  voiceFolder: new URL('https://example.org/tales/voice/'),
  figure: { name: 'sofia', where: '/figures/sofia.glb' },
  animations: { provided: ['sit'] },
} as unknown as Parameters<typeof trapError>[1];
const trap = new WebAssembly.RuntimeError('unreachable');
const told = () => trapError({} as Parameters<typeof trapError>[0], files, trap);

afterEach(() => Object.assign(engine, { doing: 0, panic: undefined }));

test('a panic is told in its own words', () => {
  Object.assign(engine, { doing: Doing.Animation, panic: 'index out of bounds: the len is 0 but the index is 7 (crate/actor/src/x.rs:1:2)' });
  expect(told().message).toBe('The player failed while reading the animation sit: index out of bounds: the len is 0 but the index is 7 (crate/actor/src/x.rs:1:2).');
  expect(told().cause).toBe(trap);
});

test("another trap is told in the browser's words", () => {
  engine.doing = Doing.Story;
  expect(told().message).toBe('The player failed while reading the story /tales/story.eml: unreachable.');
});
