// Runs the gate in a new clone without caches, to check that the committed files do not depend on
// this machine. Uses only Node's own modules.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { root, run, start } from './steps.mjs';

/** Clones the committed state into a separate folder, runs the gate there, and removes the folder. */
export async function fresh() {
  const folder = mkdtempSync(join(tmpdir(), 'raconteur-fresh-'));
  const clone = join(folder, 'clone');
  try {
    run('git', ['clone', '--quiet', root, clone], { why: 'Cloning this checkout' });
    const { CARGO_TARGET_DIR: _, TEST_LONG: __, ...env } = process.env;
    await start(process.execPath, ['web/tools/test.mjs'], { cwd: clone, env: { ...env, RACONTEUR_KEPT: join(folder, 'kept'), CARGO_INCREMENTAL: '0' }, why: 'The gate in a new clone' });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
