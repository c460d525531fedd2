// A page lies in web/pages/NAME with its scripts and styles, and is served at /NAME/: the build and the server of
// development take its HTML as if it lay there. So what the HTML names of the sources begins at the root (`/web/pages/…`),
// and links to other pages, which stand as they are, begin at its address (`../docs/`).

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { normalizePath, type Plugin } from 'vite';

/** Pages other than the first one, which is `index.html` at the root. */
export const PAGES: readonly string[] = ['viewer', 'gestures', 'face', 'expression', 'composite'];

/** Returns the virtual path of a page in the build, from which Vite derives the name of its HTML. */
export const servedPage = (root: string, name: string): string => normalizePath(join(root, name, 'index.html'));

/** Serves and builds the pages of a root. */
export function pages(root: string, names = PAGES): Plugin {
  const sources = new Map(names.map((name) => [servedPage(root, name), normalizePath(join(root, 'web/pages', name, 'index.html'))]));
  return {
    name: 'raconteur-pages',
    enforce: 'pre',
    // Where the server of development looks for packages that it prepares: the addresses of pages are no files.
    config: () => ({ optimizeDeps: { entries: ['index.html', 'web/pages/*/index.html'] } }),
    resolveId: (id) => (sources.has(normalizePath(id)) ? normalizePath(id) : undefined),
    load(id) {
      const source = sources.get(id);
      return source === undefined ? undefined : readFileSync(source, 'utf8');
    },
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const [, name = ''] = /^\/([\w-]+)\/(?:index\.html)?(?:\?|$)/.exec(request.url ?? '') ?? [];
        const source = sources.get(servedPage(root, name));
        if (source === undefined) return next();
        server.transformIndexHtml(`/${name}/index.html`, readFileSync(source, 'utf8'), request.originalUrl).then((html) => {
          response.setHeader('Content-Type', 'text/html');
          response.end(html);
        }, next);
      });
      // Vite tells browsers where the file lies, and no page is there.
      server.watcher.on('change', (path) => {
        const name = names.find((name) => sources.get(servedPage(root, name)) === normalizePath(path));
        if (name !== undefined) server.ws.send({ type: 'full-reload', path: `/${name}/index.html` });
      });
    },
  };
}
