// Writes the metadata of the npm packages: their `package.json`.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { ask, root } from './steps.mjs';

const { version, license, dependencies } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
export { version };

/** Types of the element in templates, and the packages whose they are. */
export const FRAMEWORKS = ['react', 'vue', 'svelte', 'solid', 'jsx'];

/**
 * Returns the source location from git's remote address; undefined if that is not on a server. If they match, npm shows where a package was built
 * (`provenance`).
 */
export function placeOf(remote = '') {
  const [, host, path] = /^(?:https:\/\/(?:[^@/]+@)?|ssh:\/\/git@|git@)([\w.-]+)[:/](.+?)(?:\.git)?\/?$/.exec(remote.trim()) ?? [];
  if (host === undefined) return undefined;
  const page = `https://${host}/${path}`;
  return { repository: { type: 'git', url: `git+${page}.git` }, homepage: `${page}#readme`, bugs: `${page}/issues` };
}

export const place = placeOf(ask('git', ['remote', 'get-url', 'origin']));

/** Licences and notices; npm packs READMEs automatically. */
const LEGAL = ['LICENSE-*', 'COPYING', 'THIRD-PARTY-NOTICES.txt'];

const about = (name, description, { files, ...rest }) => ({
  name: `@raconteur/${name}`,
  version,
  description,
  license,
  type: 'module',
  ...place,
  publishConfig: { access: 'public', provenance: true },
  files: [...files, ...LEGAL],
  ...rest,
});

/** Returns a script of a package with its types, for `exports`. */
const exported = (script, types) => ({ types: `./types/${types}.d.ts`, default: `./dist/${script}.js` });

const playerTypes = 'web/package/player';

export const player = () =>
  about('player', 'A virtual storyteller as a custom element: a text in, a speaking and gesturing human figure out.', {
    files: ['dist', 'types', 'custom-elements.json'],
    keywords: ['custom-element', 'storytelling', 'virtual-human', 'lip-sync', 'webgpu', 'wasm'],
    exports: {
      '.': exported('player', `${playerTypes}/player`),
      './standalone': exported('standalone', `${playerTypes}/standalone`),
      ...Object.fromEntries(FRAMEWORKS.map((name) => [`./${name}`, { types: `./types/${playerTypes}/${name}.d.ts` }])),
      './custom-elements.json': './custom-elements.json',
      './package.json': './package.json',
    },
    // For bundlers that ignore `exports`.
    main: './dist/player.js',
    module: './dist/player.js',
    types: `./types/${playerTypes}/player.d.ts`,
    customElements: './custom-elements.json',
    // Importing it registers the element.
    sideEffects: ['./dist/player.js', './dist/standalone.js'],
    dependencies: { lit: dependencies.lit },
  });

export const library = () =>
  about('library', 'Figures, animations, music and stories for @raconteur/player, and the command that copies what a page uses.', {
    files: ['library', 'command.mjs', 'uses.json'],
    keywords: ['raconteur', 'virtual-human', 'assets'],
    bin: { 'raconteur-library': 'command.mjs' },
    exports: { './library/*': './library/*', './package.json': './package.json' },
    // Files of the player that a page's build omits are copied with the library.
    peerDependencies: { '@raconteur/player': version },
  });

/** A voice: `script` is its module, `types` where that is declared. */
export const voice = ({ name, description, script, types, rest = {} }) =>
  about(name, description, {
    files: ['dist', 'types'],
    keywords: ['raconteur', 'text-to-speech', 'wasm'],
    exports: { '.': exported(script, types), './package.json': './package.json' },
    sideEffects: false,
    ...rest,
  });
