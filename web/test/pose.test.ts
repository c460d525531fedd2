/** The shipped builds pose the figure exactly like the native program. */

import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { kind } from './tier.js';

const root = join(import.meta.dirname, '../..');
const target = process.env['CARGO_TARGET_DIR'] ?? join(root, 'target');
/** Twenty times in the story; not round, so that they fall within movements. */
const times = Array.from({ length: 20 }, (_, i) => 0.137 + i * 7.391);

/** Part of the JavaScript interface that these tests use. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  poseDigests(eml: string, bundle: Uint8Array | undefined, glb: Uint8Array, names: string[], texts: string[], times: Float64Array): string[];
}

const file = (story: string, path: string) => join(root, 'assets/stories', story, path);

function native(story: string): string[] {
  const output = execFileSync(join(target, 'debug/raconteur'), ['pose', file(story, 'story.eml'), '--at', times.join(','), '--digest', '--format', 'json'], {
    cwd: root,
    encoding: 'utf8',
  });
  return (JSON.parse(output) as { digest: string }[]).map((pose) => pose.digest);
}

async function browser(backend: string, story: string): Promise<string[]> {
  const folder = join(root, kind.folder, backend);
  const { default: instantiate } = (await import(join(folder, 'raconteur.js'))) as { default: () => unknown };
  const instance = instantiate() as Instance;
  await instance({ module_or_path: await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm'))) });
  const voice = file(story, 'voice/speech.json');
  const eml = readFileSync(file(story, 'story.eml'), 'utf8');
  // Hand shapes are in the build.
  const names = [...new Set([...eml.matchAll(/animationSetName='([\w-]+)'/g)].map((m) => String(m[1])))].filter((name) => !name.startsWith('hand-shape-'));
  return instance.poseDigests(
    eml,
    existsSync(voice) ? readFileSync(voice) : undefined,
    readFileSync(join(root, 'assets/figures/sofia.glb')),
    names,
    names.map((name) => readFileSync(join(root, 'assets/animations', `${name}.json`), 'utf8')),
    Float64Array.from(times),
  );
}

test.each(['white-rabbit', 'step-lesson', 'mathematical-dance'])(
  'poses of %s at twenty times are equal to the bit natively and in both builds',
  async (story) => {
    const expected = native(story);
    expect(expected).toHaveLength(times.length);
    expect(new Set(expected).size).toBe(times.length);
    expect(await browser('webgpu', story)).toEqual(expected);
    expect(await browser('webgl', story)).toEqual(expected);
  },
  60_000,
);
