/** The page of the face: wires the stage, the panels, the strip and the text to one state. */

import '../player.js';
import { html, nothing, render, type TemplateResult } from 'lit';
import { cast } from '../home-cast.js';
import { copyText, onUndoKeys, part } from '../workbench.js';
import { App, SETTLED_SECS, type Tab } from './app.js';
import { DIRECT, MUSCLES, VISEMES, namesOf } from './dials.js';
import { disc } from './disc-view.js';
import { regions } from './panels.js';
import { speaking } from './speak.js';
import { lookAround, views } from './stage.js';
import { beginning } from './state.js';
import { follow, measure, strip, type Strip } from './strip.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2];
/** By then a picture that was asked for is shown. */
const SHOWN_MS = 250;
/** Problems that are listed; the rest is counted. */
const MOST_PROBLEMS = 5;

const found = document.querySelector('raconteur-player');
if (found === null) throw new Error('the page has no player');
const player = found;
const places = { tools: part('tools'), transport: part('transport'), panel: part('panel'), speaking: part('speaking'), strip: part('strip'), eml: part('eml'), problems: part('problems'), status: part('status'), pad: part('pad') };
let drawn: Strip | undefined;
const app = new App(player, draw, () => (drawn = measure(app)));
const panels: Readonly<Record<Tab, (app: App) => TemplateResult>> = {
  emotion: disc,
  muscles: (app) => regions(app, MUSCLES, `Contraction of each of the ${MUSCLES.flatMap((region) => region.dials).flatMap(namesOf).length} mimic muscles, from relaxed to full.`),
  direct: (app) => regions(app, DIRECT, 'What no muscle moves here: jaw, lips as a ring, lids and eyes, tongue and the blood in the skin.'),
  visemes: (app) => regions(app, VISEMES, 'Mouths of the sounds of speech; the player blends them by dominance when it speaks.'),
};
const tabs = [...document.querySelectorAll<HTMLButtonElement>('[role="tab"]')];

function draw(): void {
  render(tools(), places.tools);
  render(transport(), places.transport);
  for (const tab of tabs) {
    const chosen = tab.dataset['tab'] === app.tab;
    tab.setAttribute('aria-selected', String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
    if (chosen) places.panel.setAttribute('aria-labelledby', tab.id);
  }
  render(panels[app.tab](app), places.panel);
  render(speaking(app, say), places.speaking);
  render(strip(app, drawn), places.strip);
  follow(places.strip, player);
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
    if (name !== 'emotion' && name !== 'muscles' && name !== 'direct' && name !== 'visemes') return;
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

// Who types undoes letters.
onUndoKeys(
  () => app.undo(),
  () => app.redo(),
  ({ target }) => target instanceof HTMLInputElement && ['number', 'text'].includes(target.type),
);

for (const type of ['play', 'pause', 'seeked', 'ratechange', 'loadedmetadata', 'durationchange']) player.addEventListener(type, () => app.redraw());
player.addEventListener('durationchange', () => (drawn = measure(app)));
// A figure of another height has its head elsewhere.
player.addEventListener('figurechange', () => centreSoon());
cast(player, () => undefined);
lookAround(app, places.pad);

/** Brings the head into the middle when the picture of now is there. */
function centreSoon(): void {
  setTimeout(() => app.centre(), SHOWN_MS);
}

// Another size of the picture takes another shot.
new ResizeObserver(centreSoon).observe(player);

/** While the clock runs, the line of the present goes along. */
function keepUp(): void {
  if (!player.paused && !document.hidden) follow(places.strip, player);
  requestAnimationFrame(keepUp);
}

/** Opens the stage at a moment at which everybody has come to their place. */
async function open(): Promise<void> {
  draw();
  app.look({});
  await app.rehearse();
  player.currentTime = SETTLED_SECS;
  centreSoon();
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) await player.play().catch(() => undefined);
  app.redraw();
}
requestAnimationFrame(keepUp);
void open();
