/** Choice of the storyteller: a figure of the library, or the user's own file. */

import type { RaconteurPlayer } from '../element/element.js';
import type { Diagnostic } from '../element/base/types.js';

/** Figure of the library, user's own file, or undefined, which leaves the choice to the story. */
type PerformerChoice = string | File | undefined;

/** Prefixes of diagnostic codes unrelated to figures. */
const OF_ELSE = /^(voice|sound|engine|mind|live|tell|figure-unusable)/;

/** Connects the row of faces in a page, or in an element's shadow, with a player; `changed` is called with the name of a chosen figure of the library, empty for any other. */
export function cast(player: RaconteurPlayer, changed: (figure: string) => void, root: ParentNode = document): (figure: string) => void {
  const buttons = [...root.querySelectorAll<HTMLButtonElement>('[data-figure]')];
  const file = root.querySelector<HTMLInputElement>('#own-figure');
  const name = root.querySelector('#own-name');
  const trouble = root.querySelector('#cast-trouble');
  const remarks = root.querySelector<HTMLDetailsElement>('#own-remarks');
  const theatre = player.parentElement;
  /** Last chosen storyteller; the next variable is the last one that came on stage. */
  let asked: PerformerChoice;
  let settled: PerformerChoice;

  /** Marks the figure on stage, and the one being loaded. */
  const mark = (): void => {
    const onStage = player.currentFigure ?? player.figure ?? 'sofia';
    for (const button of buttons) {
      const figure = button.dataset['figure'];
      button.setAttribute('aria-pressed', String(figure === onStage));
      button.setAttribute('aria-busy', String(figure === player.figure && figure !== onStage));
    }
    file?.closest('label')?.classList.toggle('chosen', !buttons.some((b) => b.dataset['figure'] === onStage));
    if (remarks !== null) remark(remarks, asked instanceof File && asked.name === onStage ? player.diagnostics : []);
  };

  const put = (teller: PerformerChoice): void => {
    asked = teller;
    if (name !== null) name.textContent = teller instanceof File ? teller.name : 'Yours';
    if (teller instanceof File) player.useFigure(teller);
    else player.figure = teller;
    changed(typeof teller === 'string' ? teller : '');
    mark();
  };

  const choose = (teller: PerformerChoice): void => {
    if (teller === undefined || (typeof teller === 'string' && !buttons.some((b) => b.dataset['figure'] === teller))) return;
    if (trouble !== null) trouble.textContent = '';
    put(teller);
  };

  const came = (): void => {
    const wanted = asked instanceof File ? asked.name : asked;
    if (wanted === undefined || wanted === player.currentFigure) settled = asked;
    mark();
  };

  for (const button of buttons) button.addEventListener('click', () => choose(button.dataset['figure']));
  file?.addEventListener('change', () => {
    choose(file.files?.[0]);
    // Choosing the same file again is a choice, too: it may have been mended.
    file.value = '';
  });
  player.addEventListener('figurechange', came);
  player.addEventListener('loadedmetadata', came);
  player.addEventListener('diagnostic', (event) => {
    const { detail } = event as CustomEvent<Diagnostic>;
    if (detail.code !== 'figure-unusable') return;
    // The figure before is still on stage, so it is the one that is chosen.
    if (trouble !== null) trouble.textContent = `${detail.message} ${detail.hints.join(' ')}`;
    if (asked !== settled) put(settled);
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
    choose(event.dataTransfer?.files[0]);
  });
  return choose;
}

/** Lists the diagnostics of the user's own figure, collapsed; hidden if there are none. */
function remark(place: HTMLDetailsElement, diagnostics: readonly Diagnostic[]): void {
  const said = diagnostics.filter(({ code, start }) => start === undefined && !OF_ELSE.test(code));
  const lines = said.map(({ message, hints }) => [message, ...hints].join(' '));
  const list = place.querySelector('ul');
  const summary = place.querySelector('summary');
  if (list === null || summary === null) return;
  place.hidden = lines.length === 0;
  summary.textContent = `${lines.length} ${lines.length === 1 ? 'remark' : 'remarks'} on your figure`;
  list.replaceChildren(
    ...lines.map((line) => {
      const item = document.createElement('li');
      item.textContent = line;
      return item;
    }),
  );
}
