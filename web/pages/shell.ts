/** Shell shared by the pages *Face* and *Viewer* around their panels: changes, playback, tabs, the text and its problems. */

import './player.js';
import { html, nothing, render, type TemplateResult } from 'lit';
import { SETTLED_SECS, type PageState } from './page-state.js';
import { cast } from './cast.js';
import { Tabs } from './tabs.js';
import { copyText, onUndoKeys, byId, saveScript } from './workbench.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2];
/** Problems that are listed; the rest is counted. */
const MAX_PROBLEMS = 5;
/** Events after which the playback controls must be updated. */
const PLAYER_EVENTS = ['play', 'pause', 'seeked', 'ratechange', 'loadedmetadata', 'durationchange'];

/** Page-specific parts of the shell. */
export interface ShellPage<T extends string> {
  readonly panels: Readonly<Record<T, () => TemplateResult>>;
  /** Renders buttons next to the play button. */
  playing?(): TemplateResult;
  /** Renders the controls of the view. */
  views(): TemplateResult;
  /** Called on reset, in addition to that of the settings. */
  reset?(): void;
  /** Types of inputs in which the keys of undo undo letters. */
  readonly typed: readonly string[];
  /** Draws the rest of the page. */
  draw?(): void;
  /** Called before each frame while the story plays in view. */
  keepUp(): void;
}

export class Shell<S extends object, T extends string> {
  readonly #app: PageState<S> & { tab: T };
  readonly #page: ShellPage<T>;
  readonly #places = { tools: byId('tools'), transport: byId('transport'), panel: byId('panel'), eml: byId('eml'), problems: byId('problems'), status: byId('status') };
  readonly #tabs: Tabs<T>;

  constructor(app: PageState<S> & { tab: T }, page: ShellPage<T>) {
    this.#app = app;
    this.#page = page;
    this.#tabs = new Tabs(
      (name): name is T => name in page.panels,
      (tab) => {
        app.tab = tab;
        this.draw();
      },
    );
    this.#listen();
  }

  #listen(): void {
    const { player } = this.#app;
    byId('copy').addEventListener('click', (event) => {
      const button = event.currentTarget as HTMLButtonElement;
      copyText(this.#app.eml, (outcome) => {
        button.textContent = outcome ?? 'Copy';
        if (outcome !== undefined) this.say(outcome);
      });
    });
    byId('download').addEventListener('click', () => this.say(`${saveScript(this.#app.eml, 'raconteur')} is saved.`));
    // In a text field, undo applies to letters.
    onUndoKeys(
      () => this.#app.undo(),
      () => this.#app.redo(),
      ({ target }) => target instanceof HTMLInputElement && this.#page.typed.includes(target.type),
    );
    for (const type of PLAYER_EVENTS) player.addEventListener(type, () => this.#app.redraw());
    cast(player, () => undefined);
    const keepUp = (): void => {
      if (!player.paused && !document.hidden) this.#page.keepUp();
      requestAnimationFrame(keepUp);
    };
    requestAnimationFrame(keepUp);
  }

  /** Opens the stage at a time at which all figures have reached their positions; `placed` is called there, before playback. */
  async open(look: () => void, placed?: () => void): Promise<void> {
    const { player } = this.#app;
    this.draw();
    look();
    await this.#app.rehearse();
    player.currentTime = SETTLED_SECS;
    placed?.();
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches) await player.play().catch(() => undefined);
    this.#app.redraw();
  }

  draw(): void {
    const { tools, transport, panel, eml, problems } = this.#places;
    const { tab, eml: text } = this.#app;
    render(this.#tools(), tools);
    render(this.#transport(), transport);
    this.#tabs.mark(tab, panel);
    render(this.#page.panels[tab](), panel);
    this.#page.draw?.();
    if (eml.textContent !== text) eml.replaceChildren(...text.split(/(?<=\n)/).map(line));
    render(this.#problems(), problems);
  }

  /** Announces a text to screen readers. */
  say(text: string): void {
    this.#places.status.textContent = text;
  }

  #tools(): TemplateResult {
    const app = this.#app;
    return html`<button type="button" class="plain" ?disabled=${!app.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
    <button type="button" class="plain" ?disabled=${!app.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    <button type="button" class="plain" ?disabled=${app.isNew} @click=${() => this.#reset()}>Reset</button>`;
  }

  #reset(): void {
    this.#app.set((s) => Object.assign(s, this.#app.beginning()));
    this.#page.reset?.();
    this.say('Everything is reset. Undo restores it.');
  }

  #toggle(): void {
    const { player } = this.#app;
    if (!player.paused) player.pause();
    else player.play().catch(() => this.say('The browser allows playback only after a click.'));
  }

  #transport(): TemplateResult {
    const { player } = this.#app;
    const { paused, playbackRate } = player;
    return html`<div class="group" role="group" aria-label="Playing">
      <button type="button" class="play" ?disabled=${player.readyState < 2} @click=${() => this.#toggle()}>${paused ? 'Play' : 'Pause'}</button>
      ${this.#page.playing?.() ?? nothing}
      <label class="select side"><span>Speed</span>
        <select @change=${(event: Event) => (player.playbackRate = Number((event.target as HTMLSelectElement).value))}>
          ${SPEEDS.map((speed) => html`<option value=${speed} .selected=${speed === playbackRate}>${speed}×</option>`)}
        </select></label>
    </div>
    ${this.#page.views()}`;
  }

  #problems(): TemplateResult | typeof nothing {
    const { diagnostics } = this.#app;
    if (diagnostics.length === 0) return nothing;
    return html`<ul>
    ${diagnostics.slice(0, MAX_PROBLEMS).map((d) => html`<li>${d.message}${d.hints.map((hint) => html` <small>${hint}</small>`)}</li>`)}
    ${diagnostics.length > MAX_PROBLEMS ? html`<li>… and ${diagnostics.length - MAX_PROBLEMS} more.</li>` : nothing}
  </ul>`;
  }
}

/** Renders a line of the text; a long one wraps with an indent. */
function line(text: string): HTMLElement {
  const span = document.createElement('span');
  span.textContent = text;
  return span;
}
