/** Decompresses EXT_meshopt_compression in a figure's file, with the decoder bundled with three.js. */

import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const EXTENSION = 'EXT_meshopt_compression';

interface ByteRange {
  buffer: number;
  byteOffset?: number;
  byteLength: number;
}

interface Stream extends ByteRange {
  byteStride: number;
  count: number;
  mode: string;
  filter?: string;
}

interface Root {
  buffers: object[];
  bufferViews: (ByteRange & { extensions?: Record<string, Stream> })[];
  extensionsUsed: string[];
  extensionsRequired: string[];
}

/** Returns the two chunks of a glTF binary. */
function chunks(glb: Buffer): [Buffer, Buffer] {
  const end = 20 + glb.readUInt32LE(12);
  return [glb.subarray(20, end), glb.subarray(end + 8, end + 8 + glb.readUInt32LE(end))];
}

function padded(bytes: Buffer, fill: string): Buffer {
  return Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, fill)]);
}

function chunk(tag: string, bytes: Buffer): Buffer {
  const head = Buffer.alloc(8);
  head.writeUInt32LE(bytes.length);
  head.write(tag, 4);
  return Buffer.concat([head, bytes]);
}

export async function unpacked(glb: Buffer): Promise<Uint8Array> {
  await MeshoptDecoder.ready;
  const [text, bin] = chunks(glb);
  const root = JSON.parse(text.toString()) as Root;
  const stretch = ({ byteOffset = 0, byteLength }: ByteRange) => bin.subarray(byteOffset, byteOffset + byteLength);
  const parts: Buffer[] = [];
  let length = 0;
  for (const view of root.bufferViews) {
    const stream = view.extensions?.[EXTENSION];
    let bytes = stretch(view);
    if (stream !== undefined) {
      bytes = Buffer.alloc(view.byteLength);
      MeshoptDecoder.decodeGltfBuffer(bytes, stream.count, stream.byteStride, stretch(stream), stream.mode, stream.filter);
      delete view.extensions;
    }
    view.buffer = 0;
    view.byteOffset = length;
    parts.push(padded(bytes, '\0'));
    length += (bytes.length + 3) & ~3;
  }
  root.buffers = [{ byteLength: length }];
  root.extensionsUsed = root.extensionsUsed.filter((name) => name !== EXTENSION);
  root.extensionsRequired = root.extensionsRequired.filter((name) => name !== EXTENSION);
  const body = Buffer.concat([chunk('JSON', padded(Buffer.from(JSON.stringify(root)), ' ')), chunk('BIN\0', Buffer.concat(parts))]);
  const head = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  head.writeUInt32LE(12 + body.length, 8);
  return new Uint8Array(Buffer.concat([head, body]));
}
