/** The script of one server on the page of another. */

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { kind } from '../../web/test/tier.js';
import { story } from './fixture.js';
import { expect, ready, test } from './stage.js';

const TYPES: { [ending: string]: string } = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };

/** Serves the built page from the folder `/player/`, to any page, and records requests. */
async function serve(asked: string[]): Promise<{ server: Server; origin: string }> {
  const dist = join(import.meta.dirname, '../..', kind.site);
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    asked.push(pathname);
    const path = normalize(pathname);
    const file = join(dist, path.replace(/^\/player\//, ''));
    if (!path.startsWith('/player/') || !existsSync(file) || statSync(file).isDirectory()) {
      response.writeHead(404, { 'Access-Control-Allow-Origin': '*' }).end();
      return;
    }
    response.writeHead(200, { 'Access-Control-Allow-Origin': '*', 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  return { server, origin: `http://127.0.0.1:${(server.address() as AddressInfo).port}` };
}

test('a script from another server finds its figures, its code and its animations there', async ({ stage, page }) => {
  const asked: string[] = [];
  const { server, origin } = await serve(asked);
  try {
    await page.context().grantPermissions(['local-network-access']);
    await page.route('**/elsewhere/**', (route) => {
      const { pathname } = new URL(route.request().url());
      if (pathname.endsWith('.eml')) return route.fulfill({ body: story("<voice-text time='0'>Hello.</voice-text>") });
      if (!pathname.endsWith('/')) return route.fulfill({ status: 404 });
      return route.fulfill({
        contentType: 'text/html',
        body: `<!doctype html><html lang="en"><meta charset="utf-8"><title>Test</title><script type="module" src="${origin}/player/raconteur-player.js"></script>
          <body><raconteur-player src="story.eml" backend="${stage.backend}" quality="lowest" loading="eager"></raconteur-player>
          <raconteur-player id="other" assets="mine/"></raconteur-player></body></html>`,
      });
    });
    await page.goto('/elsewhere/page/');
    await ready(stage.player);
    expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.assets, p.currentFigure])).toEqual([`${origin}/player/assets/`, 'sofia']);
    expect(asked).toContain('/player/assets/figures/sofia.glb');
    expect(asked.filter((path) => !path.startsWith('/player/'))).toEqual([]);
    // What the page says is still the page's.
    const wanted = page.waitForRequest('**/elsewhere/page/mine/figures/sofia.glb');
    await page.locator('#other').evaluate((p: RaconteurPlayer) => void p.rehearse('<eml><body><null time="1"/></body></eml>').catch(() => undefined));
    await wanted;
  } finally {
    server.close();
  }
});
