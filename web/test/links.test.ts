import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { buildDocs, pageOf } from '../tools/docs.js';
import { deadLinks } from '../tools/links.js';

const root = join(import.meta.dirname, '../..');
let site = '';
beforeEach(() => {
  site = mkdtempSync(join(tmpdir(), 'raconteur-site-'));
});
afterEach(() => rmSync(site, { recursive: true }));

function file(path: string, text: string): void {
  mkdirSync(dirname(join(site, path)), { recursive: true });
  writeFileSync(join(site, path), text);
}

describe('links of the site', () => {
  test('what is there is found, with and without a place in it', () => {
    file('index.html', '<a href="docs/">d</a><a href="docs/a.html#b">a</a><img src="x.png" alt=""><a href="https://example.org/none">e</a><a href="#">top</a>');
    file('docs/index.html', '<a href="../">home</a><a href="a.html?q=1">a</a><svg><use href="i.svg#mark" /></svg>');
    file('docs/a.html', '<h2 id="b">b</h2>');
    file('docs/i.svg', '<svg><g id="mark"/></svg>');
    file('x.png', '');
    expect(deadLinks(site)).toEqual([]);
  });

  test('each kind of dead link is found', () => {
    const dead = ['docs/none.html', 'docs', 'docs/a.html#nowhere', 'empty/', 'x.png', 'docs/i.svg#nothing', '#gone'];
    file('docs/index.html', '');
    file('docs/a.html', '');
    file('docs/i.svg', '<svg/>');
    file('empty/other.txt', '');
    file('index.html', dead.map((href) => `<a class="x" href="${href}">x</a>`).join(''));
    expect(deadLinks(site).map(({ href }) => href)).toEqual(dead);
  });

  test('a folder needs its slash and an address its page, however the link is written', () => {
    const dead = ['docs', 'docs?q=1', 'docs#top', '../docs', '/docs', '/docs/', 'docs/../docs'];
    file('docs/index.html', '<h1 id="top">d</h1>');
    file('index.html', dead.map((href, i) => [`<a href='${href}'>x</a>`, `<a title="a > b" href="${href}">x</a>`, `<a href=${href}>x</a>`][i % 3]).join(''));
    file('fine.html', `<a href='docs/'>x</a><a href=docs/#top>x</a><a title="a > b" href="docs/?q=1">x</a>`);
    expect(deadLinks(site)).toEqual(dead.map((href) => ({ page: 'index.html', href })));
  });

  test('markup that is shown as code is not followed', () => {
    file('index.html', '<pre><code>&lt;a href="none.html"&gt;</code></pre><!-- <a href="gone.html">x</a> -->');
    expect(deadLinks(site)).toEqual([]);
  });
});

describe('documents as pages', () => {
  test('every document of the folder is published, with its pictures, and none links into nothing', () => {
    buildDocs(root, site);
    for (const path of ['README.md', 'docs/eml.md', 'docs/voices.md', 'docs/cli.md', 'docs/animation.md', 'docs/avatars.md', 'docs/speech-bundle.md']) {
      expect(readFileSync(join(site, 'docs', pageOf(path)), 'utf8')).toContain('<article');
    }
    // Links that lead out of the documents refer to the pages, which are not built here.
    const own = deadLinks(site).filter(({ href }) => !/^\.\.\/(viewer\/|gestures\/|transcribe\/|face\/|expression\/|composite\/)?$/.test(href));
    expect(own).toEqual([]);
  });

  test('a reference to a file that is not there ends the build', () => {
    const other = mkdtempSync(join(tmpdir(), 'raconteur-docs-'));
    mkdirSync(join(other, 'web/pages'), { recursive: true });
    for (const name of ['page.css', 'docs.css', 'icon.svg']) writeFileSync(join(other, 'web/pages', name), '');
    writeFileSync(join(other, 'README.md'), '![a picture](docs/none.png)');
    expect(() => buildDocs(other, site)).toThrow('docs/none.png');
    rmSync(other, { recursive: true });
  });
});
