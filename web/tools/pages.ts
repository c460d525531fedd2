// A page is in web/pages/NAME with its scripts and styles, and is served at /NAME/. The build and
// the development server use its HTML as if it were there. Links of the HTML to sources therefore
// begin at the root (`/web/pages/…`), and links to other pages, which are not rewritten, begin at
// its URL (`../docs/`).

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { normalizePath, type Plugin } from 'vite';

/** Pages other than the first one, which is `index.html` at the root. */
export const PAGES: readonly string[] = ['viewer', 'gestures', 'transcribe', 'face', 'expression', 'composite'];

/** Returns the virtual path of a page in the build, from which Vite derives the name of its HTML. */
export const servedPage = (root: string, name: string): string => normalizePath(join(root, name, 'index.html'));

/** Serves and builds the pages of a root. */
export function pages(root: string, names = PAGES): Plugin {
  const sources = new Map(names.map((name) => [servedPage(root, name), normalizePath(join(root, 'web/pages', name, 'index.html'))]));
  return {
    name: 'raconteur-pages',
    enforce: 'pre',
    // Entries in which the development server looks for packages to optimise, because the URLs of
    // pages are not files.
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
      // Vite sends browsers the location of the file, at which no page is served.
      server.watcher.on('change', (path) => {
        const name = names.find((name) => sources.get(servedPage(root, name)) === normalizePath(path));
        if (name !== undefined) server.ws.send({ type: 'full-reload', path: `/${name}/index.html` });
      });
    },
  };
}
