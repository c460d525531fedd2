// A wasm file as a row of sections of numbers and names (WebAssembly core specification,
// chapter 5). Only Node's own modules.

/** The sections' numbers. */
export const SECTION = { custom: 0, import: 2, function: 3, code: 10 };

/** Reads a module's numbers one after the other. */
export class Reader {
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

  /** A name: its length, then its letters. */
  name() {
    const length = this.number();
    this.pass(length);
    return this.bytes.toString('utf8', this.at - length, this.at);
  }
}

/** Seven bits a byte. */
export function number(value) {
  const bytes = [];
  do {
    bytes.push((value & 127) | (value > 127 ? 128 : 0));
    value = Math.floor(value / 128);
  } while (value > 0);
  return Buffer.from(bytes);
}

/** Where each section begins, and where its content starts and ends. */
export function sections(bytes) {
  const found = new Map();
  const reader = new Reader(bytes, 8);
  while (reader.at < bytes.length) {
    const begin = reader.at;
    const id = reader.byte();
    const length = reader.number();
    found.set(id, { begin, start: reader.at, end: reader.at + length });
    reader.pass(length);
  }
  return found;
}
