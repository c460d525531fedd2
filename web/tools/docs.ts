// Converts the repository's documents to pages of the site, in the site's design.

import { copyFileSync, existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, posix } from 'node:path';
import { Marked } from 'marked';
import { withParts } from './parts.js';

/** Document: its path in the repository, its label in lists, and its subject. */
type Document = readonly [path: string, label: string, about: string];

/** All documents of the site, in menu order. */
const groups: readonly (readonly [title: string, documents: readonly Document[]])[] = [
  ['Start', [['README.md', 'Read me', 'What Raconteur is, two commands to try it, and how to put it on a page.']]],
  [
    'Write stories',
    [
      ['docs/eml.md', 'EML', 'Every element and attribute of the language, with examples.'],
      ['docs/gestures.md', 'Gestures', 'Gestures by dragging: the page on which they are built.'],
      ['docs/transcribing.md', 'Transcribing gestures', 'From an annotated recording to a performance, and back.'],
      ['docs/hand-shapes.md', 'Sources of the hand shapes', 'Where the hand shapes come from, and typical palm orientations.'],
      ['docs/animation.md', 'Animations', 'The format of animations, and how to write one.'],
      ['docs/face.md', 'The face', 'Muscles, speech, emotions and control parameters.'],
      ['docs/voices.md', 'Voices', 'Speech engines, markup, emotions in the voice.'],
    ],
  ],
  [
    'On your page',
    [
      ['docs/embedding.md', 'Embedding', 'A script tag or a package, what to serve, what fails.'],
      ['examples/README.md', 'Examples', 'Small applications with React, Vue, Svelte, Solid, Next, and without any of them.'],
      ['docs/element.md', 'The element', 'Every attribute, property, method and event.'],
      ['docs/expression.md', 'Expression', 'How camera, light and music express emotions.'],
      ['docs/courses.md', 'Courses', 'A story for SCORM, cmi5 and xAPI, or for any server.'],
      ['docs/live.md', 'Live', 'Minds that send EML while a story plays.'],
      ['docs/figures.md', 'Figures', 'The figures of the library and how they are made.'],
      ['docs/avatars.md', 'Avatars', 'Your own glTF and VRM files.'],
    ],
  ],
  [
    'Tools',
    [
      ['docs/cli.md', 'Command line', 'The program raconteur, command by command.'],
      ['docs/speech-bundle.md', 'Speech bundles', 'What a baked voice consists of.'],
    ],
  ],
  [
    'Library',
    [
      ['assets/stories/README.md', 'Stories', 'The stories that are shipped.'],
      ['assets/courses/README.md', 'Ready course', 'A course about storytelling: ten minutes, six questions, in three languages.'],
      ['assets/animations/README.md', 'Shipped animations', 'The animations that are shipped.'],
      ['assets/figures/README.md', 'Shipped figures', 'Where the figures come from.'],
      ['assets/hand-shapes/README.md', 'Hand shapes', 'The pictures of the 61 hand shapes.'],
      ['assets/music/README.md', 'Music', 'Scores, and how they are played.'],
    ],
  ],
  [
    'Project',
    [
      ['ARCHITECTURE.md', 'Architecture', 'How it is built, and what is deliberately absent.'],
      ['docs/glossary.md', 'Glossary', 'The terms of the project and their former names.'],
      ['CONTRIBUTING.md', 'Contributing', 'How to add to it.'],
      ['docs/testing.md', 'Testing', 'What the gate checks, and what the long tier adds.'],
      ['SECURITY.md', 'Security', 'What is trusted, what is not, and how to report a hole.'],
      ['CHANGELOG.md', 'Changes', 'What is new.'],
    ],
  ],
];

/** Pattern of files that documents may show or offer besides pages. */
const FILE = /\.(png|webp|svg|json|rng)$/;

/** Returns the path of a document's page, in the same folder as the others. */
export function pageOf(path: string): string {
  const folder = /^assets\/([\w-]+)\/README\.md$/.exec(path)?.[1];
  if (folder !== undefined) return `library-${folder}.html`;
  return path === 'examples/README.md' ? 'examples.html' : `${basename(path, '.md').toLowerCase()}.html`;
}

/** Converts a heading's text to a name for links, as code hosts do. */
const slug = (text: string): string =>
  text
    .toLowerCase()
    .replace(/<[^>]*>|&[a-z]+;/g, '')
    .replace(/[^\w\- ]/g, '')
    .trim()
    .replace(/ /g, '-');

const escaped = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/"/g, '&quot;');

/** Renders a document as HTML; `file` converts the path of a referenced file to its address. */
function bodyOf(path: string, text: string, pages: ReadonlySet<string>, file: (path: string) => string): string {
  const slugs = new Map<string, number>();
  /** Converts an address in the document to one on the site. */
  const address = (href: string): string => {
    if (/^([a-z]+:|#|\/)/.test(href)) return href;
    const [to = '', place] = href.split('#');
    const target = posix.join(dirname(path), to);
    const name = pages.has(target) ? pageOf(target) : file(target);
    return place ? `${name}#${place}` : name;
  };
  const marked = new Marked({
    renderer: {
      heading({ tokens, depth }) {
        const inner = this.parser.parseInline(tokens);
        const name = slug(inner);
        const seen = slugs.get(name) ?? 0;
        slugs.set(name, seen + 1);
        return `<h${depth} id="${name}${seen > 0 ? `-${seen}` : ''}">${inner}</h${depth}>\n`;
      },
      // A wide block scrolls on its own, also with the keyboard.
      code({ text: code }) {
        return `<pre tabindex="0"><code>${code.replace(/&/g, '&amp;').replace(/</g, '&lt;')}</code></pre>\n`;
      },
      link({ href, tokens }) {
        return `<a href="${escaped(address(href))}">${this.parser.parseInline(tokens)}</a>`;
      },
      image({ href, text: alt }) {
        return `<img src="${escaped(address(href))}" alt="${escaped(alt)}" loading="lazy" />`;
      },
    },
  });
  // A wide table scrolls on its own, as code does; an empty corner is not a header.
  return marked.parse(text, { async: false }).replaceAll('<table>', '<table tabindex="0">').replaceAll('<th></th>', '<td></td>');
}

/** Returns the list of all documents; `current` is marked. */
function menu(root: string, current: string): string {
  return groups
    .map(([title, documents]) => {
      const items = documents
        .filter(([path]) => existsSync(join(root, path)))
        .map(([path, label]) => `<li><a href="${pageOf(path)}"${path === current ? ' aria-current="page"' : ''}>${label}</a></li>`);
      return `<h2>${title}</h2>\n<ul>${items.join('')}</ul>`;
    })
    .join('\n');
}

/** Returns the index page of the documents: each one with a line on its subject. */
function overview(root: string): string {
  const sections = groups.map(([title, documents]) => {
    const items = documents.filter(([path]) => existsSync(join(root, path))).map(([path, label, about]) => `<li><a href="${pageOf(path)}">${label}</a><span>${about}</span></li>`);
    return `<section><h2>${title}</h2><ul>${items.join('')}</ul></section>`;
  });
  return `<h1>Documents</h1>\n<div class="overview">${sections.join('\n')}</div>`;
}

/** Returns the top of every page, with addresses as they are in `docs/`. */
function topOf(): string {
  return withParts('    <!-- part: top -->').replace('/web/pages/icon.svg', 'icon.svg').replace('href="../docs/"', 'href="./" aria-current="true"');
}

function layout(top: string, title: string, links: string, body: string): string {
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <title>${title}, Raconteur</title>
    <link rel="icon" href="icon.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="page.css" />
    <link rel="stylesheet" href="docs.css" />
  </head>
  <body>
    <a class="skip" href="#text">Skip to the text</a>
${top}
    <main class="library">
      <article class="document" id="text">${body}</article>
      <nav class="documents" aria-label="Documents">${links}</nav>
    </main>
  </body>
</html>
`;
}

/** Returns a style sheet with its imports inlined: the files of documents are not bundled. */
function withImports(path: string): string {
  return readFileSync(path, 'utf8').replace(/^@import '(.+)';$/gm, (_, name: string) => withImports(join(dirname(path), name)));
}

/**
 * Writes the documents into `docs/` of the built site, with the files that they show or offer.
 * Throws where a document refers to a file that is not there.
 */
export function buildDocs(root: string, site: string): void {
  const present = groups.flatMap(([, documents]) => documents).filter(([path]) => existsSync(join(root, path)));
  const pages = new Set(present.map(([path]) => path));
  const folder = join(site, 'docs');
  const top = topOf();
  mkdirSync(folder, { recursive: true });
  for (const name of ['docs.css', 'icon.svg']) copyFileSync(join(root, 'web/pages', name), join(folder, name));
  writeFileSync(join(folder, 'page.css'), withImports(join(root, 'web/pages/page.css')));
  writeFileSync(join(folder, 'index.html'), layout(top, 'Documents', menu(root, ''), overview(root)));
  for (const [path, label] of present) {
    const file = (target: string): string => {
      const from = join(root, target);
      if (!FILE.test(target) || !existsSync(from) || !statSync(from).isFile()) throw new Error(`${path} refers to ${target}, which is not there or not published.`);
      copyFileSync(from, join(folder, basename(target)));
      return basename(target);
    };
    const body = bodyOf(path, readFileSync(join(root, path), 'utf8'), pages, file);
    writeFileSync(join(folder, pageOf(path)), layout(top, label, menu(root, path), body));
  }
}
