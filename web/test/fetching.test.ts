import { createServer, type Server, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { fetchBytes, fetchModule, fetchText, spare, type Fetching } from '../element/base/fetching.js';

/** Answers by path; some never end. */
const ANSWERS: { [path: string]: (response: ServerResponse) => unknown } = {
  '/good': (response) => response.end('all of it'),
  '/silent': () => undefined,
  '/stalled': (response) => response.writeHead(200, { 'content-length': '100' }).write('some'),
  '/slow': (response) => {
    // Longer than the patience in all, but never silent for so long.
    let left = 8;
    const drip = setInterval(() => {
      response.write('x');
      left -= 1;
      if (left > 0) return;
      clearInterval(drip);
      response.end();
    }, 60);
  },
  '/endless': (response) => {
    // The response has no length.
    const more = setInterval(() => response.write('x'.repeat(1000)), 1);
    response.on('close', () => {
      clearInterval(more);
      endless.ended = true;
    });
  },
  '/broken': (response) => response.writeHead(500).end(),
  '/wasm': (response) => response.writeHead(200, { 'content-type': 'application/wasm' }).end(Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0])),
  '/library/player/left.wasm': (response) => response.writeHead(200, { 'content-type': 'application/wasm' }).end(Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0])),
  '/page/page.wasm': (response) => response.writeHead(200, { 'content-type': 'text/html' }).end('<!doctype html>'),
  '/plain-wasm': (response) => response.end(Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0])),
  '/wasm-stalled': (response) => response.writeHead(200, { 'content-type': 'application/wasm' }).write(Buffer.from([0, 0x61])),
};
const endless = { ended: false };

let server: Server;
let at: (path: string) => URL;

beforeAll(async () => {
  server = createServer((request, response) => {
    const answer = ANSWERS[request.url ?? ''];
    if (answer === undefined) response.writeHead(404).end();
    else answer(response);
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  const { port } = server.address() as AddressInfo;
  at = (path) => new URL(path, `http://127.0.0.1:${port}`);
});
afterAll(() => {
  server.closeAllConnections();
  server.close();
});

const fetching = (more: Partial<Fetching> = {}): Fetching => ({ what: 'The thing', most: 10_000, silenceMs: 250, ...more });

test('what is there comes, with its progress', async () => {
  const shares: number[] = [];
  expect(await fetchText(at('/good'), fetching({ progress: (share) => shares.push(share) }))).toBe('all of it');
  expect(shares.at(-1)).toBe(1);
});

test('what is not there, or not given, says so', async () => {
  await expect(fetchBytes(at('/absent'), fetching())).rejects.toThrow(/^The thing was not found at .*\/absent\.$/);
  await expect(fetchBytes(at('/broken'), fetching())).rejects.toThrow(/the server answered 500/);
  await expect(fetchBytes(new URL('http://127.0.0.1:1/'), fetching())).rejects.toThrow(/is the network available/);
});

test('a server that falls silent is given up, before and in the middle of the answer', async () => {
  await expect(fetchBytes(at('/silent'), fetching())).rejects.toThrow(/no data for/);
  await expect(fetchBytes(at('/stalled'), fetching())).rejects.toThrow(/no data for/);
  await expect(fetchModule(at('/wasm-stalled'), fetching())).rejects.toThrow(/no data for/);
});

test('a slow one is not, however long it takes', async () => {
  expect(await fetchText(at('/slow'), fetching())).toBe('xxxxxxxx');
});

test('the limit is counted, whatever length is told', async () => {
  await expect(fetchBytes(at('/endless'), fetching({ most: 5000 }))).rejects.toThrow(/The thing is larger than/);
  await expect.poll(() => endless.ended).toBe(true);
  await expect(fetchBytes(at('/stalled'), fetching({ most: 50 }))).rejects.toThrow(/The thing is larger than/);
});

test('what is not wanted any more ends with the reason of the signal', async () => {
  const abort = new AbortController();
  const coming = fetchBytes(at('/stalled'), fetching({ signal: abort.signal, silenceMs: 60_000 }));
  abort.abort(new Error('another story'));
  await expect(coming).rejects.toThrow('another story');
  await expect(fetchBytes(at('/good'), fetching({ signal: abort.signal }))).rejects.toThrow('another story');
});

test('wasm is compiled as it comes, and where its type is not told', async () => {
  expect(await fetchModule(at('/wasm'), fetching())).toBeInstanceOf(WebAssembly.Module);
  expect(await fetchModule(at('/plain-wasm'), fetching())).toBeInstanceOf(WebAssembly.Module);
  await expect(fetchModule(at('/good'), fetching())).rejects.toBeInstanceOf(WebAssembly.CompileError);
});

test('a module that a page left behind comes from the library', async () => {
  await expect(fetchModule(at('/app/left.wasm'), fetching())).rejects.toThrow(/not found at .*app/);
  spare.library = at('/library/');
  expect(await fetchModule(at('/app/left.wasm'), fetching())).toBeInstanceOf(WebAssembly.Module);
  // A module that neither folder has is reported missing at its expected location.
  await expect(fetchModule(at('/app/none.wasm'), fetching())).rejects.toThrow(/not found at .*app/);
  // The page of an application is no module.
  await expect(fetchModule(at('/page/page.wasm'), fetching())).rejects.toThrow(/not found at .*page/);
  delete spare.library;
});
