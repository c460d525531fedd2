/** Toolbar for the whole face: undo, files, an image, a new one. */

import { html, type TemplateResult } from 'lit';
import { save } from '../pages/workbench.js';
import type { App } from './app.js';
import type { RaconteurComposite } from './element.js';
import { LIMITS } from './limits.js';
import { parse } from './saved.js';
import { reason, type EditorFeedback } from './editor-feedback.js';

export function tools(app: App, editor: RaconteurComposite, tell: EditorFeedback): TemplateResult {
  const { history } = app;
  const load = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    // Choosing the same file again is a choice, too.
    input.value = '';
    if (file === undefined) return;
    try {
      if (file.size > LIMITS.bytes) throw new Error(`It is larger than ${LIMITS.bytes / 1e6} MB.`);
      await editor.open(parse(await file.text()));
      app.tab = 'history';
      tell.say(`${file.name} is open.`);
    } catch (error) {
      tell.trouble(`${file.name} could not be opened: ${reason(error)} Your work is unchanged.`);
    }
  };
  const picture = (): void => {
    editor.snapshot()?.toBlob((blob) => {
      if (blob !== null) save(blob, 'face.png');
    });
  };
  return html`<button type="button" class="plain" ?disabled=${!history.canUndo} @click=${() => app.undo()} title="Undo (Ctrl Z)">Undo</button>
    <button type="button" class="plain" ?disabled=${!history.canRedo} @click=${() => app.redo()} title="Redo (Ctrl Shift Z)">Redo</button>
    <button type="button" class="plain" @click=${() => save(new Blob([JSON.stringify(app.save())], { type: 'application/json' }), 'face.composite.json')}>Save</button>
    <label class="plain file"><input type="file" accept=".json,application/json" @change=${load} /><span>Open</span></label>
    <button type="button" class="plain" @click=${picture}>Picture</button>
    <button type="button" class="plain" ?disabled=${history.here === 0} @click=${() => app.goTo(0)} title="Starts from the average; the current face stays in the history">New face</button>`;
}
