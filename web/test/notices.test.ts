import { join } from 'node:path';
import { expect, test } from 'vitest';
import { notices } from '../tools/notices.js';

test('the notices name what is built in, with its licence, and nothing that only builds or tests it', { timeout: 60_000 }, () => {
  const text = notices(join(import.meta.dirname, '../..'));
  for (const part of ['wgpu ', 'glam ', 'quick-xml ', 'lit ', '@codemirror/view ', 'wasm-bindgen ']) expect(text).toContain(`\n${part}`);
  for (const other of ['vite ', 'typescript ', 'proptest ', 'criterion ', 'clap ', 'festival']) expect(text).not.toContain(`\n${other}`);
  // A licence that asks for more than a notice is not among them.
  const list = text.slice(0, text.indexOf('Their licences and notices'));
  expect(list).not.toMatch(/\bGPL-|AGPL|see below/);
});
