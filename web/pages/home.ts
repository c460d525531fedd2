/** The first page: one player, two stories to choose. */

import '../element/index.js';
import './home-code.js';

const player = document.querySelector('raconteur-player');
const script = document.querySelector('#script');
const buttons = [...document.querySelectorAll<HTMLButtonElement>('[data-story]')];

const address = (story: string): string => `assets/stories/${story}/story.eml`;

/** Puts a story on the stage; `#white-rabbit` in the address names one, too. */
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
    history.replaceState(null, '', `#${story}`);
    player?.play().catch(() => undefined);
  });
}
script?.closest('details')?.addEventListener('toggle', () => void readScript());
choose(location.hash.slice(1));
