/** A mind for the tests: a minimal WebSocket server (RFC 6455) that records received messages. */

import { createHash } from 'node:crypto';
import { createServer } from 'node:http';
import type { AddressInfo, Socket } from 'node:net';

/** A message from a player to a mind. */
export type MindMessage = { kind: string; [field: string]: unknown };

/** A server for one player at a time; it sends to the most recent connection. */
export class Mind {
  readonly #server = createServer();
  #socket: Socket | undefined;
  /** Number of connections. */
  connections = 0;
  /** All messages, in order. */
  readonly told: MindMessage[] = [];

  private constructor() {
    this.#server.on('upgrade', (request, socket: Socket) => {
      const key = `${request.headers['sec-websocket-key']}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`;
      const accept = createHash('sha1').update(key).digest('base64');
      socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${accept}\r\n\r\n`);
      this.connections += 1;
      this.#socket = socket;
      let waiting: Buffer = Buffer.alloc(0);
      socket.on('error', () => undefined);
      socket.on('data', (data) => {
        waiting = this.#hear(socket, Buffer.concat([waiting, data]));
      });
    });
  }

  static async listen(): Promise<Mind> {
    const mind = new Mind();
    await new Promise<void>((done) => mind.#server.listen(0, '127.0.0.1', done));
    return mind;
  }

  get origin(): string {
    return `ws://127.0.0.1:${(this.#server.address() as AddressInfo).port}`;
  }

  /** Sends text messages. */
  send(...messages: string[]): void {
    this.#socket?.write(Buffer.concat(messages.map((message) => frame(1, Buffer.from(message)))));
  }

  /** Sends any bytes as one binary message. */
  sendBytes(bytes: Buffer): void {
    this.#socket?.write(frame(2, bytes));
  }

  /** Drops the connection like a network failure. */
  drop(): void {
    this.#socket?.destroy();
    this.#socket = undefined;
  }

  close(): void {
    this.drop();
    this.#server.close();
  }

  /** Reads whole frames of a client, which are masked; returns the remainder. */
  #hear(socket: Socket, data: Buffer): Buffer {
    for (;;) {
      if (data.length < 2) return data;
      const short = (data[1] ?? 0) & 127;
      const head = short === 127 ? 10 : short === 126 ? 4 : 2;
      if (data.length < head + 4) return data;
      const length = short === 127 ? Number(data.readBigUInt64BE(2)) : short === 126 ? data.readUInt16BE(2) : short;
      const end = head + 4 + length;
      if (data.length < end) return data;
      const mask = data.subarray(head, head + 4);
      const text = Buffer.from(data.subarray(head + 4, end).map((byte, i) => byte ^ (mask[i % 4] ?? 0)));
      const opcode = (data[0] ?? 0) & 15;
      if (opcode === 1) this.told.push(JSON.parse(text.toString()) as MindMessage);
      if (opcode === 8) socket.end(frame(8, text));
      data = data.subarray(end);
    }
  }
}

/** Encodes a complete server message as one frame. */
function frame(opcode: number, payload: Buffer): Buffer {
  const head = Buffer.alloc(payload.length > 65_535 ? 10 : payload.length > 125 ? 4 : 2);
  head[0] = 128 | opcode;
  if (head.length === 2) head[1] = payload.length;
  else if (head.length === 4) {
    head[1] = 126;
    head.writeUInt16BE(payload.length, 2);
  } else {
    head[1] = 127;
    head.writeBigUInt64BE(BigInt(payload.length), 2);
  }
  return Buffer.concat([head, payload]);
}
