/** Page of the composite editor: the element, and the additions of a separate page. */

import { onUndoKeys } from '../workbench.js';
import { register } from '../../composite/register.js';

register('../assets/');
const editor = document.querySelector('raconteur-composite');
if (editor === null) throw new Error('the page has no editor');
// The editor handles the keys pressed in it; nothing else on this page can be undone.
onUndoKeys(
  () => editor.undo(),
  () => editor.redo(),
  (event) => event.composedPath().includes(editor),
);
document.querySelector('.skip')?.addEventListener('click', (event) => {
  event.preventDefault();
  editor.focus();
});
editor.ready.then(
  () => {
    editor.dataset['ready'] = '';
  },
  // The editor shows the problems.
  () => undefined,
);
