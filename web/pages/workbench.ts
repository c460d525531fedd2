/** What the scripts of the viewer, of the face and of the workshop for gestures have in common. */

import type { RaconteurPlayer } from '../element/element.js';

/** The player of the page. */
export function findPlayer(): RaconteurPlayer {
  const found = document.querySelector('raconteur-player');
  if (found === null) throw new Error('the page has no player');
  return found;
}

/** An element of the page; throws where the page lacks it. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the page has no #${id}`);
  return element;
}

/** How long a copy is reported. */
const TOLD_MS = 1800;

/** Copies a text; `tell` hears how it went, and nothing when that is no news any more. */
export function copyText(text: string, tell: (outcome: 'Copied' | 'Select and copy by hand' | undefined) => void): void {
  const told = (outcome: 'Copied' | 'Select and copy by hand') => (): void => {
    tell(outcome);
    setTimeout(() => tell(undefined), TOLD_MS);
  };
  navigator.clipboard.writeText(text).then(told('Copied'), told('Select and copy by hand'));
}

/** The browser has taken a file by then. */
const TAKEN_MS = 10_000;

/** Hands a file to the visitor. */
export function save(file: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), TAKEN_MS);
}

/** Hands a script to the visitor, under the name that it has in itself; that name. */
export function saveScript(text: string, otherwise: string): string {
  const name = `${/<eml[^>]*\sname=["']([\w-]+)["']/.exec(text)?.[1] ?? otherwise}.eml`;
  save(new Blob([text], { type: 'application/xml' }), name);
  return name;
}

/** Connects the keys for undo and redo with the whole page, or with an element's shadow; where `leaves` says so, they keep their own meaning. */
export function onUndoKeys(undo: () => void, redo: () => void, leaves: (event: KeyboardEvent) => boolean = () => false, root: EventTarget = document): void {
  root.addEventListener('keydown', (event) => {
    if (!(event instanceof KeyboardEvent)) return;
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.defaultPrevented || leaves(event)) return;
    const key = event.key.toLowerCase();
    if (key === 'z' && !event.shiftKey) undo();
    else if ((key === 'z' && event.shiftKey) || key === 'y') redo();
    else return;
    event.preventDefault();
  });
}
