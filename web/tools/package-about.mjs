// What the packages for npm say of themselves: their `package.json`.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './steps.mjs';

const { version, license, dependencies } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
export { version };

/** Types of the element in templates, and the packages whose they are. */
export const FRAMEWORKS = ['react', 'vue', 'svelte', 'solid', 'jsx'];

const about = (name, description, rest) => ({ name: `@raconteur/${name}`, version, description, license, type: 'module', ...rest });

/** A script of a package with its types, for `exports`. */
const exported = (script, types) => ({ types: `./types/${types}.d.ts`, default: `./dist/${script}.js` });

const playerTypes = 'web/package/player';

export const player = () =>
  about('player', 'A virtual storyteller as a custom element: a text in, a speaking and gesturing human figure out.', {
    keywords: ['custom-element', 'storytelling', 'virtual-human', 'lip-sync', 'webgpu', 'wasm'],
    exports: {
      '.': exported('player', `${playerTypes}/player`),
      './standalone': exported('standalone', `${playerTypes}/standalone`),
      ...Object.fromEntries(FRAMEWORKS.map((name) => [`./${name}`, { types: `./types/${playerTypes}/${name}.d.ts` }])),
      './custom-elements.json': './custom-elements.json',
      './package.json': './package.json',
    },
    // For bundlers that do not look at `exports`.
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
    bin: { 'raconteur-library': './command.mjs' },
    exports: { './library/*': './library/*', './package.json': './package.json' },
    // What a page's build leaves behind of the player is copied with the library.
    peerDependencies: { '@raconteur/player': version },
  });

/** A voice: `script` is its module, `types` where that is declared. */
export const voice = ({ name, description, script, types, rest = {} }) =>
  about(name, description, {
    keywords: ['raconteur', 'text-to-speech', 'wasm'],
    exports: { '.': exported(script, types), './package.json': './package.json' },
    sideEffects: false,
    ...rest,
  });
