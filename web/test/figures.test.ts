/** Tests that every figure of the library is valid glTF by the Khronos validator, compressed and unpacked by meshoptimizer's own decoder. */

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { validateBytes } from 'gltf-validator';
import { describe, expect, test } from 'vitest';
import { unpacked } from './unpacked.js';

const folder = join(import.meta.dirname, '../../assets/figures');
/** Maximum size of a figure, bytes: about 0.4 MB of it are skin textures and 0.1 MB levels of detail. */
const MAX_BYTES = 2_400_000;
/** Triangles of a figure at most. */
const MAX_TRIANGLES = 150_000;
const MAX_DRAW_CALLS = 20;

/** Returns the validator's findings and statistics. */
async function judge(name: string, bytes: Uint8Array) {
  const { issues, info } = await validateBytes(bytes, { uri: name, maxIssues: 100 });
  const told = issues.messages.map((m) => `${['error', 'warning', 'info', 'hint'][m.severity]} ${m.code} ${m.pointer ?? ''}: ${m.message}`);
  // Information is no fault, but a reader of the log should see it.
  if (told.length > 0) console.info([`${name}:`, ...new Set(told)].join('\n  '));
  // Tangents are computed at load: in the file they would take 100 KB.
  const faults = told.filter((line) => /^(error|warning)/.test(line) && !line.includes('MESH_PRIMITIVE_GENERATED_TANGENT_SPACE'));
  expect(issues.truncated).toBe(false);
  return { faults, info };
}

describe.each(readdirSync(folder).filter((name) => name.endsWith('.glb')))('%s', (name) => {
  test('is valid and keeps to its budgets', async () => {
    const bytes = readFileSync(join(folder, name));
    // The validator does not know the extension, so it sees only the outer structure of the file.
    expect((await judge(name, new Uint8Array(bytes))).faults).toEqual([]);
    const { faults, info } = await judge(`${name}, unpacked`, await unpacked(bytes));
    expect(faults).toEqual([]);
    expect(bytes.length).toBeLessThanOrEqual(MAX_BYTES);
    expect(info.totalTriangleCount).toBeLessThanOrEqual(MAX_TRIANGLES);
    // One draw call for each primitive.
    expect(info.drawCallCount).toBeLessThanOrEqual(MAX_DRAW_CALLS);
  }, 60_000);
});
