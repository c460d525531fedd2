/** The guide to embedding shows the examples as they are. */

import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { read, shown, written } from '../tools/embedding.mjs';

describe('the guide', () => {
  it('shows the examples as they are: `node web/tools/embedding.mjs` writes them anew', () => {
    expect(written(read())).toBe(read());
  });

  it('shows every example', () => {
    const places = [...read().matchAll(/<!-- example (.+?) -->/g)].flatMap(([, paths]) => paths!.split(' '));
    const applications = readdirSync(new URL('../../examples/', import.meta.url), { withFileTypes: true }).filter((entry) => entry.isDirectory() && entry.name !== 'mary-speech');
    for (const { name } of applications)
      expect(
        places.some((path) => path.startsWith(`${name}/`)),
        name,
      ).toBe(true);
  });

  it('shows the pieces of a file that are marked, and whole files without marks', () => {
    expect(shown('a\n// [guide\n  b\n// guide]\nc\n  {/* [guide 2 */}\n      d\n        e\n  {/* guide] */}\n')).toEqual(['  b', '  d', '    e']);
    expect(shown('a\n\nb\n')).toEqual(['a', '', 'b']);
    expect(() => shown('// [guide\na\n')).toThrow('has no end');
  });
});
