import { expect, test } from 'vitest';
import { placeOf } from '../tools/package-about.mjs';

test('packages name the repository that git fetches from, and no place of a machine', () => {
  const page = 'https://code.example/raconteur/raconteur';
  const place = { repository: { type: 'git', url: `git+${page}.git` }, homepage: `${page}#readme`, bugs: `${page}/issues` };
  for (const remote of [
    `${page}.git\n`,
    page,
    'git@code.example:raconteur/raconteur.git',
    'ssh://git@code.example/raconteur/raconteur.git',
    'https://user:secret@code.example/raconteur/raconteur.git',
  ])
    expect(placeOf(remote)).toEqual(place);
  for (const none of [undefined, '', '/srv/raconteur', '../raconteur', 'file:///srv/raconteur.git']) expect(placeOf(none)).toBeUndefined();
});
