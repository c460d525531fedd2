// Names the files of the built site that the page of a course needs, for `raconteur export`.

import { basename } from 'node:path';
import type { Plugin } from 'vite';

const ENTRY = 'raconteur-course.js';
/** Files for speech in a page, with its workers and engines: about 20 MB that only stories without recordings fetch. */
const SPEECH = /^app\/here-/;

/** Licence and notice files: written when the site is built, and copied together with its files. */
const NOTICES = ['LICENSE-APACHE', 'LICENSE-MIT', 'THIRD-PARTY-NOTICES.txt'];

/** Returns a file with all files that it names, directly or indirectly. Build files have unique names, so a name is sufficient. */
function reach(texts: ReadonlyMap<string, string>, start: string, without: RegExp): Set<string> {
  const found = new Set([start]);
  for (const file of found) {
    const text = texts.get(file) ?? '';
    for (const other of texts.keys()) if (!without.test(other) && text.includes(basename(other))) found.add(other);
  }
  return found;
}

/** Writes `course.json`: `player`, the script of the page with all its dependencies, and `speech`, the additional files for pages with speech synthesis. */
export function course(): Plugin {
  return {
    name: 'raconteur-course',
    apply: 'build',
    generateBundle(_, bundle) {
      const texts = new Map(Object.values(bundle).map((part) => [part.fileName, part.type === 'chunk' ? part.code : part.fileName.endsWith('js') ? String(part.source) : '']));
      const player = reach(texts, ENTRY, SPEECH);
      const all = reach(texts, ENTRY, /^$/);
      const list = { player: [...player, ...NOTICES].sort(), speech: [...all].filter((file) => !player.has(file)).sort() };
      this.emitFile({ type: 'asset', fileName: 'course.json', source: JSON.stringify(list, undefined, 2) });
    },
  };
}
