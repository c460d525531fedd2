/** The page of the face: wires the stage, the panels, the strip and the text to one state. */

import '../../element/index.js';
import { render } from 'lit';
import { cast } from '../home-cast.js';
import { SETTLED_SECS } from '../settings.js';
import { say, shell, thePlayer } from '../shell.js';
import { part } from '../workbench.js';
import { App } from './app.js';
import { DIRECT, MUSCLES, VISEMES } from './dials.js';
import { disc } from './disc-view.js';
import { regions } from './panels.js';
import { speaking } from './speak.js';
import { lookAround, views } from './stage.js';
import { follow, measure, strip, type Strip } from './strip.js';

/** By then a picture that was asked for is shown. */
const SHOWN_MS = 250;

const player = thePlayer();
const places = { speaking: part('speaking'), strip: part('strip') };
let drawn: Strip | undefined;
const app = new App(player, draw, () => (drawn = measure(app)));
const drawShell = shell(app, {
  panels: {
    emotion: () => disc(app),
    muscles: () => regions(app, MUSCLES, 'Contraction of each of the 38 mimic muscles, from relaxed to full.'),
    direct: () => regions(app, DIRECT, 'What no muscle moves here: jaw, lips as a ring, lids and eyes, tongue and the blood in the skin.'),
    visemes: () => regions(app, VISEMES, 'Mouths of the sounds of speech; the player blends them by dominance when it speaks.'),
  },
  views: () => views(app),
});

function draw(): void {
  drawShell();
  render(speaking(app, say), places.speaking);
  render(strip(app, drawn), places.strip);
  follow(places.strip, player);
}

player.addEventListener('durationchange', () => (drawn = measure(app)));
// A figure of another height has its head elsewhere.
player.addEventListener('figurechange', () => centreSoon());
cast(player, () => undefined);
lookAround(app, part('pad'));

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
