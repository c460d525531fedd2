/** Feedback on an answer, shown while the story continues. */

import { html, type TemplateResult } from 'lit';

/** Display time while the story plays; a reader who needs longer can pause the story. */
const SHOWN_SECS = 20;

/** Callbacks to the owner of the note. */
interface Listener {
  /** Returns true if the story plays and is visible. */
  plays(): boolean;
  /** Called when the note is gone. */
  gone(): void;
  /** Called when the note is closed with a key and the focus must move on. */
  left(): void;
}

export class Note {
  readonly #listener: Listener;
  #text = '';
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(listener: Listener) {
    this.#listener = listener;
  }

  /** Text to read; empty if there is none. */
  get text(): string {
    return this.#text;
  }

  /** Shows a text; an empty one removes it. */
  show(text: string): void {
    clearInterval(this.#timer);
    this.#text = text;
    if (text === '') {
      this.#listener.gone();
      return;
    }
    let leftSecs = SHOWN_SECS;
    this.#timer = setInterval(() => {
      if (this.#listener.plays()) leftSecs -= 1;
      if (leftSecs <= 0) this.show('');
    }, 1000);
  }

  #close({ detail }: MouseEvent): void {
    this.show('');
    // A key pressed the button, which is removed.
    if (detail === 0) this.#listener.left();
  }

  /** Renders the note with a button to close it. */
  render(language: string, direction: string, words: { readonly close: string }): TemplateResult {
    return html`<div class="feedback" part="feedback" lang=${language} dir=${direction}>
      <p dir="auto">${this.#text}</p>
      <button type="button" aria-label=${words.close} @click=${(event: MouseEvent) => this.#close(event)}>✕</button>
    </div>`;
  }
}
