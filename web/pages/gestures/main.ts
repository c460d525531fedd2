/** The workshop for gestures: wires the stage, the timeline, the steps and the text to one state. */

import '../player.js';
import { html, nothing, render, type TemplateResult } from 'lit';
import { openEyesAt } from '../face/course.js';
import { copyText, findPlayer, onUndoKeys, byId, saveScript } from '../workbench.js';
import { App } from './app.js';
import { EXAMPLES } from './examples.js';
import { FIGURES } from '../figures.js';
import { remember, remembered } from './memory.js';
import { overlay } from './overlay.js';
import { Palms } from './palm.js';
import { panels } from './panels.js';
import { sides } from '../sides.js';
import { difference } from '../source.js';
import { timeline } from './timeline.js';

const SPEEDS = [0.5, 1, 1.5];
/** Problems that are listed; the rest is counted. */
const MAX_PROBLEMS = 8;

const player = findPlayer();
const places = {
  tools: byId('tools'),
  overlay: byId('overlay'),
  transport: byId('transport'),
  sides: byId('sides'),
  timeline: byId('timeline'),
  steps: byId('steps'),
  problems: byId('problems'),
  status: byId('status'),
};
byId('waiting').remove();
const [first = ''] = Object.values(EXAMPLES);
const app = new App(player, byId('editor'), remembered() ?? first, draw);
let copied = '';

function draw(): void {
  render(tools(), places.tools);
  render(overlay(app), places.overlay);
  render(transport(), places.transport);
  render(
    sides(player, () => app.redraw()),
    places.sides,
  );
  render(timeline(app), places.timeline);
  render(panels(app), places.steps);
  render(problems(), places.problems);
}

function say(text: string): void {
  places.status.textContent = text;
}

/** Replaces the whole text; can be undone. */
function replace(text: string, name: string): void {
  const change = difference(app.editor.text, text);
  if (change === undefined) return;
  app.change([change]);
  app.selectPhase(0);
  say(`${name} is on stage. Undo restores the previous gesture.`);
}

function tools(): TemplateResult {
  const begin = (event: Event): void => {
    const select = event.target as HTMLSelectElement;
    const text = EXAMPLES[select.value];
    if (text !== undefined) replace(text, select.value);
    select.value = '';
  };
  return html`<label class="select"><span>Begin with</span>
      <select @change=${begin}><option value="">Choose…</option>${Object.keys(EXAMPLES).map((name) => html`<option>${name}</option>`)}</select></label>
    <label class="select"><span>On stage</span>
      <select @change=${(event: Event) => (player.figure = (event.target as HTMLSelectElement).value)}>
        ${Object.entries(FIGURES).map(([id, name]) => html`<option value=${id} .selected=${id === (player.figure ?? player.currentFigure)}>${name}</option>`)}
      </select></label>
    <span class="group">
      <button type="button" class="plain" ?disabled=${!app.editor.canUndo} @click=${() => app.editor.undo()} title="Undo (Ctrl Z)">Undo</button>
      <button type="button" class="plain" ?disabled=${!app.editor.canRedo} @click=${() => app.editor.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    </span>
    <span class="group">
      <button type="button" class="plain" @click=${copy}>${copied === '' ? 'Copy EML' : copied}</button>
      <button type="button" class="plain" @click=${download}>Download</button>
    </span>`;
}

function copy(): void {
  copyText(app.editor.text, (outcome) => {
    copied = outcome ?? '';
    if (outcome !== undefined) say(outcome);
    app.redraw();
  });
}

function download(): void {
  say(`${saveScript(app.editor.text, 'gesture')} is saved.`);
}

function toggle(): void {
  if (player.paused) player.play().catch(() => say('The browser allows playback only after a click.'));
  else player.pause();
}

function transport(): TemplateResult {
  const { paused, loop, playbackRate } = player;
  const secs = Math.max(0, app.secs);
  return html`<button type="button" class="play" ?disabled=${player.readyState < 2} @click=${toggle}>${paused ? 'Play' : 'Pause'}</button>
    <label class="check"><input type="checkbox" .checked=${loop} @change=${(event: Event) => (player.loop = (event.target as HTMLInputElement).checked)} /> Loop</label>
    <label class="select side"><span>Speed</span>
      <select @change=${(event: Event) => (player.playbackRate = Number((event.target as HTMLSelectElement).value))}>
        ${SPEEDS.map((speed) => html`<option value=${speed} .selected=${speed === playbackRate}>${speed}×</option>`)}
      </select></label>
    <span class="clock">${secs.toFixed(2)} / ${app.endSecs.toFixed(2)} s</span>`;
}

function problems(): TemplateResult {
  const { diagnostics } = app;
  if (diagnostics.length === 0) return html`<p class="fine">The text is valid.</p>`;
  const count = (severity: string, name: string): string[] => {
    const n = diagnostics.filter((d) => d.severity === severity).length;
    return n === 0 ? [] : [`${n} ${name}${n === 1 ? '' : 's'}`];
  };
  return html`<p class="trouble">${[...count('error', 'error'), ...count('warning', 'warning')].join(' and ')}; the rest is performed.</p>
    <ul>
      ${diagnostics.slice(0, MAX_PROBLEMS).map(
        (d) => html`<li class=${d.severity}>
          ${d.start === undefined ? nothing : html`<button type="button" class="plain" @click=${() => d.start && app.editor.goTo(d.start)}>Line ${d.start.line}</button>`}
          <span>${d.message}${d.hints.map((hint) => html` <small>${hint}</small>`)}</span>
        </li>`,
      )}
      ${diagnostics.length > MAX_PROBLEMS ? html`<li>… and ${diagnostics.length - MAX_PROBLEMS} more.</li>` : nothing}
    </ul>`;
}

// Undo and redo apply to the whole page: changes by controls and typed changes share one list.
onUndoKeys(
  () => app.editor.undo(),
  () => app.editor.redo(),
);

/** Opens the palm calculations of the build that the player has fetched; after a failure, the next story that is loaded tries again. */
async function openPalms(): Promise<void> {
  const backend = player.activeBackend;
  if (backend === undefined || app.palms !== undefined) return;
  app.palms = await Palms.open(backend).catch(() => undefined);
  app.redraw();
}
player.addEventListener('loadedmetadata', () => void openPalms());

/** Opens the stage and shows the edited time. */
async function open(): Promise<void> {
  draw();
  remember(app.editor.text);
  await app.rehearse();
  const tab = app.tab;
  app.selectTab(tab);
  // The first frame should not show a blink.
  const open = openEyesAt(player, player.currentTime);
  if (open !== player.currentTime) player.currentTime = open;
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) return;
  say('The gesture stands still until you play it.');
}
void open();
