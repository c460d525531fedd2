import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';

const root = join(import.meta.dirname, '../..');
const documents = [...readdirSync(root), ...readdirSync(join(root, 'docs')).map((name) => `docs/${name}`)].filter((name) => name.endsWith('.md') && name !== 'CHANGELOG.md');

/** Expands braces in a path: `a/{b,c}.rs` names two files. */
function expand(path: string): string[] {
  const [, before, inner, after] = /^(.*?)\{(.*?)\}(.*)$/.exec(path) ?? [];
  if (inner === undefined) return [path];
  return inner.split(',').flatMap((one) => expand(`${before}${one.trim()}${after}`));
}

/** Paths of the repository that a document names in code; those with a placeholder or a wildcard name no one file. */
export function pathsIn(text: string): string[] {
  return [...text.matchAll(/`((?:crate|web|tests|assets|docs|fuzz|\.github|\.ci)\/[^`\s]*)`/g)]
    .map(([, path]) => path ?? '')
    .filter((path) => !/[<>*…]|NAME|\bX\b/.test(path))
    .flatMap(expand)
    .map((path) => path.replace(/(#|::|:\d).*$/, ''));
}

test('paths are found in code, with their braces', () => {
  expect(pathsIn('see `crate/a/{b,c}.rs`, `web/d.ts:12`, `tests/<name>.rs`, crate/e and `cargo run`')).toEqual(['crate/a/b.rs', 'crate/a/c.rs', 'web/d.ts']);
});

describe('paths that documents name', () => {
  test.each(documents)('%s', (name) => {
    const gone = pathsIn(readFileSync(join(root, name), 'utf8')).filter((path) => !existsSync(join(root, path)));
    expect(gone).toEqual([]);
  });
});
