// Lists the figures and pieces of music that the library's stories use. The engine reports them, as
// it does in a page.

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { root } from './steps.mjs';

const assets = join(root, 'assets');
/** Default performer; the same as in `web/element/story/cast.ts`. */
const USUAL_FIGURE = 'sofia';

/** Opens the engine of a kind of build, without rendering. */
async function openEngine(kind) {
  const folder = join(root, kind.folder, 'webgl');
  const { default: instantiate } = await import(join(folder, 'raconteur.js'));
  const engine = instantiate();
  await engine({ module_or_path: await WebAssembly.compile(readFileSync(join(folder, 'raconteur_bg.wasm'))) });
  return engine;
}

/** Returns the stories, by the paths of their folders. */
function stories() {
  return readdirSync(join(assets, 'stories'), { recursive: true })
    .filter((path) => path.endsWith('story.eml'))
    .map((path) => dirname(path).replaceAll('\\', '/'))
    .sort();
}

/** Returns the assets used by each story: `figures` by name, `music` by file name without extension. */
export async function uses(kind) {
  const engine = await openEngine(kind);
  const used = {};
  for (const story of stories()) {
    const folder = join(assets, 'stories', story);
    const eml = readFileSync(join(folder, 'story.eml'), 'utf8');
    const voice = join(folder, 'voice/speech.json');
    const figure = engine.performerOf(eml).figure ?? USUAL_FIGURE;
    const player = await engine.Player.create();
    player.load(eml, existsSync(voice) ? readFileSync(voice) : undefined, figure, readFileSync(join(assets, `figures/${figure}.glb`)), 1);
    const pieces = player.music().filter(({ library }) => library);
    used[story] = { figures: [figure], music: [...new Set(pieces.map(({ file }) => file.replace(/\.\w+$/, '')))].sort() };
    player.free();
  }
  return used;
}
