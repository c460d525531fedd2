/** Who tells the story: the figures of the library, or a file of the user's own. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Diagnostic } from '../element/types.js';

/** Connects the row of faces with a player; `changed` is called with the name of a chosen figure of the library. */
export function cast(player: RaconteurPlayer, changed: (figure: string) => void): (figure: string) => void {
  const buttons = [...document.querySelectorAll<HTMLButtonElement>('[data-figure]')];
  const file = document.querySelector<HTMLInputElement>('#own-figure');
  const name = document.querySelector('#own-name');
  const trouble = document.querySelector('#cast-trouble');
  const theatre = player.parentElement;

  /** Marks the figure on stage, and the one that is on its way. */
  const mark = (): void => {
    const onStage = player.currentFigure ?? player.figure ?? 'sofia';
    for (const button of buttons) {
      const figure = button.dataset['figure'];
      button.setAttribute('aria-pressed', String(figure === onStage));
      button.setAttribute('aria-busy', String(figure === player.figure && figure !== onStage));
    }
    file?.closest('label')?.classList.toggle('chosen', !buttons.some((b) => b.dataset['figure'] === onStage));
  };

  const choose = (figure: string): void => {
    if (!buttons.some((b) => b.dataset['figure'] === figure)) return;
    if (trouble !== null) trouble.textContent = '';
    player.figure = figure;
    changed(figure);
    mark();
  };

  const useOwn = (own: File | undefined): void => {
    if (own === undefined) return;
    if (trouble !== null) trouble.textContent = '';
    if (name !== null) name.textContent = own.name;
    player.useFigure(own);
    mark();
  };

  for (const button of buttons) button.addEventListener('click', () => choose(button.dataset['figure'] ?? ''));
  file?.addEventListener('change', () => {
    useOwn(file.files?.[0]);
    // Choosing the same file again is a choice, too: it may have been mended.
    file.value = '';
  });
  player.addEventListener('figurechange', mark);
  player.addEventListener('loadedmetadata', mark);
  player.addEventListener('diagnostic', (event) => {
    const { detail } = event as CustomEvent<Diagnostic>;
    if (detail.code !== 'figure-unusable') return;
    // The figure before is still on stage, so it is the one that is chosen.
    if (trouble !== null) trouble.textContent = `${detail.message} ${detail.hints.join(' ')}`;
    if (name !== null && !buttons.some((b) => b.dataset['figure'] === player.figure)) name.textContent = 'Yours';
    if (player.figure !== undefined) player.figure = player.currentFigure;
    mark();
  });

  theatre?.addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    theatre.classList.add('drop');
  });
  theatre?.addEventListener('dragleave', () => theatre.classList.remove('drop'));
  theatre?.addEventListener('drop', (event) => {
    event.preventDefault();
    theatre.classList.remove('drop');
    useOwn(event.dataTransfer?.files[0]);
  });
  return choose;
}
