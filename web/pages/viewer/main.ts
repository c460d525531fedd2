/** The viewer: wires the stage, the panels and the text to one state. */

import { html, render } from 'lit';
import { Shell } from '../shell.js';
import { findPlayer, byId } from '../workbench.js';
import { animations } from './animations.js';
import { App, FRONT, type Tab } from './app.js';
import { look } from './look.js';
import { manipulators } from './manipulators.js';
import { lookAround, overlay, views } from './stage.js';
import type { State } from './state.js';

const player = findPlayer();
const place = byId('overlay');
const drawOverlay = (): void => {
  render(overlay(app), place);
};
const app = new App(player, () => shell.draw(), drawOverlay);
const shell = new Shell<State, Tab>(app, {
  panels: { animations: () => animations(app), manipulators: () => manipulators(app), look: () => look(app) },
  playing: () => html`<button type="button" class="plain" @click=${() => app.restart()} title="Restart">From the start</button>`,
  views: () => views(app),
  reset: () => app.look(FRONT),
  typed: ['number'],
  draw: drawOverlay,
  // While the figure moves, its handles go along.
  keepUp: () => app.goAlong(),
});

player.addEventListener('figurechange', () => app.redraw());
player.addEventListener('seeked', () => app.sought());
// If an animation could not be fetched, its diagnostic arrives late.
player.addEventListener('durationchange', () => (app.diagnostics = player.diagnostics.filter((d) => d.start !== undefined)));
// The rendered frame follows its new size a little later.
new ResizeObserver(() => {
  app.redraw();
  setTimeout(() => app.redraw(), 200);
}).observe(player);
lookAround(app, byId('pad'));
void shell.open(() => player.look(app.view));
