/** The captions button, and the list that it opens where captions can be chosen in several languages. */

import { html, nothing, type LitElement, type TemplateResult } from 'lit';
import type { ControlWords } from './control-words.js';
import { icons } from './icons.js';

/** Entry of the list. */
export interface CaptionChoice {
  readonly label: string;
  /** Language of the label, a BCP 47 tag, if it is another than that of the controls. */
  readonly language: string | undefined;
  readonly isChosen: boolean;
  choose(): void;
}

/** Returns the name of a language in that language; empty if it has none. */
export function nameOf(language: string): string {
  try {
    const name = new Intl.DisplayNames([language], { type: 'language', fallback: 'none' }).of(language) ?? '';
    return name.slice(0, 1).toLocaleUpperCase(language) + name.slice(1);
  } catch {
    // Not a tag of a language.
    return '';
  }
}

/** Renders the button that switches captions on and off. */
export function captionsButton(words: ControlWords, isOn: boolean, toggle: () => void): TemplateResult {
  return html`<button part="button captions-button" aria-label=${words.captions} aria-pressed=${isOn ? 'true' : 'false'} title="${words.captions} (C)" @click=${toggle}>${icons.captions}</button>`;
}

/** Targets of the keys that move the focus among `count` entries. */
const MOVES: Readonly<Record<string, (at: number, count: number) => number>> = {
  ArrowDown: (at, count) => (at + 1) % count,
  ArrowUp: (at, count) => (at - 1 + count) % count,
  Home: () => 0,
  End: (_, count) => count - 1,
  // They would seek in the story.
  ArrowLeft: (at) => at,
  ArrowRight: (at) => at,
};

/** The button with its list, by the menu pattern of WAI-ARIA. */
export class CaptionMenu {
  readonly #player: LitElement;
  #isOpen = false;

  constructor(player: LitElement) {
    this.#player = player;
    // The controls of another story begin closed.
    player.addEventListener('emptied', () => (this.#isOpen = false));
  }

  /** Closes the list and returns the focus to its button; returns false if it was closed. */
  close(): boolean {
    if (!this.#isOpen) return false;
    this.#set(false);
    this.#player.renderRoot.querySelector<HTMLElement>('.choice > button')?.focus();
    return true;
  }

  render(words: ControlWords, isOn: boolean, choices: readonly CaptionChoice[]): TemplateResult {
    // The wrapper takes the focus of a click in browsers whose buttons do not, so that the list does not close before the click.
    return html`<div class="choice" tabindex="-1" @focusout=${this.#left} @keydown=${this.#pressed}>
      <button
        class=${isOn ? 'on' : ''}
        part="button captions-button"
        aria-label=${words.captions}
        aria-haspopup="menu"
        aria-expanded=${this.#isOpen ? 'true' : 'false'}
        title="${words.captions} (C)"
        @click=${this.#toggle}
      >
        ${icons.captions}
      </button>
      ${this.#isOpen ? html`<div class="menu" part="captions-menu" role="menu" aria-label=${words.captions}>${choices.map((choice) => this.#item(choice))}</div>` : nothing}
    </div>`;
  }

  #item({ label, language, isChosen, choose }: CaptionChoice): TemplateResult {
    const chosen = () => {
      choose();
      this.close();
    };
    return html`<button part="button captions-choice" role="menuitemradio" aria-checked=${isChosen ? 'true' : 'false'} tabindex="-1" lang=${language ?? nothing} @click=${chosen}>${label}</button>`;
  }

  get #items(): HTMLElement[] {
    return [...this.#player.renderRoot.querySelectorAll<HTMLElement>('.menu > button')];
  }

  #set(isOpen: boolean): void {
    this.#isOpen = isOpen;
    this.#player.requestUpdate();
  }

  readonly #toggle = async (): Promise<void> => {
    if (this.close()) return;
    this.#set(true);
    await this.#player.updateComplete;
    this.#items.find((item) => item.ariaChecked === 'true')?.focus();
  };

  readonly #left = ({ currentTarget, relatedTarget }: FocusEvent): void => {
    if (!(currentTarget as Element).contains(relatedTarget as Node | null)) this.#set(false);
  };

  readonly #pressed = (event: KeyboardEvent): void => {
    const items = this.#items;
    const move = MOVES[event.key];
    if (items.length === 0 || move === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const at = items.findIndex((item) => item.matches(':focus'));
    items[move(Math.max(0, at), items.length)]?.focus();
  };
}
