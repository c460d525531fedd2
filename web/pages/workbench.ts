/** Code shared by the viewer, the face page and the gesture workshop. */

import type { RaconteurPlayer } from '../element/element.js';

/** Returns the player of the page. */
export function findPlayer(): RaconteurPlayer {
  const found = document.querySelector('raconteur-player');
  if (found === null) throw new Error('the page has no player');
  return found;
}

/** Returns an element of the page; throws if the page lacks it. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the page has no #${id}`);
  return element;
}

/** Display time of the copy confirmation, ms. */
const TOLD_MS = 1800;

/** Copies a text; `tell` receives the outcome, then undefined when the message expires. */
export function copyText(text: string, tell: (outcome: 'Copied' | 'Select and copy by hand' | undefined) => void): void {
  const told = (outcome: 'Copied' | 'Select and copy by hand') => (): void => {
    tell(outcome);
    setTimeout(() => tell(undefined), TOLD_MS);
  };
  navigator.clipboard.writeText(text).then(told('Copied'), told('Select and copy by hand'));
}

/** Time after which the browser has saved a file, ms. */
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

/** Binds the undo and redo keys to the whole page, or to an element's shadow root; where `leaves` returns true, they keep their native meaning. */
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
