import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename, dirname, join, normalize } from 'node:path';
import { expect, it } from 'vitest';

const root = join(import.meta.dirname, '../..');

/** Returns true for shipped files: tests and tools may depend on everything. */
const shipped = (file: string): boolean => !/^web\/(?:test|tools|package)\//.test(file);

/** Folders of TypeScript by the folders that their files import from, for types, too. */
function importsOf(files: readonly string[], read: (file: string) => string): Map<string, Set<string>> {
  const out = new Map<string, Set<string>>();
  for (const file of files) {
    const folder = dirname(file);
    const known = out.get(folder) ?? new Set();
    out.set(folder, known);
    for (const [, address = ''] of read(file).matchAll(/(?:from\s+|import\s*\(?\s*)'(\.{1,2}\/[^'?]+)/g)) {
      const target = dirname(normalize(join(folder, address)));
      if (target !== folder) known.add(target);
    }
  }
  return out;
}

/** Returns the folders in import cycles. */
function circling(imports: ReadonlyMap<string, ReadonlySet<string>>): string[] {
  const reached = (from: string): Set<string> => {
    const seen = new Set<string>();
    const open = [from];
    for (let folder = open.pop(); folder !== undefined; folder = open.pop()) {
      for (const next of imports.get(folder) ?? []) {
        if (seen.has(next)) continue;
        seen.add(next);
        open.push(next);
      }
    }
    return seen;
  };
  return [...imports.keys()].filter((folder) => reached(folder).has(folder)).sort();
}

it('finds a circle of folders', () => {
  const text: Record<string, string> = {
    'a/x.ts': "import type { Y } from '../b/y.js';",
    'b/y.ts': "const z = () => import('../c/z.js');",
    'c/z.ts': "export { x } from '../a/x.js';",
    'd/w.ts': "import { x } from '../a/x.js';",
  };
  expect(circling(importsOf(Object.keys(text), (file) => text[file] ?? ''))).toEqual(['a', 'b', 'c']);
});

function shippedImports(): Map<string, Set<string>> {
  const listed = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', '--deduplicate', 'web/*.ts'], { cwd: root, encoding: 'utf8' });
  const files = listed.split('\n').filter((file) => file !== '' && shipped(file));
  expect(files.length).toBeGreaterThan(200);
  return importsOf(files, (file) => readFileSync(join(root, file), 'utf8'));
}

it('has no circle of folders', () => {
  expect(circling(shippedImports())).toEqual([]);
});

it('has in the README of each room what the room uses', () => {
  const rooms = [...shippedImports()].filter(([folder]) => dirname(folder) === 'web/element');
  expect(rooms.length).toBeGreaterThan(5);
  for (const [room, used] of rooms) {
    const names = [...used].filter((folder) => !folder.startsWith('web/pkg')).map((folder) => basename(folder));
    const said = /^Uses: (.*)\.$/m.exec(readFileSync(join(root, room, 'README.md'), 'utf8'))?.[1];
    expect(
      said
        ?.split(', ')
        .filter((name) => name !== 'nothing')
        .sort(),
      room,
    ).toEqual(names.sort());
  }
});
