/** Story between the tags of a player, which is also its fallback content without scripts. */

import { openInstance } from '../engine/backend.js';
import type { Backend, Diagnostic } from '../base/types.js';

/** MIME type of a script with verbatim EML: the HTML parser does not interpret it, and content security policies do not apply. */
const EML_TYPE = 'application/eml+xml';
/** Length to which a longer text is truncated: a story never takes that many hours. */
const MAX_CHARACTERS = 100_000;
/** Pattern of text that is EML rather than plain text. */
const IS_EML = /^\s*<(\?xml|!--|!DOCTYPE|([\w.-]+:)?eml\b)/i;
/** Elements that are not read: they are invisible without scripts too, except the message about missing scripts. */
const UNREAD = 'script, style, template, noscript, [hidden]';
/** Elements that start a new line; text continues across the ends of all others. */
const BLOCKS = new Set('ADDRESS ARTICLE ASIDE BLOCKQUOTE BR DD DIV DL DT FIGCAPTION FIGURE FOOTER H1 H2 H3 H4 H5 H6 HEADER HR LI MAIN OL P PRE SECTION TABLE TR UL'.split(' '));

/** Content between the tags. */
interface InlineText {
  readonly text: string;
  readonly isEml: boolean;
  /** True if it was EML before the HTML parser read it. */
  readonly isMangled: boolean;
}

/** Returns text in lines, as rendered. */
function linesOf(node: Node): string {
  let text = '';
  for (const child of node.childNodes) {
    if (child instanceof Text) text += child.data.replace(/\s+/g, ' ');
    else if (child instanceof Element && !child.matches(UNREAD)) text += BLOCKS.has(child.tagName) ? `\n${linesOf(child)}\n` : linesOf(child);
  }
  return text;
}

/** Returns text with its own spaces and line ends. */
function plainOf(host: Element): string {
  return [...host.childNodes].map((child) => (child instanceof Text || (child instanceof Element && !child.matches(UNREAD)) ? child.textContent : '')).join('');
}

/** Returns the story between the tags; undefined if it contains no word. */
function written(host: Element): InlineText | undefined {
  const carrier = host.querySelector(`:scope > script[type="${EML_TYPE}"]`);
  if (carrier !== null) return { text: carrier.textContent.trim(), isEml: true, isMangled: false };
  const plain = plainOf(host);
  if (IS_EML.test(plain)) return { text: plain.trim(), isEml: true, isMangled: false };
  const text = linesOf(host);
  return /[\p{L}\p{N}]/u.test(text) ? { text, isEml: false, isMangled: host.querySelector('eml') !== null } : undefined;
}

const MANGLED: Diagnostic = {
  code: 'text-as-html',
  severity: 'warning',
  message: 'The EML between the tags was read as HTML, which drops parts of it; only its text is performed.',
  hints: [`Put it into <script type="${EML_TYPE}">, or write &lt; for each <.`],
};

const TOO_LONG: Diagnostic = {
  code: 'text-too-long',
  severity: 'warning',
  message: `The text between the tags has more than ${MAX_CHARACTERS} characters; the rest is left out.`,
  hints: ['Put it into a story file of its own.'],
};

export class InlineStory {
  readonly #host: HTMLElement;
  readonly #observer: MutationObserver;
  #seen: string | undefined;

  /** Creates the reader; `changed` is called when the text between the tags changes. */
  constructor(host: HTMLElement, changed: () => void) {
    this.#host = host;
    this.#observer = new MutationObserver(() => this.#look(changed));
  }

  get isThere(): boolean {
    return written(this.#host) !== undefined;
  }

  /** Returns the story as EML; undefined if there is none. `report` is called for lost content. */
  async eml(language: string, backend: Promise<Backend>, report: (diagnostic: Diagnostic) => void): Promise<string | undefined> {
    const own = written(this.#host);
    if (own === undefined || own.isEml) return own?.text;
    if (own.isMangled) report(MANGLED);
    if (own.text.length > MAX_CHARACTERS) report(TOO_LONG);
    return (await openInstance(await backend)).narrate(own.text, language, false, MAX_CHARACTERS);
  }

  /** Observes changes while the player is in a document; existing content does not count as a change. */
  watch(): void {
    this.#seen = written(this.#host)?.text;
    this.#observer.observe(this.#host, { childList: true, characterData: true, subtree: true });
  }

  rest(): void {
    this.#observer.disconnect();
  }

  #look(changed: () => void): void {
    const text = written(this.#host)?.text;
    if (text === this.#seen) return;
    this.#seen = text;
    changed();
  }
}
