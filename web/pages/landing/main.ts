/** Landing page: one player, with a choice of story and storyteller. */

import '../player.js';
import './code.js';
import { cast } from '../cast.js';
import { lines } from './lines.js';
import { say } from './say.js';
import { showStage } from './stage.js';
import { textsOf } from './script.js';

const player = document.querySelector('raconteur-player');
const script = document.querySelector('#script');
const buttons = [...document.querySelectorAll<HTMLButtonElement>('[data-story]')];

const shown = player === null ? undefined : lines(player);

/** A text of the visitor's own is on the stage. */
let owned = false;
/** Storyteller chosen by the visitor, overriding the story's choice. */
let figure = '';

const address = (story: string): string => `assets/stories/${story}/story.eml`;

/** Returns the name of a story in the address: its folder's name. */
const short = (button: HTMLButtonElement): string => button.dataset['story']?.split('/').at(-1) ?? '';

/** Offers the subtitles of a story in a language; none without. */
function offerSubtitles(of: HTMLElement, story: string, language: string | undefined): void {
  for (const track of of.querySelectorAll('track')) track.remove();
  if (language === undefined) return;
  const label = new Intl.DisplayNames(language, { type: 'language' }).of(language) ?? language;
  const src = `assets/stories/${story}/subtitles.${language}.vtt`;
  of.append(Object.assign(document.createElement('track'), { kind: 'subtitles', srclang: language, label, src }));
}

/** Loads a story; an address with `#white-rabbit` selects one too, and `#white-rabbit/papous` also the storyteller. */
function choose(name: string): void {
  const button = buttons.find((b) => short(b) === name);
  const story = button?.dataset['story'];
  if (button === undefined || story === undefined || player === null) return;
  for (const b of buttons) b.setAttribute('aria-pressed', String(b === button));
  player.label = button.dataset['title'] ?? story;
  const src = address(story);
  offerSubtitles(player, story, button.dataset['subtitles']);
  // A text of the visitor may have replaced the story.
  if (owned) shown?.tell(undefined);
  // Setting the same URL again reloads its story.
  if (owned || player.getAttribute('src') !== src) player.src = src;
  owned = false;
  if (script?.closest('details')?.open) void readScript();
}

/** Shows the text of the story that is on the stage. */
async function readScript(): Promise<void> {
  if (script === null || !player?.src) return;
  const src = player.src;
  try {
    const response = await fetch(src);
    const text = response.ok ? await response.text() : 'The script was not found.';
    if (player.src === src) script.textContent = text.trim();
  } catch {
    script.textContent = 'The script could not be fetched.';
  }
}

for (const button of buttons) {
  button.addEventListener('click', () => {
    // Each story has its own storyteller until the visitor chooses another, who then stays.
    choose(short(button));
    remember();
    player?.play().catch(() => undefined);
    if (player !== null) showStage(player);
  });
}
script?.closest('details')?.addEventListener('toggle', () => void readScript());

/** Updates the address with the current story and figure, so that it can be shared. */
function remember(): void {
  const button = buttons.find((b) => b.getAttribute('aria-pressed') === 'true');
  const story = button === undefined ? '' : short(button);
  history.replaceState(null, '', `#${story}${figure === '' ? '' : `/${figure}`}`);
}

const clear = (script: string): void => {
  owned = true;
  shown?.tell(textsOf(script));
  for (const b of buttons) b.setAttribute('aria-pressed', 'false');
};
const isShared = player !== null && say(player, { clear });
const [story = '', teller = ''] = isShared ? [] : location.hash.slice(1).split('/');
if (!isShared) choose(story);
if (player !== null) {
  const chooseFigure = cast(player, (name) => {
    figure = name;
    // The still is of the story's own figure.
    player.toggleAttribute('data-teller', player.figure !== undefined);
    // The address stores the visitor's own text.
    if (!owned) remember();
  });
  if (teller !== '') chooseFigure(teller);
}
