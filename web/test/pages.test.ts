import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { build, createServer, type Rolldown } from 'vite';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { PAGES, pages, servedPage } from '../tools/pages.js';

const root = join(import.meta.dirname, '../..');

let site: string;
beforeEach(() => {
  site = mkdtempSync(join(tmpdir(), 'raconteur-pages-'));
  const folder = join(site, 'web/pages/a');
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, 'index.html'), '<!doctype html><title>A</title><script type="module" src="/web/pages/a/main.ts"></script><a href="../b/">b</a>');
  writeFileSync(join(folder, 'main.ts'), 'document.title = "B" as string;');
});
afterEach(() => rmSync(site, { recursive: true }));

it('names every page that has a folder', () => {
  const folder = join(root, 'web/pages');
  expect([...PAGES].sort()).toEqual(readdirSync(folder).filter((name) => existsSync(join(folder, name, 'index.html'))));
});

it('builds a page at its address, with what it names from there', async () => {
  const built = (await build({
    root: site,
    base: './',
    configFile: false,
    logLevel: 'silent',
    plugins: [pages(site, ['a'])],
    build: { write: false, rolldownOptions: { input: { a: servedPage(site, 'a') }, output: { entryFileNames: 'app/[name].js' } } },
  })) as Rolldown.RolldownOutput;
  const html = built.output.find(({ fileName }) => fileName.endsWith('.html'));
  expect(html?.fileName).toBe('a/index.html');
  const text = html?.type === 'asset' ? String(html.source) : '';
  expect(text).toContain('src="../app/a.js"');
  expect(text).toContain('href="../b/"');
});

it('serves a page at its address while it is written', async () => {
  const server = await createServer({
    root: site,
    appType: 'mpa',
    configFile: false,
    logLevel: 'silent',
    plugins: [pages(site, ['a'])],
    optimizeDeps: { noDiscovery: true },
    server: { port: 0, host: '127.0.0.1', ws: false, watch: null },
  });
  try {
    await server.listen();
    const { port } = server.httpServer!.address() as AddressInfo;
    const get = (path: string) => fetch(`http://127.0.0.1:${port}${path}`, { headers: { accept: 'text/html' } });
    for (const path of ['/a/', '/a/index.html', '/a/?figure=lia']) {
      const page = await get(path);
      expect(page.headers.get('content-type'), path).toContain('text/html');
      // As Vite serves pages: its own script is added, addresses stay.
      expect(await page.text(), path).toMatch(/\/@vite\/client.*src="\/web\/pages\/a\/main\.ts".*href="\.\.\/b\/"/s);
    }
    expect((await get('/b/')).status).toBe(404);
    expect(await (await get('/web/pages/a/main.ts')).text()).toContain('document.title = "B"');
  } finally {
    await server.close();
  }
});
