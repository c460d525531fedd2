/** What is read of an answer while the story goes on. */

import { html, type TemplateResult } from 'lit';

/** It stays so long while the story plays; who needs more rests the story. */
const SHOWN_SECS = 20;

/** What is asked of whoever shows it. */
interface Listener {
  /** Whether the story plays and is seen. */
  plays(): boolean;
  /** It is gone. */
  gone(): void;
  /** Somebody has closed it by a key, and is to go on from elsewhere. */
  left(): void;
}

export class Note {
  readonly #listener: Listener;
  #text = '';
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(listener: Listener) {
    this.#listener = listener;
  }

  /** What is to be read; empty where there is nothing. */
  get text(): string {
    return this.#text;
  }

  /** Shows a text; an empty one takes it away. */
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
    // A key has pressed the button, which goes.
    if (detail === 0) this.#listener.left();
  }

  /** By itself, with a way to close it. */
  render(language: string, direction: string, words: { readonly close: string }): TemplateResult {
    return html`<div class="feedback" part="feedback" lang=${language} dir=${direction}>
      <p dir="auto">${this.#text}</p>
      <button type="button" aria-label=${words.close} @click=${(event: MouseEvent) => this.#close(event)}>✕</button>
    </div>`;
  }
}
