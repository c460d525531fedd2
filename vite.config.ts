import { cpSync, existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';
import { kind as tested } from './web/test/tier.js';
import { course } from './web/tools/course.js';
import { buildDocs } from './web/tools/docs.js';
import { deadLinks } from './web/tools/links.js';
import { notices } from './web/tools/notices.js';
import { PAGES, pages, servedPage } from './web/tools/pages.js';
import { withParts } from './web/tools/parts.js';
import { kinds } from './web/tools/wasm.mjs';

const root = import.meta.dirname;

/**
 * Headers of a strict server. Nothing inline and nothing from elsewhere is needed:
 * wasm is the only thing that script-src must name besides the page's own files.
 */
const headers = {
  'Content-Security-Policy': [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "style-src 'self'",
    "img-src 'self' data:",
    "connect-src 'self'",
    // Recordings that a visitor opens on the page *Transcribe* are addresses of the page itself.
    "media-src 'self' blob:",
    "base-uri 'none'",
    "form-action 'none'",
    "frame-ancestors 'self'",
    "require-trusted-types-for 'script'",
    'trusted-types raconteur lit-html default',
  ].join('; '),
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'no-referrer',
  // A page that is isolated from others may have threads, which the natural voice uses.
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/**
 * Stories and figures are served as they are, under the same address as in the repository; documents
 * become pages. A link that leads nowhere ends the build.
 */
function library(): Plugin {
  let site = '';
  return {
    name: 'raconteur-library',
    apply: 'build',
    configResolved(config) {
      site = join(root, config.build.outDir);
    },
    closeBundle() {
      // What runs the natural voice for the baker is of no use to a page.
      cpSync(join(root, 'assets'), join(site, 'assets'), { recursive: true, filter: (path) => path !== join(root, 'assets/voices/kokoro/native') });
      cpSync(join(root, 'web/pages/favicon.ico'), join(site, 'favicon.ico'));
      for (const name of ['LICENSE-MIT', 'LICENSE-APACHE']) cpSync(join(root, name), join(site, name));
      writeFileSync(join(site, 'THIRD-PARTY-NOTICES.txt'), notices(root));
      // A work of its own, under a licence of its own.
      cpSync(join(root, 'packages/voice-espeak/README.md'), join(site, 'voice-espeak/README.md'));
      cpSync(join(root, 'node_modules/@echogarden/espeak-ng-emscripten/COPYING'), join(site, 'voice-espeak/COPYING'));
      buildDocs(root, site);
      const dead = deadLinks(site);
      if (dead.length > 0) throw new Error(`Dead links:\n${dead.map(({ page, href }) => `  ${page}: ${href}`).join('\n')}`);
    },
  };
}

/** Sends who asks for a folder without its slash to where its page is, as servers of files do. */
function folders(): Plugin {
  return {
    name: 'raconteur-folders',
    configurePreviewServer(server) {
      const site = join(root, server.config.build.outDir);
      server.middlewares.use((request, response, next) => {
        const [path = '', query] = (request.url ?? '').split('?');
        if (path.endsWith('/') || path.includes('..') || !existsSync(join(site, path, 'index.html'))) {
          next();
          return;
        }
        // Only the last part of the path, so that the address of another host cannot be made from it.
        response.writeHead(301, { ...headers, Location: `./${path.split('/').at(-1)}/${query === undefined ? '' : `?${query}`}` }).end();
      });
    },
  };
}

/**
 * Puts `web/pages/parts/NAME.html` in the place of `<!-- part: NAME -->`, so that what several
 * pages say is written once. A link to the page itself is marked as the current one.
 */
function parts(): Plugin {
  return {
    name: 'raconteur-parts',
    transformIndexHtml: {
      // Before addresses are read: those of a part begin at the root and are made relative with the rest.
      order: 'pre',
      handler: (page, { path }) => withParts(page).replace(`href="..${dirname(path)}/"`, '$& aria-current="page"'),
    },
  };
}

const CLIPS = 'virtual:clips';

/** Tells pages which animations the library has: what each file says about itself. */
function clips(): Plugin {
  return {
    name: 'raconteur-clips',
    resolveId: (id) => (id === CLIPS ? `\0${CLIPS}` : undefined),
    load(id) {
      if (id !== `\0${CLIPS}`) return undefined;
      const folder = join(root, 'assets/animations');
      const files = readdirSync(folder)
        .filter((name) => name.endsWith('.json'))
        .sort();
      const list = files.map((file) => {
        const { about = '' } = JSON.parse(readFileSync(join(folder, file), 'utf8')) as { about?: string };
        return { name: file.replace(/\.json$/, ''), about };
      });
      return `export default ${JSON.stringify(list)};`;
    },
  };
}

/** All wasm builds call their file the same; the folder tells them apart. */
function assetFileNames({ originalFileNames }: { readonly originalFileNames: readonly string[] }): string {
  const [, build] = originalFileNames.map((name) => /pkg\/(?:quick\/)?(webgpu|webgl|annotate|avatar|faces|say)\//.exec(name)).find(Boolean) ?? [];
  return `app/${build ?? '[name]'}-[hash][extname]`;
}

export default defineConfig(({ mode }) => {
  const kind = mode === 'test' ? tested : mode === kinds.quick.name ? kinds.quick : kinds.shipped;
  return {
    root,
    // Addresses are relative, so that dist/ may be served from any folder.
    base: './',
    // A missing file is answered 404, not with the page.
    appType: 'mpa',
    publicDir: false,
    // Imports name the builds that ship; those of the tests lie elsewhere.
    resolve: { alias: [{ find: /^\.\.\/pkg\//, replacement: `${join(root, kind.folder)}/` }] },
    plugins: [pages(root), parts(), library(), folders(), clips(), course()],
    // Its files are called as the page's are.
    worker: { format: 'es', rolldownOptions: { output: { entryFileNames: 'app/[name]-[hash].js', assetFileNames } } },
    build: {
      target: 'es2022',
      outDir: kind.site,
      emptyOutDir: true,
      assetsDir: 'app',
      assetsInlineLimit: 0,
      modulePreload: { polyfill: false },
      rolldownOptions: {
        input: {
          index: join(root, 'index.html'),
          ...Object.fromEntries(PAGES.map((name) => [name, servedPage(root, name)])),
          'raconteur-player': join(root, 'web/element/index.ts'),
          'raconteur-composite': join(root, 'web/composite/index.ts'),
          'raconteur-course': join(root, 'web/course/index.ts'),
        },
        // The elements have addresses that a page can name.
        preserveEntrySignatures: 'strict',
        output: {
          entryFileNames: (chunk) => (chunk.name.startsWith('raconteur-') ? '[name].js' : 'app/[name]-[hash].js'),
          chunkFileNames: (chunk) => {
            const backend = /pkg\/(?:quick\/)?(webgpu|webgl|annotate|avatar|faces|say)\//.exec(chunk.facadeModuleId ?? '')?.[1];
            return `app/${backend ?? '[name]'}-[hash].js`;
          },
          assetFileNames,
        },
      },
    },
    preview: { headers },
    // Random cases take seconds where compilers have the cores; what takes a minute hangs.
    test: { include: ['web/test/**/*.test.ts'], testTimeout: 60_000 },
  };
});
