/** The page *Transcribe*: wires the files, the recording, the figure, the tracks and the panel to one state. */

import '../player.js';
import { html, nothing, render, type TemplateResult } from 'lit';
import { check, choice } from '../fields.js';
import { FIGURES } from '../figures.js';
import { sides } from '../sides.js';
import { byId, findPlayer, onUndoKeys, save } from '../workbench.js';
import { Annotations } from './annotate.js';
import { App } from './app.js';
import { clock } from './axis.js';
import exampleUrl from './example.anvil?url';
import { Lanes } from './lanes.js';
import { annotationButton, chosen, opening, type Opening } from './opening.js';
import { panel } from './panel.js';
import { Playback } from './playback.js';
import { problems } from './problems.js';
import type { Anchoring, Item, Problem } from './types.js';

const RATES = [0.25, 0.5, 0.75, 1];
/** Step of the arrow keys outside of the tracks, seconds. */
const STEP_SECS = 0.1;
const ANCHORS: Readonly<Record<Anchoring, string>> = { words: 'Words', seconds: 'Seconds' };
/** Controls that have a use of their own for keys. */
const OWN_KEYS = 'input, select, textarea, button, a, summary, video, label, [role="gridcell"], raconteur-player';

const player = findPlayer();
const media = byId('media') as HTMLVideoElement;
const bench = byId('bench');
const places = {
  tools: byId('tools'),
  opening: byId('opening'),
  seen: byId('seen'),
  transport: byId('transport'),
  panel: byId('panel'),
  zoom: byId('zoom'),
  counts: byId('counts'),
  problems: byId('problems'),
  status: byId('status'),
};

const say = (text: string): void => {
  places.status.textContent = text;
};

const annotations = new Annotations();
// It is fetched while the visitor looks for a file; a failure shows when the file is opened.
annotations.lists().catch(() => undefined);
const playback = new Playback(player, () => say('The browser allows playback only after a click.'));
const app = new App(annotations, playback, draw, () => {
  drawTransport();
  lanes.keepUp();
});
const lanes = new Lanes(app, byId('scroller'), say);
let recordingName = '';
let mapping = '';
let refused: { name: string; problems: readonly Problem[] } | undefined;
let isMirrored = false;

// --- files ---

async function openFiles(files: Iterable<File>): Promise<void> {
  const { annotation, recording } = chosen(files);
  if (recording !== undefined) openRecording(recording);
  if (annotation !== undefined) await openAnnotation(annotation.name, new Uint8Array(await annotation.arrayBuffer()));
  app.redraw();
}

async function openAnnotation(name: string, bytes: Uint8Array): Promise<void> {
  const found = await app.open(name, bytes, mapping).catch((error: unknown) => [failure(error)]);
  refused = found.length === 0 ? undefined : { name, problems: found };
  say(refused === undefined ? `${name} is open.` : `${name} could not be opened.`);
  app.redraw();
}

const failure = (error: unknown): Problem => ({ code: 'page', severity: 'error', message: error instanceof Error ? error.message : String(error), hints: [] });

async function openExample(): Promise<void> {
  const response = await fetch(exampleUrl).catch(() => undefined);
  if (response?.ok !== true) {
    refused = { name: 'The example', problems: [failure('the server does not have it')] };
    app.redraw();
    return;
  }
  await openAnnotation('example.anvil', new Uint8Array(await response.arrayBuffer()));
}

function openRecording(file: File): void {
  removeRecording();
  media.src = URL.createObjectURL(file);
  recordingName = file.name;
  playback.recording = media;
}

function removeRecording(): void {
  if (media.src === '') return;
  playback.recording = undefined;
  URL.revokeObjectURL(media.src);
  media.removeAttribute('src');
  recordingName = '';
  app.redraw();
}

media.addEventListener('error', () => {
  if (recordingName === '') return;
  const name = recordingName;
  removeRecording();
  refused = { name, problems: [failure('The browser cannot play this recording: convert it, for example to MP4 with H.264.')] };
  app.redraw();
});

async function saveAnvil(): Promise<void> {
  if (app.transcription === undefined) return;
  save(new Blob([await annotations.toAnvil(app.transcription)], { type: 'application/xml' }), `${app.name}.anvil`);
  say(`${app.name}.anvil is saved.`);
}

async function saveEml(): Promise<void> {
  if (app.transcription === undefined) return;
  const { eml } = await annotations.toEml(app.transcription, app.anchoring);
  save(new Blob([eml], { type: 'application/xml' }), `${app.name}.eml`);
  say(`${app.name}.eml is saved.`);
}

// --- drawing ---

function draw(): void {
  const has = app.transcription !== undefined;
  bench.classList.toggle('empty', !has);
  bench.classList.toggle('recorded', recordingName !== '');
  // Sound alone has no picture.
  const isSound = media.readyState > 0 && media.videoWidth === 0;
  media.hidden = recordingName === '' || isSound;
  player.classList.toggle('mirrored', isMirrored);
  render(has ? tools() : nothing, places.tools);
  const state: Opening = { hasAnnotation: has, recording: recordingName, isSound, mapping, closed: app.closed?.name ?? '', refused };
  render(
    opening(state, {
      files: (files) => void openFiles(files),
      example: () => void openExample(),
      reopen: () => void app.reopen(),
      mapping: (text) => (mapping = text),
      removeRecording,
    }),
    places.opening,
  );
  render(seen(), places.seen);
  if (!has) return;
  drawTransport();
  render(panel(app), places.panel);
  render(lanes.zoomButtons(), places.zoom);
  render(problems(app, go), places.problems);
  places.counts.textContent = counts();
  lanes.draw();
}

function tools(): TemplateResult {
  return html`<span class="group">
      ${annotationButton((files) => void openFiles(files))}
      <button type="button" class="plain" @click=${() => app.close()}>Close</button>
    </span>
    <span class="group">
      <button type="button" class="plain" ?disabled=${!app.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
      <button type="button" class="plain" ?disabled=${!app.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    </span>
    <span class="group exports" role="group" aria-label="Save">
      <button type="button" class="plain" @click=${() => void saveAnvil()}>Save ANVIL</button>
      <button type="button" class="plain" @click=${() => void saveEml()}>Save EML</button>
      ${choice('anchoring', 'Times by', app.anchoring, ANCHORS, (anchoring) => {
        app.anchoring = anchoring;
        app.redraw();
      })}
    </span>`;
}

function seen(): TemplateResult {
  return html`<label class="select side"><span>Figure</span>
      <select @change=${(event: Event) => (player.figure = (event.target as HTMLSelectElement).value)}>
        ${Object.entries(FIGURES).map(([id, name]) => html`<option value=${id} .selected=${id === (player.figure ?? player.currentFigure)}>${name}</option>`)}
      </select></label>
    <span class="select">${sides(player, () => app.redraw())}</span>
    ${check('As in a mirror', isMirrored, (on) => {
      isMirrored = on;
      app.redraw();
    })}`;
}

function drawTransport(): void {
  const { paused, secs, rate } = playback;
  const length = app.lengthSecs;
  render(
    html`<button type="button" class="play" ?disabled=${player.readyState < 2} @click=${() => playback.toggle()}>${paused ? 'Play' : 'Pause'}</button>
      <input
        type="range"
        aria-label="Time"
        aria-valuetext="${clock(secs)} s"
        min="0"
        max=${length.toFixed(2)}
        step="0.01"
        .value=${Math.min(secs, length).toFixed(2)}
        @input=${(event: Event) => app.seek(Number((event.target as HTMLInputElement).value))}
      />
      <span class="clock">${clock(secs)} / ${clock(length)} s</span>
      <label class="select side"><span>Speed</span>
        <select @change=${(event: Event) => (playback.rate = Number((event.target as HTMLSelectElement).value))}>
          ${RATES.map((to) => html`<option value=${to} .selected=${to === rate}>${to}×</option>`)}
        </select></label>`,
    places.transport,
  );
}

function counts(): string {
  const { statistics } = app;
  if (statistics === undefined) return '';
  const some = (n: number, name: string): string => `${n} ${name}${n === 1 ? '' : 's'}`;
  const lead = statistics.strokeLeadSecs;
  const parts = [some(statistics.words, 'word'), some(statistics.utterances, 'utterance'), some(statistics.gestures, 'gesture'), `${statistics.lengthSecs.toFixed(1)} s`];
  if (lead !== undefined) parts.push(`strokes begin ${Math.abs(lead).toFixed(2)} s ${lead >= 0 ? 'before' : 'after'} the nearest word, on average`);
  return `${app.name}: ${parts.join(', ')}.${app.isStored ? '' : ' The browser has no space to keep it: save it before you leave.'}`;
}

/** Shows an annotation, and a field of it. */
function go(item: Item, field: string | undefined): void {
  lanes.go(item);
  if (field !== undefined) requestAnimationFrame(() => document.getElementById(`field-${field}`)?.focus());
}

// --- events ---

for (const type of ['play', 'pause', 'ended', 'seeked', 'timeupdate', 'loadedmetadata', 'durationchange', 'figurechange']) player.addEventListener(type, () => app.redraw());
for (const type of ['play', 'pause', 'ended', 'seeked', 'loadedmetadata']) media.addEventListener(type, () => app.redraw());

// In a text field, undo applies to letters.
onUndoKeys(
  () => app.undo(),
  () => app.redo(),
  ({ target }) => target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type === 'text' && target.matches(':focus')),
);

// The last change may be so new that the figure has not performed it.
window.addEventListener('pagehide', () => app.store());

document.addEventListener('keydown', (event) => {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || app.transcription === undefined) return;
  const { target } = event;
  const isSpan = target instanceof Element && target.matches('[role="gridcell"]');
  if (target instanceof Element && target.closest(OWN_KEYS) !== null && !(isSpan && event.key === ' ')) return;
  const step = { ArrowLeft: -STEP_SECS, ArrowRight: STEP_SECS }[event.key];
  if (step !== undefined) app.seek(playback.secs + step);
  else if (event.key === ' ') playback.toggle();
  else return;
  event.preventDefault();
});

places.panel.addEventListener('keydown', (event) => {
  if (event.key === 'Escape') lanes.focus();
});

bench.addEventListener('dragover', (event) => {
  if (event.dataTransfer?.types.includes('Files') !== true) return;
  event.preventDefault();
  bench.classList.add('dropping');
});
bench.addEventListener('dragleave', () => bench.classList.remove('dropping'));
bench.addEventListener('drop', (event) => {
  event.preventDefault();
  bench.classList.remove('dropping');
  void openFiles(event.dataTransfer?.files ?? []);
});

draw();
await app.restore();
app.run();
