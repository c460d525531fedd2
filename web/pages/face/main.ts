/** The page of the face: wires the stage, the panels, the strip and the text to one state. */

import { render } from 'lit';
import { Shell } from '../shell.js';
import { findPlayer, byId } from '../workbench.js';
import { App, type Tab } from './app.js';
import { DIRECT, MUSCLES, namesOf, VISEMES } from './dials.js';
import { disc } from './disc-view.js';
import { manner, regions } from './panels.js';
import { speaking } from './speak.js';
import { lookAround } from '../head-view.js';
import { views } from './stage.js';
import type { State } from './state.js';
import { follow, measure, strip, type Strip } from './strip.js';

/** Time after which the requested frame is shown, ms. */
const SHOWN_MS = 250;

const player = findPlayer();
const places = { speaking: byId('speaking'), strip: byId('strip') };
let drawn: Strip | undefined;
const app = new App(
  player,
  () => shell.draw(),
  () => (drawn = measure(app)),
);
const muscles = MUSCLES.flatMap((region) => region.dials).flatMap(namesOf).length;
const shell = new Shell<State, Tab>(app, {
  panels: {
    emotion: () => disc(app),
    muscles: () => regions(app, MUSCLES, `Contraction of each of the ${muscles} facial muscles, from relaxed to full.`),
    direct: () => regions(app, DIRECT, 'Parameters without a muscle: jaw, lips as a ring, lids and eyes, tongue and the blood in the skin.'),
    visemes: () => regions(app, VISEMES, 'Mouth shapes of the phones; the player blends them by dominance when it speaks.'),
    manner: () => manner(app),
  },
  views: () => views(app),
  typed: ['number', 'text'],
  draw: () => {
    render(
      speaking(app, (text) => shell.say(text)),
      places.speaking,
    );
    render(strip(app, drawn), places.strip);
    follow(places.strip, player);
  },
  // While the story plays, the line of the current time moves.
  keepUp: () => follow(places.strip, player),
});

/** Centres the head once the current frame is available. */
function centreSoon(): void {
  setTimeout(() => app.view.centre(), SHOWN_MS);
}

player.addEventListener('durationchange', () => (drawn = measure(app)));
// A figure of another height has its head elsewhere.
player.addEventListener('figurechange', centreSoon);
// Another size of the stage needs another shot.
new ResizeObserver(centreSoon).observe(player);
lookAround(app.view, byId('pad'));
void shell.open(() => app.view.look({}), centreSoon);
