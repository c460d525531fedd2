// Gives a module's imports short names: wasm-bindgen calls each by what it does and a hash,
// once in the wasm file and once in the script, and hashes do not compress. Only Node's own
// modules.

import { readFileSync, writeFileSync } from 'node:fs';
import { number, Reader, SECTION, sections } from './module.mjs';

const KIND_FUNCTION = 0;
const LETTERS = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ';

/** The nth shortest name of letters. */
function short(n) {
  const rest = Math.floor(n / LETTERS.length);
  return (rest > 0 ? short(rest - 1) : '') + LETTERS[n % LETTERS.length];
}

function named(name) {
  return Buffer.concat([number(name.length), Buffer.from(name)]);
}

/** Renames the imports of the module in `file` and the functions of `script` that they are. */
export function shortenImports(file, script) {
  const bytes = readFileSync(file);
  const { start, end, begin } = sections(bytes).get(SECTION.import);
  const reader = new Reader(bytes, start);
  const count = reader.number();
  const entries = [number(count)];
  const renamed = new Map();
  for (let i = 0; i < count; i++) {
    const from = reader.name();
    const name = reader.name();
    if (reader.byte() !== KIND_FUNCTION) throw new Error('only functions are expected among the imports');
    if (!renamed.has(name)) renamed.set(name, short(renamed.size));
    entries.push(named(from), named(renamed.get(name)), Buffer.from([KIND_FUNCTION]), number(reader.number()));
  }
  let text = readFileSync(script, 'utf8');
  for (const [name, replacement] of renamed) {
    const definition = `\n            ${name}: function(`;
    if (text.split(definition).length !== 2) throw new Error(`${script} does not define ${name} once`);
    text = text.replace(definition, `\n            ${replacement}: function(`);
  }
  const content = Buffer.concat(entries);
  writeFileSync(file, Buffer.concat([
    bytes.subarray(0, begin), Buffer.from([SECTION.import]), number(content.length), content, bytes.subarray(end),
  ]));
  writeFileSync(script, text);
}
