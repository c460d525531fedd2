/** The story that stands between the tags of a player, and is what a reader without scripts has of it. */

import { openInstance } from '../engine/backend.js';
import type { Backend, Diagnostic } from '../base/types.js';

/** A script of this type carries EML as it is: the parser of HTML leaves it alone, and no policy of the page is about it. */
const EML_TYPE = 'application/eml+xml';
/** A longer text is told so far: as many hours are no story. */
const MAX_CHARACTERS = 100_000;
/** Text that is EML, and not to be said. */
const IS_EML = /^\s*<(\?xml|!--|!DOCTYPE|([\w.-]+:)?eml\b)/i;
/** What is not read: none of it is shown without scripts either, but for what says that there are none. */
const UNREAD = 'script, style, template, noscript, [hidden]';
/** What begins a line of its own; text flows on over the ends of all other elements. */
const BLOCKS = new Set('ADDRESS ARTICLE ASIDE BLOCKQUOTE BR DD DIV DL DT FIGCAPTION FIGURE FOOTER H1 H2 H3 H4 H5 H6 HEADER HR LI MAIN OL P PRE SECTION TABLE TR UL'.split(' '));

/** What stands between the tags. */
interface InlineText {
  readonly text: string;
  readonly isEml: boolean;
  /** It was EML before the parser of HTML read it. */
  readonly isMangled: boolean;
}

/** Text in lines, as it would be shown. */
function linesOf(node: Node): string {
  let text = '';
  for (const child of node.childNodes) {
    if (child instanceof Text) text += child.data.replace(/\s+/g, ' ');
    else if (child instanceof Element && !child.matches(UNREAD)) text += BLOCKS.has(child.tagName) ? `\n${linesOf(child)}\n` : linesOf(child);
  }
  return text;
}

/** Text with its own spaces and line ends. */
function plainOf(host: Element): string {
  return [...host.childNodes].map((child) => (child instanceof Text || (child instanceof Element && !child.matches(UNREAD)) ? child.textContent : '')).join('');
}

/** The story between the tags; undefined where no word is there. */
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

  /** `changed` is called when another text stands between the tags. */
  constructor(host: HTMLElement, changed: () => void) {
    this.#host = host;
    this.#observer = new MutationObserver(() => this.#look(changed));
  }

  get isThere(): boolean {
    return written(this.#host) !== undefined;
  }

  /** The story as EML; undefined where there is none. `report` hears what is lost of it. */
  async eml(language: string, backend: Promise<Backend>, report: (diagnostic: Diagnostic) => void): Promise<string | undefined> {
    const own = written(this.#host);
    if (own === undefined || own.isEml) return own?.text;
    if (own.isMangled) report(MANGLED);
    if (own.text.length > MAX_CHARACTERS) report(TOO_LONG);
    return (await openInstance(await backend)).narrate(own.text, language, false, MAX_CHARACTERS);
  }

  /** Watches while the player is in a page; what is there already is no change. */
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
