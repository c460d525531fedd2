/** List of the stored sessions, to open and to delete: all stored work is visible. */

import { html, nothing, type TemplateResult } from 'lit';
import type { App } from './app.js';
import type { Session } from './session.js';
import type { Listed } from './session-store.js';

/** Operations on stored sessions. */
export interface Sessions {
  readonly session: Session;
  open(id: string): Promise<void>;
  /** Begins another session. */
  begin(): Promise<void>;
}

export class KeptPanel {
  #listed: readonly Listed[] = [];
  #taken: ReadonlySet<string> = new Set();
  /** The session that is deleted by the next press. */
  #doomed: string | undefined;

  constructor(
    private readonly app: App,
    private readonly sessions: Sessions,
  ) {}

  draw(): TemplateResult {
    const toggled = (event: Event): void => {
      if ((event.target as HTMLDetailsElement).open) void this.#read();
    };
    return html`<details class="kept" @toggle=${toggled}><summary>Stored sessions</summary>
      <p class="about">The browser stores every step as you do it, on this machine only.</p>
      ${this.#listed.length === 0 ? html`<p class="none">None yet.</p>` : nothing}
      <ul class="kept-list" aria-label="Stored sessions">${this.#listed.map((one) => this.#entry(one))}</ul>
      <button type="button" class="plain" @click=${() => this.#do(() => this.sessions.begin())}>New session</button>
    </details>`;
  }

  /** Reads the list, and shows it. */
  async #read(): Promise<void> {
    const { listed, taken } = await this.sessions.session.list();
    [this.#listed, this.#taken] = [listed, taken];
    this.app.redraw();
  }

  async #do(work: () => Promise<void>): Promise<void> {
    this.#doomed = undefined;
    await work();
    await this.#read();
  }

  #entry({ id, at, count, title, picture }: Listed): TemplateResult {
    const { session } = this.sessions;
    const name = title ?? 'Face without a name';
    const date = new Date(at).toLocaleString(undefined, { dateStyle: 'medium', timeStyle: 'short' });
    const isHere = id === session.id;
    const isTaken = this.#taken.has(id);
    const remove = (): void => {
      if (this.#doomed === id) void this.#do(() => session.delete(id));
      else {
        this.#doomed = id;
        this.app.redraw();
      }
    };
    return html`<li>${picture === undefined ? html`<span class="blank"></span>` : html`<img src=${picture} width="48" height="60" alt="" />`}
      <span class="what"><b>${name}</b><small>${date}, ${count === 2 ? '1 step' : `${count - 1} steps`}${isHere ? ', open here' : isTaken ? ', open in another tab' : ''}</small></span>
      ${
        isHere
          ? nothing
          : html`<span class="group"><button type="button" class="plain" aria-label="${isTaken ? 'Open a copy' : 'Open'}: ${name}, ${date}" @click=${() => this.#do(() => this.sessions.open(id))}>${isTaken ? 'Open a copy' : 'Open'}</button>
          ${isTaken ? nothing : html`<button type="button" class="plain" aria-label="${this.#doomed === id ? 'Delete permanently' : 'Delete'}: ${name}, ${date}" @click=${remove}>${this.#doomed === id ? 'Delete permanently' : 'Delete'}</button>`}</span>`
      }</li>`;
  }
}
