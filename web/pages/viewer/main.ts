/** The viewer: wires the stage, the panels and the text to one state. */

import '../player.js';
import { html, nothing, render, type TemplateResult } from 'lit';
import { cast } from '../home-cast.js';
import { copyText, onUndoKeys, part } from '../workbench.js';
import { animations } from './animations.js';
import { App, FRONT, type Tab } from './app.js';
import { look } from './look.js';
import { manipulators } from './manipulators.js';
import { lookAround, overlay, views } from './stage.js';
import { beginning } from './state.js';
import { SETTLED_SECS } from './write.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2];
/** Problems that are listed; the rest is counted. */
const MOST_PROBLEMS = 5;

const found = document.querySelector('raconteur-player');
if (found === null) throw new Error('the page has no player');
const player = found;
const places = { tools: part('tools'), overlay: part('overlay'), transport: part('transport'), panel: part('panel'), eml: part('eml'), problems: part('problems'), status: part('status'), pad: part('pad') };
const app = new App(player, draw, drawOverlay);
const panels: Readonly<Record<Tab, (app: App) => TemplateResult>> = { animations, manipulators, look };
const tabs = [...document.querySelectorAll<HTMLButtonElement>('[role="tab"]')];

function drawOverlay(): void {
  render(overlay(app), places.overlay);
}

function draw(): void {
  render(tools(), places.tools);
  drawOverlay();
  render(transport(), places.transport);
  for (const tab of tabs) {
    const chosen = tab.dataset['tab'] === app.tab;
    tab.setAttribute('aria-selected', String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
    if (chosen) places.panel.setAttribute('aria-labelledby', tab.id);
  }
  render(panels[app.tab](app), places.panel);
  if (places.eml.textContent !== app.eml) places.eml.replaceChildren(...app.eml.split(/(?<=\n)/).map(line));
  render(problems(), places.problems);
}

/** A line of the text; a long one goes on indented. */
function line(text: string): HTMLElement {
  const span = document.createElement('span');
  span.textContent = text;
  return span;
}

function say(text: string): void {
  places.status.textContent = text;
}

function tools(): TemplateResult {
  return html`<button type="button" class="plain" ?disabled=${!app.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
    <button type="button" class="plain" ?disabled=${!app.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    <button type="button" class="plain" ?disabled=${app.isNew} @click=${reset}>Reset</button>`;
}

function reset(): void {
  app.set((s) => Object.assign(s, beginning()));
  app.look(FRONT);
  say('Everything is as in the beginning. Undo brings it back.');
}

function toggle(): void {
  if (!player.paused) player.pause();
  else player.play().catch(() => say('The browser allows playing only after a press.'));
}

function transport(): TemplateResult {
  const { paused, playbackRate } = player;
  return html`<div class="group" role="group" aria-label="Playing">
      <button type="button" class="play" ?disabled=${player.readyState < 2} @click=${toggle}>${paused ? 'Play' : 'Pause'}</button>
      <button type="button" class="plain" @click=${() => app.restart()} title="Begin again">From the start</button>
      <label class="select side"><span>Speed</span>
        <select @change=${(event: Event) => (player.playbackRate = Number((event.target as HTMLSelectElement).value))}>
          ${SPEEDS.map((speed) => html`<option value=${speed} .selected=${speed === playbackRate}>${speed}×</option>`)}
        </select></label>
    </div>
    ${views(app)}`;
}

function problems(): TemplateResult | typeof nothing {
  const { diagnostics } = app;
  if (diagnostics.length === 0) return nothing;
  return html`<ul>
    ${diagnostics.slice(0, MOST_PROBLEMS).map((d) => html`<li>${d.message}${d.hints.map((hint) => html` <small>${hint}</small>`)}</li>`)}
    ${diagnostics.length > MOST_PROBLEMS ? html`<li>… and ${diagnostics.length - MOST_PROBLEMS} more.</li>` : nothing}
  </ul>`;
}

for (const [i, tab] of tabs.entries()) {
  const choose = (next: HTMLButtonElement | undefined, focus: boolean): void => {
    const name = next?.dataset['tab'];
    if (name !== 'animations' && name !== 'manipulators' && name !== 'look') return;
    app.tab = name;
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

// Who types a number undoes letters.
onUndoKeys(
  () => app.undo(),
  () => app.redo(),
  ({ target }) => target instanceof HTMLInputElement && target.type === 'number',
);

for (const type of ['play', 'pause', 'seeked', 'ratechange', 'loadedmetadata', 'figurechange', 'durationchange']) player.addEventListener(type, () => app.redraw());
player.addEventListener('seeked', () => app.sought());
// A diagnostic comes late when an animation could not be fetched.
player.addEventListener('durationchange', () => (app.diagnostics = player.diagnostics.filter((d) => d.start !== undefined)));
// The picture follows its new size a little later.
new ResizeObserver(() => {
  app.redraw();
  setTimeout(() => app.redraw(), 200);
}).observe(player);
cast(player, () => undefined);
lookAround(app, places.pad);

/** While the figure moves, its handles go along. */
function keepUp(): void {
  if (!player.paused && !document.hidden) app.goAlong();
  requestAnimationFrame(keepUp);
}

/** Opens the stage at a moment at which everybody has come to their place. */
async function open(): Promise<void> {
  draw();
  player.look(app.view);
  await app.rehearse();
  player.currentTime = SETTLED_SECS;
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) await player.play().catch(() => undefined);
  app.redraw();
}
requestAnimationFrame(keepUp);
void open();
