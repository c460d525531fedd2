/** The builds that a page downloads pose the figure exactly as the native program does. */

import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const root = join(import.meta.dirname, '../..');
const target = process.env['CARGO_TARGET_DIR'] ?? join(root, 'target');
/** Twenty moments through the story; not round, so that they fall within movements. */
const times = Array.from({ length: 20 }, (_, i) => 0.137 + i * 7.391);

/** As much of the JavaScript side as is used here. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<WebAssembly.ModuleImports>;
  faceJoined(): void;
  moreJoined(): void;
  poseDigests(eml: string, bundle: Uint8Array | undefined, figure: string, glb: Uint8Array, names: string[], texts: string[], times: Float64Array): string[];
}

const file = (story: string, path: string) => join(root, 'assets/stories', story, path);

function native(story: string): string[] {
  const output = execFileSync(
    join(target, 'debug/raconteur'),
    ['pose', file(story, 'story.eml'), '--at', times.join(','), '--digest', '--format', 'json'],
    { cwd: root, encoding: 'utf8' },
  );
  return (JSON.parse(output) as { digest: string }[]).map((pose) => pose.digest);
}

/** `joined`: with the file of what only some stories need. */
async function browser(backend: string, story: string, joined: boolean): Promise<string[]> {
  const folder = join(root, 'web/pkg', backend);
  const { default: instantiate } = (await import(join(folder, 'raconteur.js'))) as { default: () => unknown };
  const instance = instantiate() as Instance;
  const exports = await instance({ module_or_path: await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm'))) });
  await WebAssembly.instantiate(readFileSync(join(folder, 'raconteur_face.wasm')), { '.': exports });
  instance.faceJoined();
  if (joined) {
    await WebAssembly.instantiate(readFileSync(join(folder, 'raconteur_more.wasm')), { '.': exports });
    instance.moreJoined();
  }
  const voice = file(story, 'voice/speech.json');
  const eml = readFileSync(file(story, 'story.eml'), 'utf8');
  // Hand shapes are in the build.
  const names = [...new Set([...eml.matchAll(/animationSetName='([\w-]+)'/g)].map((m) => String(m[1])))].filter((name) => !name.startsWith('hand-shape-'));
  return instance.poseDigests(
    eml,
    existsSync(voice) ? readFileSync(voice) : undefined,
    'sofia',
    readFileSync(join(root, 'assets/figures/sofia.glb')),
    joined ? names : [],
    names.map((name) => readFileSync(join(root, 'assets/animations', `${name}.json`), 'utf8')),
    Float64Array.from(times),
  );
}

test.each([['white-rabbit', false], ['step-lesson', true], ['mathematical-dance', true]])('poses of %s at twenty times are equal to the bit natively and in both builds', async (story, joined) => {
  const expected = native(story);
  expect(expected).toHaveLength(times.length);
  expect(new Set(expected).size).toBe(times.length);
  expect(await browser('webgpu', story, joined)).toEqual(expected);
  expect(await browser('webgl', story, joined)).toEqual(expected);
}, 60_000);

test('a story that asks for what has not joined is told without it', async () => {
  const poses = await browser('webgpu', 'mathematical-dance', false);
  expect(new Set(poses).size).toBe(times.length);
  expect(poses).not.toEqual(native('mathematical-dance'));
}, 60_000);
