/** The composite editor: wires the stage, the panels and the session to one history. */

import { html, nothing, render, type TemplateResult } from 'lit';
import { openFaces } from '../element/open-faces.js';
import '../pages/player.js';
import { lookAround, lookFrom, SIDES } from '../pages/head-view.js';
import { cast } from '../pages/home-cast.js';
import { SETTLED_SECS } from '../pages/page-state.js';
import { Tabs } from '../pages/tabs.js';
import { byId, findPlayer, onUndoKeys, save } from '../pages/workbench.js';
import { App, type Tab } from './app.js';
import { features, heldList, historyList, parts } from './panels.js';
import { Portraits } from './portraits.js';
import { saying, still } from './script.js';
import { Session } from './session.js';
import { start } from './start.js';

/** By then the requested picture is shown. */
const SHOWN_MS = 250;
/** As long as a sentence is. */
const MOST_LETTERS = 300;
/** A file of a session is not larger. */
const MOST_BYTES = 64e6;

const player = findPlayer();
const places = { tools: byId('tools'), transport: byId('transport'), panel: byId('panel'), speaking: byId('speaking'), status: byId('status'), trouble: byId('trouble') };
const pack = (file: string): URL => new URL(`../assets/faces/${file}`, document.baseURI);
const say = (text: string): void => {
  places.status.textContent = text;
};
const trouble = (text: string): void => {
  places.trouble.textContent = text;
};
const progress = byId('opening') as HTMLProgressElement;

/** The face on stage looks ahead and stands still, while it is changed. */
async function rest(): Promise<void> {
  player.pause();
  await player.rehearse(still);
  player.currentTime = SETTLED_SECS;
}

async function open(): Promise<void> {
  const session = new Session(trouble);
  const watch = (share: number): void => {
    progress.value = share;
  };
  const [faces, saved] = await Promise.all([openFaces(pack('people.faces'), pack('people.skins'), { progress: watch }), session.open(), rest()]);
  const app: App = new App(player, faces, {
    draw: () => draw(),
    say: (text) => {
      trouble(text);
      say(text);
    },
    changed: () => {
      trouble('');
      session.keep(() => app.save());
    },
  });
  const portraits = new Portraits(
    faces,
    byId('portraits'),
    () => player.currentFigure,
    () => app.redraw(),
  );
  const panels: Readonly<Record<Tab, () => TemplateResult>> = {
    start: () => start(app, portraits),
    features: () => features(app),
    parts: () => parts(app),
    held: () => heldList(app),
    history: () => historyList(app),
  };
  const tabs = new Tabs<Tab>(
    (name): name is Tab => name in panels,
    (tab) => {
      app.tab = tab;
      draw();
    },
  );
  const draw = (): void => {
    render(tools(app), places.tools);
    render(views(app), places.transport);
    tabs.mark(app.tab, places.panel);
    render(panels[app.tab](), places.panel);
    render(speaking(), places.speaking);
  };
  if (saved !== undefined) {
    try {
      app.open(saved);
    } catch (error) {
      trouble(`The last session could not be opened: ${reason(error)}`);
    }
  }
  listen(app);
  places.panel.replaceChildren();
  await app.show();
  draw();
  app.view.look({});
  const centreSoon = (): unknown => setTimeout(() => app.view.centre(), SHOWN_MS);
  centreSoon();
  // A figure of another height has its head elsewhere, and comes with its own face.
  player.addEventListener('figurechange', () => {
    centreSoon();
    void app.show();
    app.redraw();
  });
  new ResizeObserver(centreSoon).observe(player);
  byId('bench').dataset['ready'] = '';
}

const reason = (error: unknown): string => (error instanceof Error ? error.message : String(error));

function listen(app: App): void {
  lookAround(app.view, byId('pad'));
  cast(player, () => undefined);
  // Who types undoes letters.
  onUndoKeys(
    () => app.undo(),
    () => app.redo(),
    ({ target }) => target instanceof HTMLInputElement && ['number', 'text', 'search'].includes(target.type),
  );
  const sides: Readonly<Record<string, number>> = { f: SIDES.Front, t: SIDES['Three-quarter'], p: SIDES.Left };
  document.addEventListener('keydown', (event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || target instanceof HTMLInputElement || target instanceof HTMLSelectElement) return;
    const turn = sides[event.key];
    if (turn !== undefined) app.view.look({ turn, tilt: 0.02 });
  });
  for (const type of ['play', 'pause', 'ended'] as const) player.addEventListener(type, () => app.redraw());
  // The sentence is said: the face holds still again.
  player.addEventListener('ended', () => void rest());
}

function tools(app: App): TemplateResult {
  const { history } = app;
  const load = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    // Choosing the same file again is a choice, too.
    input.value = '';
    if (file === undefined) return;
    try {
      if (file.size > MOST_BYTES) throw new Error('It is too large for a session.');
      app.open(parse(await file.text()));
      app.tab = 'history';
      say(`${file.name} is open.`);
    } catch (error) {
      trouble(`${file.name} could not be opened: ${reason(error)} What you had is still here.`);
    }
  };
  const picture = (): void => {
    player.snapshot()?.toBlob((blob) => {
      if (blob !== null) save(blob, 'face.png');
    });
  };
  return html`<button type="button" class="plain" ?disabled=${!history.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
    <button type="button" class="plain" ?disabled=${!history.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    <button type="button" class="plain" @click=${() => save(new Blob([JSON.stringify(app.save())], { type: 'application/json' }), 'face.composite.json')}>Save</button>
    <label class="plain file"><input type="file" accept=".json,application/json" @change=${load} /><span>Open</span></label>
    <button type="button" class="plain" @click=${picture}>Picture</button>
    <button type="button" class="plain" ?disabled=${history.here === 0} @click=${() => app.goTo(0)} title="From the average again; what you have stays in the history">New face</button>`;
}

function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error('This is no session of the composite editor.');
  }
}

/** Sides to look from, and how high the eyes of who saw the face were. */
function views({ view }: App): TemplateResult {
  const tilt = (by: number): void => view.look({ tilt: view.from.tilt + by });
  return html`${lookFrom(view)}
    <div class="group" role="group" aria-label="Height of the witness">
      <button type="button" class="plain" aria-label="From lower" @click=${() => tilt(-0.1)}>↓</button>
      <button type="button" class="plain" aria-label="From higher" @click=${() => tilt(0.1)}>↑</button>
    </div>`;
}

/** The face speaks. */
function speaking(): TemplateResult {
  const speak = async (event: Event): Promise<void> => {
    event.preventDefault();
    const text = (event.currentTarget as HTMLFormElement).querySelector('input')?.value.trim().slice(0, MOST_LETTERS) ?? '';
    if (text === '') return;
    try {
      await player.rehearse(saying(text));
      player.currentTime = 0;
      await player.play();
    } catch (error) {
      trouble(`It cannot speak now: ${reason(error)}`);
    }
  };
  return html`<form class="line" @submit=${speak}>
    <label class="select"><span>Let this face speak</span><input type="text" name="line" maxlength=${MOST_LETTERS} value="Hello! It is good to see you." autocomplete="off" /></label>
    <button type="submit" class="play">Speak</button>
    ${player.paused ? nothing : html`<button type="button" class="plain" @click=${() => void rest()}>Stop</button>`}
  </form>`;
}

open().catch((error: unknown) => {
  places.panel.replaceChildren();
  trouble(`The editor could not be opened: ${reason(error)}`);
});
