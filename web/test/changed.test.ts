import { expect, test } from 'vitest';
import { affected, sources } from '../tools/changed.mjs';

const crates = new Map([
  ['base', { folder: 'crate/base/', uses: ['glam'] }],
  ['body', { folder: 'crate/body/', uses: ['base'] }],
  ['player', { folder: 'crate/player/', uses: ['body', 'base'] }],
  ['sculpt', { folder: 'crate/sculpt/', uses: ['body'] }],
  ['web', { folder: 'crate/web/', uses: ['player'] }],
]);

test('a change reaches the crates that stand on the changed one, and no others', () => {
  expect(affected(['crate/sculpt/src/hair/mod.rs'], crates)).toEqual(['sculpt']);
  expect(affected(['crate/body/src/pose.rs'], crates)).toEqual(['body', 'player', 'sculpt', 'web']);
  expect(affected(['README.md', 'crate/bodyguard/x.rs'], crates)).toEqual([]);
});

test('a build is made of a crate and of what it stands on, and no others', () => {
  expect(sources('web', crates)).toEqual(['crate/base/', 'crate/body/', 'crate/player/', 'crate/web/']);
  expect(sources('base', crates)).toEqual(['crate/base/']);
});
