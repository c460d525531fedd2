// What a page downloads for one player, per back end, against the budget; compressed
// ahead, as for a server of static files.

import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { main, root, Stop } from './steps.mjs';

/** KB of 1,000 bytes, gzip. */
const budgets = { webgpu: 290, webgl: 900 };

/** Node's own deflate gives up 2 % of size for speed, so the usual program is asked where it is there. */
function gzip9(part) {
  const { status, stdout } = spawnSync('gzip', ['-9', '-c'], { input: part, maxBuffer: 1e8 });
  return status === 0 ? stdout : gzipSync(part, { level: 9 });
}

await main(async () => {
  const folder = join(root, 'dist/app');
  if (!existsSync(folder)) throw new Stop('There is no dist/: run "npm run build" first.');
  const files = readdirSync(folder).map((name) => join(folder, name));
  const entry = join(root, 'dist/raconteur-player.js');
  const over = [];
  const measure = (name, paths, budget) => {
    const parts = paths.map((path) => readFileSync(path));
    const sum = (compress) => parts.reduce((total, part) => total + compress(part).length, 0) / 1000;
    const [gzip, brotli] = [sum(gzip9), sum(brotliCompressSync)];
    console.log(`${name}: ${gzip.toFixed(1)} KB gzip, ${brotli.toFixed(1)} KB brotli; budget ${budget} KB gzip`);
    if (gzip > budget) over.push(name);
  };
  const isAvatar = (path) => /\/avatar-/.test(path);
  const isMind = (path) => /\/mind-/.test(path);
  /** Scripts of one page alone; the player has no part in them. */
  const isWorkshop = (path) => /\/gestures-[^/]*\.(js|css)$/.test(path);
  for (const [backend, budget] of Object.entries(budgets)) {
    const other = backend === 'webgpu' ? 'webgl' : 'webgpu';
    // The page's own script and style are not the player's.
    const mine = files.filter((path) => /\.(js|wasm)$/.test(path) && !path.includes(`${other}-`) && !/\/(index|docs)-/.test(path) && !isAvatar(path) && !isMind(path) && !isWorkshop(path));
    measure(backend, [entry, ...mine], budget);
  }
  // Fetched only by a page that meets an avatar made elsewhere.
  measure('avatar', files.filter(isAvatar), 250);
  // Fetched only by a player that has a mind.
  measure('mind', files.filter(isMind), 4);
  // The workshop for gestures, most of it the editor; besides the player, which is shared.
  measure('gestures', files.filter(isWorkshop), 170);
  if (over.length > 0) throw new Stop(`The ${over.join(' and ')} build is over its budget.`);
});
