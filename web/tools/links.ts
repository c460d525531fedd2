// Follows every link of the built site, to find dead ones.

import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join, relative } from 'node:path';

/** Dead link: its page, and its address as written. */
export interface DeadLink {
  readonly page: string;
  readonly href: string;
}

function* filesOf(folder: string): Generator<string> {
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) yield* filesOf(path);
    else yield path;
  }
}

/** Pattern of a tag, with any content in the quotes of its attributes. */
const TAG = /<[a-z](?:[^>"']|"[^"]*"|'[^']*')*>/gi;
/** An attribute that names an address: in quotes of either kind, or bare. */
const ADDRESS = /\s(?:href|src|poster|assets)\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'>]+))/gi;

/** Returns the addresses in a page: links, images, scripts, styles. Code is text, not markup. */
function addressesOf(html: string): string[] {
  const markup = html.replace(/<!--[\s\S]*?-->/g, '');
  return [...markup.matchAll(TAG)].flatMap(([tag]) => [...tag.matchAll(ADDRESS)].map(([, double, single, bare]) => (double ?? single ?? bare ?? '').replace(/&amp;/g, '&')));
}

/**
 * Returns the links within the site in `folder` to missing files or anchors, to a folder without its slash, or from the server's root, which may differ from
 * the site's. Other sites are not fetched.
 */
export function deadLinks(folder: string): DeadLink[] {
  const dead: DeadLink[] = [];
  const texts = new Map<string, string>();
  const read = (path: string): string => {
    const text = texts.get(path) ?? readFileSync(path, 'utf8');
    texts.set(path, text);
    return text;
  };
  const base = 'http://site.invalid/';
  for (const path of filesOf(folder)) {
    if (!path.endsWith('.html')) continue;
    const page = relative(folder, path).replaceAll('\\', '/');
    for (const href of new Set(addressesOf(read(path)))) {
      const url = new URL(href, base + page);
      if (!url.href.startsWith(base)) continue;
      // The site may be served from any folder.
      if (href.startsWith('/')) {
        dead.push({ page, href });
        continue;
      }
      let target = join(folder, decodeURIComponent(url.pathname));
      // Some servers redirect a folder without a trailing slash, others lose it.
      const isFolder = existsSync(target) && statSync(target).isDirectory();
      if (isFolder && url.pathname.endsWith('/')) {
        // A folder of files, such as the asset library, has no page of its own.
        if (!existsSync(join(target, 'index.html')) && /\bassets\/$/.test(url.pathname)) continue;
        target = join(target, 'index.html');
      }
      const place = decodeURIComponent(url.hash.slice(1));
      const found = existsSync(target) && statSync(target).isFile() && (place === '' || !/\.(html|svg)$/.test(target) || read(target).includes(`id="${place}"`));
      if (!found) dead.push({ page, href });
    }
  }
  return dead;
}
