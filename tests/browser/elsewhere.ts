/** Another server than the page's: it has the built player under `/player/`, for any page. */

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { kind } from '../../web/test/tier.js';

const TYPES: { [ending: string]: string } = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };

export interface Elsewhere {
  readonly origin: string;
  /** Requested paths. */
  readonly asked: readonly string[];
  close(): void;
}

/** Starts the server; `own` are files next to the player, by path. */
export async function serveElsewhere(own: { readonly [path: string]: string } = {}): Promise<Elsewhere> {
  const dist = join(import.meta.dirname, '../..', kind.site);
  const asked: string[] = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    asked.push(pathname);
    const path = normalize(pathname);
    const head = (type: string) => ({ 'Access-Control-Allow-Origin': '*', 'Content-Type': type });
    const type = TYPES[extname(path)] ?? 'application/octet-stream';
    const file = join(dist, path.replace(/^\/player\//, ''));
    const text = own[path];
    if (text !== undefined) response.writeHead(200, head(type)).end(text);
    else if (!path.startsWith('/player/') || !existsSync(file) || statSync(file).isDirectory()) response.writeHead(404, head('text/plain')).end();
    else createReadStream(file).pipe(response.writeHead(200, head(type)));
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  return { origin: `http://127.0.0.1:${(server.address() as AddressInfo).port}`, asked, close: () => server.close() };
}
