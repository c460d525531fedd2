/** The first page: one player; the story and who tells it are chosen. */

import '../element/index.js';
import './home-code.js';
import { cast } from './home-cast.js';

const player = document.querySelector('raconteur-player');
const script = document.querySelector('#script');
const buttons = [...document.querySelectorAll<HTMLButtonElement>('[data-story]')];

/** Who tells it. */
let figure = 'sofia';

const address = (story: string): string => `assets/stories/${story}/story.eml`;

/** Puts a story on the stage; `#white-rabbit` in the address names one, too, and `#white-rabbit/papous` who tells it. */
function choose(story: string): void {
  const button = buttons.find((b) => b.dataset['story'] === story);
  if (button === undefined || player === null) return;
  for (const b of buttons) b.setAttribute('aria-pressed', String(b === button));
  player.label = button.dataset['title'] ?? story;
  player.src = address(story);
  if (script?.closest('details')?.open) void readScript();
}

/** Shows the text of the story that is on the stage. */
async function readScript(): Promise<void> {
  if (script === null || player?.src === undefined) return;
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
    const story = button.dataset['story'] ?? '';
    choose(story);
    remember();
    player?.play().catch(() => undefined);
  });
}
script?.closest('details')?.addEventListener('toggle', () => void readScript());

/** The address names what is on stage, so that it can be handed on. */
function remember(): void {
  const story = buttons.find((b) => b.getAttribute('aria-pressed') === 'true')?.dataset['story'] ?? '';
  history.replaceState(null, '', `#${story}${figure === 'sofia' ? '' : `/${figure}`}`);
}

const [story = '', teller = ''] = location.hash.slice(1).split('/');
choose(story);
if (player !== null) {
  const chooseFigure = cast(player, (name) => {
    figure = name;
    remember();
  });
  if (teller !== '') chooseFigure(teller);
}
