// Turns the repository's documents into pages of the site, in the page's own look.

import { copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { Marked } from 'marked';

const documents = ['README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'docs/face.md', 'docs/figures.md', 'docs/gestures.md', 'docs/live.md'];

/** A document's page, beside those of the others. */
const page = (name: string): string => `${basename(name, '.md').toLowerCase()}.html`;
const title = (name: string): string => basename(name, '.md').replace(/^(.)(.*)$/, (_, first: string, rest: string) => first.toUpperCase() + rest.toLowerCase());

/** A heading's text as a name for links, as code hosts make it. */
const slug = (text: string): string => text.toLowerCase().replace(/<[^>]*>|&[a-z]+;/g, '').replace(/[^\w\- ]/g, '').trim().replace(/ /g, '-');

const marked = new Marked({
  renderer: {
    heading({ tokens, depth }) {
      const text = this.parser.parseInline(tokens);
      return `<h${depth} id="${slug(text)}">${text}</h${depth}>\n`;
    },
    // A wide block scrolls by itself, also with the keyboard.
    code({ text }) {
      return `<pre tabindex="0"><code>${text.replace(/&/g, '&amp;').replace(/</g, '&lt;')}</code></pre>\n`;
    },
    link({ href, tokens }) {
      const [path = '', place] = href.split('#');
      const target = documents.find((name) => basename(name) === basename(path));
      const to = target ? `${page(target)}${place ? `#${place}` : ''}` : href;
      return `<a href="${to}">${this.parser.parseInline(tokens)}</a>`;
    },
  },
});

/** Writes `docs/*.html` into the built site; documents that are not there are left out. */
export function buildDocs(root: string, site: string): void {
  const present = documents.filter((name) => existsSync(join(root, name)));
  const folder = join(site, 'docs');
  mkdirSync(folder, { recursive: true });
  copyFileSync(join(root, 'web/pages/page.css'), join(folder, 'page.css'));
  for (const name of present) {
    const links = present.map((other) => `<a href="${page(other)}"${other === name ? ' aria-current="page"' : ''}>${title(other)}</a>`);
    const body = marked.parse(readFileSync(join(root, name), 'utf8'), { async: false });
    writeFileSync(
      join(folder, page(name)),
      `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <title>${title(name)}, Raconteur</title>
    <link rel="stylesheet" href="page.css" />
  </head>
  <body>
    <header class="top">
      <a class="brand" href="../">Raconteur</a>
      <nav aria-label="Documents">${links.join(' ')}</nav>
    </header>
    <main><article class="document">${body}</article></main>
  </body>
</html>
`,
    );
  }
}
