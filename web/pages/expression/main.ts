/** The page of expression: wires two stages, their controls, rules and text to one state. */

import { render } from 'lit';
import { RaconteurPlayer } from '../../element/element.js';
import { Shell } from '../shell.js';
import { byId } from '../workbench.js';
import { App, type Tab } from './app.js';
import { disc } from './disc-view.js';
import { comparison, fromStart, rules, setting, types } from './panels.js';
import type { Side, State } from './state.js';

/** Update interval of the rules during playback, ms. */
const TOLD_MS = 250;

function playerOf(id: string): RaconteurPlayer {
  const found = byId(id);
  if (!(found instanceof RaconteurPlayer)) throw new Error(`#${id} is no player`);
  return found;
}

const stages: Readonly<Record<Side, HTMLElement>> = { a: byId('a'), b: byId('b') };
const places = { bench: byId('bench'), setting: byId('setting'), rules: byId('rules') };
let toldMs = 0;

// This listener runs before the shell takes the file from its input.
const own = byId('own-figure') as HTMLInputElement;
const give = (file: File | undefined): void => {
  if (file !== undefined) app.sittings.b.player.useFigure(file);
};
own.addEventListener('change', () => give(own.files?.[0]));
byId('frame').addEventListener('drop', (event) => give(event.dataTransfer?.files[0]));

const app: App = new App(playerOf('a'), playerOf('b'), () => shell.draw());
const shell = new Shell<State, Tab>(app, {
  panels: { types: () => types(app), disc: () => disc(app) },
  playing: () => fromStart(app),
  views: () => comparison(app),
  typed: ['number'],
  draw: () => {
    const { compares, edits } = app.state;
    places.bench.classList.toggle('compares', compares);
    for (const side of ['a', 'b'] as const) stages[side].toggleAttribute('data-edited', compares && side === edits);
    render(setting(app), places.setting);
    render(rules(app), places.rules);
  },
  keepUp: () => {
    const now = performance.now();
    if (now < toldMs + TOLD_MS) return;
    toldMs = now;
    app.redraw();
  },
});

shell.draw();
void app.rehearse();
