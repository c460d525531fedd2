/** Every figure of the library is sound glTF by the Khronos validator. */

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { validateBytes } from 'gltf-validator';
import { describe, expect, test } from 'vitest';

const folder = join(import.meta.dirname, '../../assets/figures');
/** What a figure may weigh, bytes: some 0.4 MB of it are levels of detail. On its way to a page it is half of that. */
const MOST_BYTES = 3_500_000;
/** Triangles of a figure at most. */
const MOST_TRIANGLES = 150_000;
const MOST_DRAW_CALLS = 20;

describe.each(readdirSync(folder).filter((name) => name.endsWith('.glb')))('%s', (name) => {
  test('is valid and keeps to its budgets', async () => {
    const bytes = readFileSync(join(folder, name));
    const { issues, info } = await validateBytes(new Uint8Array(bytes), { uri: name, maxIssues: 100 });
    const told = issues.messages.map((m) => `${['error', 'warning', 'info', 'hint'][m.severity]} ${m.code} ${m.pointer ?? ''}: ${m.message}`);
    // Information is no fault, but a reader of the log should see it.
    if (told.length > 0) console.info([`${name}:`, ...new Set(told)].join('\n  '));
    // Tangents are found at load: in the file they would take 100 KB.
    const faults = told.filter((line) => /^(error|warning)/.test(line) && !line.includes('MESH_PRIMITIVE_GENERATED_TANGENT_SPACE'));
    expect(faults).toEqual([]);
    expect(issues.truncated).toBe(false);
    expect(bytes.length).toBeLessThanOrEqual(MOST_BYTES);
    expect(info.totalTriangleCount).toBeLessThanOrEqual(MOST_TRIANGLES);
    // One draw call for each primitive.
    expect(info.drawCallCount).toBeLessThanOrEqual(MOST_DRAW_CALLS);
  }, 60_000);
});
