/** The builds that a page downloads pose the figure exactly as the native program does. */

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const root = join(import.meta.dirname, '../..');
const target = process.env['CARGO_TARGET_DIR'] ?? join(root, 'target');
/** Twenty moments through the story; not round, so that they fall within movements. */
const times = Array.from({ length: 20 }, (_, i) => 0.137 + i * 7.391);

/** As much of the JavaScript side as is used here. */
interface Instance {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  poseDigests(eml: string, bundle: Uint8Array, figure: string, glb: Uint8Array, times: Float64Array): string[];
}

const story = (path: string) => join(root, 'assets/stories/white-rabbit', path);

function native(): string[] {
  const output = execFileSync(
    join(target, 'debug/raconteur'),
    ['pose', story('story.eml'), '--at', times.join(','), '--digest', '--format', 'json'],
    { cwd: root, encoding: 'utf8' },
  );
  return (JSON.parse(output) as { digest: string }[]).map((pose) => pose.digest);
}

async function browser(backend: string): Promise<string[]> {
  const folder = join(root, 'web/pkg', backend);
  const { default: instantiate } = (await import(join(folder, 'raconteur.js'))) as { default: () => unknown };
  const instance = instantiate() as Instance;
  await instance({ module_or_path: await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm'))) });
  return instance.poseDigests(
    readFileSync(story('story.eml'), 'utf8'),
    readFileSync(story('voice/speech.json')),
    'sofia',
    readFileSync(join(root, 'assets/figures/sofia.glb')),
    Float64Array.from(times),
  );
}

test('poses at twenty times are equal to the bit natively and in both builds', async () => {
  const expected = native();
  expect(expected).toHaveLength(times.length);
  expect(new Set(expected).size).toBe(times.length);
  expect(await browser('webgpu')).toEqual(expected);
  expect(await browser('webgl')).toEqual(expected);
}, 60_000);
