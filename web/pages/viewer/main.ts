/** The viewer: wires the stage, the panels and the text to one state. */

import '../../element/index.js';
import { render } from 'lit';
import { cast } from '../home-cast.js';
import { SETTLED_SECS } from '../settings.js';
import { shell, thePlayer } from '../shell.js';
import { part } from '../workbench.js';
import { animations } from './animations.js';
import { App, FRONT } from './app.js';
import { look } from './look.js';
import { manipulators } from './manipulators.js';
import { lookAround, overlay, views } from './stage.js';

const player = thePlayer();
const app = new App(player, draw, drawOverlay);
const drawShell = shell(app, {
  panels: { animations: () => animations(app), manipulators: () => manipulators(app), look: () => look(app) },
  views: () => views(app),
  onReset: () => app.look(FRONT),
  restart: () => app.restart(),
});

function drawOverlay(): void {
  render(overlay(app), part('overlay'));
}

function draw(): void {
  drawShell();
  drawOverlay();
}

player.addEventListener('seeked', () => app.sought());
// A diagnostic comes late when an animation could not be fetched.
player.addEventListener('durationchange', () => (app.diagnostics = player.diagnostics.filter((d) => d.start !== undefined)));
// The picture follows its new size a little later.
new ResizeObserver(() => {
  app.redraw();
  setTimeout(() => app.redraw(), 200);
}).observe(player);
cast(player, () => undefined);
lookAround(app, part('pad'));

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
