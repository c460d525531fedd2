/** What surrounds the settings of a page: tools to undo, playing, tabs with their panels, the text and its problems. */

import { html, nothing, render, type TemplateResult } from 'lit';
import type { RaconteurPlayer } from '../element/index.js';
import type { Settings } from './settings.js';
import { copyText, onUndoKeys, part } from './workbench.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2];
/** Problems that are listed; the rest is counted. */
const MOST_PROBLEMS = 5;

/** What a page puts into its shell. */
interface Parts<Tab extends string> {
  /** What each tab shows. */
  readonly panels: Readonly<Record<Tab, () => TemplateResult>>;
  /** What stands beside playing. */
  readonly views: () => TemplateResult;
  /** What follows a reset. */
  readonly onReset?: () => void;
  /** Begins at the beginning, where a page has that. */
  readonly restart?: () => void;
}

/** The page's only player. */
export function thePlayer(): RaconteurPlayer {
  const player = document.querySelector('raconteur-player');
  if (player === null) throw new Error('the page has no player');
  return player;
}

/** Says something to those who do not see what happens. */
export function say(text: string): void {
  part('status').textContent = text;
}

/** A line of the text; a long one goes on indented. */
function line(text: string): HTMLElement {
  const span = document.createElement('span');
  span.textContent = text;
  return span;
}

/** Wires the parts that every such page has; what it gives draws them. */
export function shell<Tab extends string>(app: Settings<unknown, Tab>, { panels, views, onReset, restart }: Parts<Tab>): () => void {
  const { player } = app;
  const places = { tools: part('tools'), transport: part('transport'), panel: part('panel'), eml: part('eml'), problems: part('problems') };
  const tabs = [...document.querySelectorAll<HTMLButtonElement>('[role="tab"]')];

  const reset = (): void => {
    app.reset();
    onReset?.();
    say('Everything is as in the beginning. Undo brings it back.');
  };
  const toggle = (): void => {
    if (!player.paused) player.pause();
    else player.play().catch(() => say('The browser allows playing only after a press.'));
  };
  const tools = (): TemplateResult =>
    html`<button type="button" class="plain" ?disabled=${!app.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
      <button type="button" class="plain" ?disabled=${!app.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
      <button type="button" class="plain" ?disabled=${app.isNew} @click=${reset}>Reset</button>`;
  const transport = (): TemplateResult => {
    const { paused, playbackRate } = player;
    return html`<div class="group" role="group" aria-label="Playing">
        <button type="button" class="play" ?disabled=${player.readyState < 2} @click=${toggle}>${paused ? 'Play' : 'Pause'}</button>
        ${restart && html`<button type="button" class="plain" @click=${restart} title="Begin again">From the start</button>`}
        <label class="select side"><span>Speed</span>
          <select @change=${(event: Event) => (player.playbackRate = Number((event.target as HTMLSelectElement).value))}>
            ${SPEEDS.map((speed) => html`<option value=${speed} .selected=${speed === playbackRate}>${speed}×</option>`)}
          </select></label>
      </div>
      ${views()}`;
  };
  const problems = (): TemplateResult | typeof nothing => {
    const { diagnostics } = app;
    if (diagnostics.length === 0) return nothing;
    return html`<ul>
      ${diagnostics.slice(0, MOST_PROBLEMS).map((d) => html`<li>${d.message}${d.hints.map((hint) => html` <small>${hint}</small>`)}</li>`)}
      ${diagnostics.length > MOST_PROBLEMS ? html`<li>… and ${diagnostics.length - MOST_PROBLEMS} more.</li>` : nothing}
    </ul>`;
  };

  const draw = (): void => {
    render(tools(), places.tools);
    render(transport(), places.transport);
    for (const tab of tabs) {
      const chosen = tab.dataset['tab'] === app.tab;
      tab.setAttribute('aria-selected', String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      if (chosen) places.panel.setAttribute('aria-labelledby', tab.id);
    }
    render(panels[app.tab](), places.panel);
    if (places.eml.textContent !== app.eml) places.eml.replaceChildren(...app.eml.split(/(?<=\n)/).map(line));
    render(problems(), places.problems);
  };

  for (const [i, tab] of tabs.entries()) {
    const choose = (next: HTMLButtonElement | undefined, focus: boolean): void => {
      const name = next?.dataset['tab'];
      if (name === undefined || !(name in panels)) return;
      app.tab = name as Tab;
      draw();
      if (focus) next?.focus();
    };
    tab.addEventListener('click', () => choose(tab, false));
    tab.addEventListener('keydown', (event) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (by !== undefined) choose(tabs[(i + by + tabs.length) % tabs.length], true);
      else if (event.key === 'Home') choose(tabs[0], true);
      else if (event.key === 'End') choose(tabs.at(-1), true);
      else return;
      event.preventDefault();
    });
  }

  part('copy').addEventListener('click', (event) => {
    const button = event.currentTarget as HTMLButtonElement;
    copyText(app.eml, (outcome) => {
      button.textContent = outcome ?? 'Copy';
      if (outcome !== undefined) say(outcome);
    });
  });

  // Who types undoes letters.
  onUndoKeys(
    () => app.undo(),
    () => app.redo(),
    ({ target }) => target instanceof HTMLInputElement && ['number', 'text'].includes(target.type),
  );

  for (const type of ['play', 'pause', 'seeked', 'ratechange', 'loadedmetadata', 'durationchange', 'figurechange']) player.addEventListener(type, () => app.redraw());
  return draw;
}
