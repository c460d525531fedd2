// Names the files of the built site that the page of a course needs, for `raconteur export`.

import { basename } from 'node:path';
import type { Plugin } from 'vite';

const ENTRY = 'raconteur-course.js';
/** What speaks in a page, with its workers and engines: some 20 MB that only stories without recordings fetch. */
const SPEECH = /^app\/here-/;

/** Whose work it is: written when the site is built, and goes where its files go. */
const NOTICES = ['LICENSE-APACHE', 'LICENSE-MIT', 'THIRD-PARTY-NOTICES.txt'];

/** A file with all that it names, directly or through others. Files of the build have names of their own, so that a name is enough. */
function reach(texts: ReadonlyMap<string, string>, start: string, without: RegExp): Set<string> {
  const found = new Set([start]);
  for (const file of found) {
    const text = texts.get(file) ?? '';
    for (const other of texts.keys()) if (!without.test(other) && text.includes(basename(other))) found.add(other);
  }
  return found;
}

/** Writes `course.json`: `player`, the script of the page and all that it fetches, and `speech`, what is fetched besides where the page has to speak. */
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
